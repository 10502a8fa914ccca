// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Format_h
#define vtkIsodiamond_Format_h

#include <string_view>

/**
 * @file Format.h
 * What writing and reading hierarchies (State.h) must agree on: the names of field-data arrays, and
 * what is where in the header and among the parameters. docs/file-format.md describes them all.
 */
namespace vtkIsodiamond::format
{

/** The version that is written. Version 2 is read, too: its header ends before TwoSided. */
inline constexpr int Version = 3;

inline constexpr const char* Header = "IsodiamondHeader";
inline constexpr const char* Parameters = "IsodiamondParameters";
inline constexpr const char* ArrayName = "IsodiamondArrayName";

/** Of RI and MI. */
inline constexpr const char* BrickCounts = "IsodiamondBrickCounts";
inline constexpr const char* BrickIndices = "IsodiamondBrickIndices";
inline constexpr const char* BrickMasks = "IsodiamondBrickMasks";
inline constexpr const char* Records = "IsodiamondRecords";
inline constexpr const char* Isovertices = "IsodiamondIsovertices";
inline constexpr const char* InsideValues = "IsodiamondInsideValues";
inline constexpr const char* InteriorCodes = "IsodiamondInteriorCodes";
inline constexpr const char* Followers = "IsodiamondFollowers";
inline constexpr const char* PointDataPrefix = "IsodiamondPointData:"; ///< an array's name follows

/** Of an HD. */
inline constexpr const char* Samples = "IsodiamondSamples";
inline constexpr const char* Errors = "IsodiamondErrors";
inline constexpr const char* Minima = "IsodiamondMinima";
inline constexpr const char* Maxima = "IsodiamondMaxima";

/** Numbers for users who look at the field data: the first three of any hierarchy, with which
 * ParaView's panels start; the others of RI and MI. No mesh depends on them. */
inline constexpr const char* LargestErrorTolerance = "LargestErrorTolerance";
inline constexpr const char* Isovalue = "Isovalue";
inline constexpr const char* Isorange = "Isorange";
inline constexpr const char* NumberOfActiveIsodiamonds = "NumberOfActiveIsodiamonds";
inline constexpr const char* NumberOfRelevantIsodiamonds = "NumberOfRelevantIsodiamonds";
inline constexpr const char* NumberOfCreationIsodiamonds = "NumberOfCreationIsodiamonds";
inline constexpr const char* NumberOfIsovertices = "NumberOfIsovertices";
inline constexpr const char* NumberOfRemovedPieces = "NumberOfRemovedPieces";
inline constexpr const char* StorageSize = "StorageSize";

/** Whether an array, which may have no name, is a part of what a hierarchy is made of. */
inline bool IsOfHierarchy(const char* name)
{
  constexpr std::string_view prefix = "Isodiamond"; // of all of the above
  return name != nullptr && std::string_view(name).substr(0, prefix.size()) == prefix;
}

/** Such numbers beside a mesh. */
inline constexpr const char* AchievedTolerance = "AchievedTolerance";
inline constexpr const char* ToleranceExcess = "ToleranceExcess";
inline constexpr const char* SmallestDihedralAngle = "SmallestDihedralAngle";
inline constexpr const char* LargestDihedralAngle = "LargestDihedralAngle";

}

/** Indices into the header. */
namespace vtkIsodiamond::HeaderAt
{

enum : int
{
  Version,
  Model,
  Shape,
  Dimensions, ///< three
  RelevantCount = Dimensions + 3,
  Metric,
  ExactIsovertices,
  TwoSided,
  PreservesTopology,
  MinimumPieceSize,
  RemovedPieces,
  Size,                     ///< how many there are
  SizeOfVersion2 = TwoSided ///< how many version 2 had
};

}

/** Indices into the parameters. */
namespace vtkIsodiamond::ParameterAt
{

enum : int
{
  Isovalue,
  Isorange, ///< two
  ErrorScale = Isorange + 2,
  FieldScale,
  World,            ///< three rows of four
  Size = World + 12 ///< how many there are
};

}

#endif
