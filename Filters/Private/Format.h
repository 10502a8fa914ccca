// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Format_h
#define vtkIsodiamond_Format_h

/**
 * @file Format.h
 * What writing and reading of hierarchies (State.h) have to agree about.
 */
namespace vtkIsodiamond::format
{

inline constexpr int FormatVersion = 2;
inline constexpr int HeaderCount = 9;
inline constexpr int ParameterCount = 17;
inline constexpr const char* PointArrayPrefix = "IsodiamondPointData:";
inline constexpr const char* HeaderName = "IsodiamondHeader";
inline constexpr const char* ParametersName = "IsodiamondParameters";
inline constexpr int ErrorScaleAt = 3; ///< among the parameters
inline constexpr int FieldScaleAt = 4;
inline constexpr int WorldAt = 5;
inline constexpr int MetricAt = 7; ///< in the header
inline constexpr int ExactAt = 8;

}

#endif
