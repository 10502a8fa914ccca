// SPDX-License-Identifier: BSD-3-Clause
// Changes to the field data of .vtp files in ASCII: types, names, sizes and numbers. VTK's reader
// ends the program on many inputs that are no such files at all; that is not ours to find.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace
{

using Random = std::minstd_rand;

/** An array of the field data: its tag, and its numbers. */
struct Element
{
  std::size_t Tag = 0;
  std::size_t Content = 0;
  std::size_t End = 0; ///< where the closing tag begins
};

std::vector<Element> FindElements(const std::string& text)
{
  std::vector<Element> elements;
  const std::size_t last = text.find("</FieldData>");
  for (std::size_t at = text.find("<DataArray"); at < last; at = text.find("<DataArray", at + 1))
  {
    const Element element = { at, text.find('>', at) + 1, text.find("</DataArray>", at) };
    if (last == std::string::npos || element.End >= last)
    {
      break;
    }
    elements.push_back(element);
  }
  return elements;
}

std::string AnyNumber(Random& random)
{
  constexpr std::array<const char*, 16> special = { "0", "-1", "1", "2", "255", "65535", "16383",
    "65536", "2147483647", "-2147483648", "4294967295", "9223372036854775807", "nan", "inf",
    "1e308", "1048577" };
  return random() % 2 == 0 ? special[random() % special.size()]
                           : std::to_string(static_cast<int>(random() % 70000));
}

/** Replaces the value of an attribute, if the tag has it. */
void SetAttribute(std::string& text, std::size_t tag, const char* name, const std::string& value)
{
  const std::size_t begin = text.find(std::string(" ") + name + "=\"", tag);
  if (begin < text.find('>', tag))
  {
    const std::size_t first = text.find('"', begin) + 1;
    text.replace(first, text.find('"', first) - first, value);
  }
}

void ChangeNumber(std::string& text, const Element& element, Random& random)
{
  if (element.End <= element.Content)
  {
    return;
  }
  const auto isSpace = [](char c) { return c == ' ' || c == '\n' || c == '\t'; };
  std::size_t at = element.Content + random() % (element.End - element.Content);
  while (at < element.End && isSpace(text[at]))
  {
    ++at;
  }
  std::size_t first = at;
  while (first > element.Content && !isSpace(text[first - 1]))
  {
    --first;
  }
  std::size_t last = at;
  while (last < element.End && !isSpace(text[last]))
  {
    ++last;
  }
  text.replace(first, last - first, AnyNumber(random));
}

void ChangeElement(std::string& text, const std::vector<Element>& all, Random& random)
{
  constexpr std::array<const char*, 10> types = { "Int8", "UInt8", "Int16", "UInt16", "Int32",
    "UInt32", "Int64", "UInt64", "Float32", "Float64" };
  const Element element = all[random() % all.size()];
  const std::size_t next = element.End + std::strlen("</DataArray>");
  switch (random() % 10)
  {
    case 0:
      SetAttribute(text, element.Tag, "type", types[random() % types.size()]);
      break;
    case 1:
      SetAttribute(text, element.Tag, "NumberOfTuples", std::to_string(random() % 3000));
      break;
    case 2:
      SetAttribute(text, element.Tag, "NumberOfComponents", std::to_string(1 + random() % 4));
      break;
    case 3: // another's name
    {
      const std::size_t other = text.find("Name=\"", all[random() % all.size()].Tag) + 6;
      SetAttribute(text, element.Tag, "Name", text.substr(other, text.find('"', other) - other));
      break;
    }
    case 4:
      text.erase(element.Tag, next - element.Tag);
      break;
    default:
      ChangeNumber(text, element, random);
  }
}

}

extern "C" std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
  Random random(seed);
  std::string text(reinterpret_cast<const char*>(data), size);
  for (std::uint32_t changes = 1 + random() % 3; changes > 0; --changes)
  {
    const std::vector<Element> elements = FindElements(text);
    if (!elements.empty())
    {
      ChangeElement(text, elements, random);
    }
  }
  if (text.size() > most)
  {
    return size;
  }
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

/** Never puts parts of two files together: copies the first. */
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data, std::size_t size,
  const std::uint8_t* /*other*/, std::size_t /*otherSize*/, std::uint8_t* out, std::size_t most,
  unsigned /*seed*/)
{
  const std::size_t count = std::min(size, most);
  std::copy_n(data, count, out);
  return count;
}
