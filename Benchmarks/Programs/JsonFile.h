// SPDX-License-Identifier: BSD-3-Clause
#ifndef JsonFile_h
#define JsonFile_h

#include "Results.h"

#include <string>

namespace benchmark
{

/** Writes all that was measured, for programs. @throws std::runtime_error if it cannot */
void WriteJson(const Report& report, const std::string& path);

}

#endif
