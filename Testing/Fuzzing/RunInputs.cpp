// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target once over the files in folders; any compiler will do.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv)
{
  int count = 0;
  for (int i = 1; i < argc; ++i)
  {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i]))
    {
      std::cout << entry.path() << std::endl; // the last one printed is the one that failed
      std::ifstream file(entry.path(), std::ios::binary);
      const std::vector<char> bytes{ std::istreambuf_iterator<char>(file), {} };
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      ++count;
    }
  }
  return count > 0 ? 0 : 1;
}
