// SPDX-License-Identifier: BSD-3-Clause
// The topology of full resolution, which is kept at every tolerance, and pieces of fewer samples
// than asked for, which are not.
#include "FilterTestTools.h"

#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace
{

constexpr double Isovalue = 50.0;

/** Specks, cavities, bores, thin walls: much that a coarse mesh would lose. */
vtkSmartPointer<vtkImageData> NoisyImage()
{
  return test::PhantomImage({ 18, 17, 19 }, 25.0);
}

/** Disjoint sets of numbers from 0 on. */
class Groups
{
public:
  explicit Groups(vtkIdType count)
    : Next(static_cast<std::size_t>(count))
  {
    std::iota(this->Next.begin(), this->Next.end(), 0);
  }
  vtkIdType Of(vtkIdType member)
  {
    while (this->Next[member] != member)
    {
      member = this->Next[member] = this->Next[this->Next[member]];
    }
    return member;
  }
  void Join(vtkIdType a, vtkIdType b) { this->Next[this->Of(a)] = this->Of(b); }

private:
  std::vector<vtkIdType> Next;
};

using Simplices = std::map<std::vector<vtkIdType>, int>;

/** All corners, edges, triangles and tetrahedra of a mesh, and how many cells have each of them. */
Simplices SimplicesOf(vtkPointSet* mesh)
{
  Simplices simplices;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkIdList* ids = mesh->GetCell(cell)->GetPointIds();
    const auto corners = static_cast<int>(ids->GetNumberOfIds());
    for (int subset = 1; subset < 1 << corners; ++subset)
    {
      std::vector<vtkIdType> simplex;
      for (int i = 0; i < corners; ++i)
      {
        if ((subset >> i & 1) != 0)
        {
          simplex.push_back(ids->GetId(i));
        }
      }
      std::sort(simplex.begin(), simplex.end());
      ++simplices[simplex];
    }
  }
  return simplices;
}

/** For each piece of a mesh, its Euler characteristic and the number of parts of its boundary. With
 *  the number of pieces, these give the Betti numbers of surfaces and, of volumes, handles less
 *  cavities. */
using Topology = std::multiset<std::pair<vtkIdType, vtkIdType>>;

Topology TopologyOf(vtkPointSet* mesh)
{
  const Simplices simplices = SimplicesOf(mesh);
  std::size_t dimension = 0;
  Groups pieces(mesh->GetNumberOfPoints());
  for (const auto& [simplex, uses] : simplices)
  {
    pieces.Join(simplex.front(), simplex.back());
    dimension = std::max(dimension, simplex.size());
  }
  std::map<vtkIdType, std::pair<vtkIdType, vtkIdType>> found;
  Groups boundaries(mesh->GetNumberOfPoints());
  std::set<vtkIdType> onBoundary;
  for (const auto& [simplex, uses] : simplices)
  {
    found[pieces.Of(simplex.front())].first += simplex.size() % 2 == 1 ? 1 : -1;
    if (simplex.size() + 1 == dimension && uses == 1)
    {
      for (const vtkIdType id : simplex)
      {
        boundaries.Join(id, simplex.front());
        onBoundary.insert(id);
      }
    }
  }
  for (const vtkIdType id : onBoundary)
  {
    found[pieces.Of(id)].second += boundaries.Of(id) == id ? 1 : 0;
  }
  Topology topology;
  for (const auto& [piece, numbers] : found)
  {
    topology.insert(numbers);
  }
  return topology;
}

vtkPointSet* Updated(vtkAlgorithm* filter)
{
  filter->Update();
  return vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0));
}

/** Expects the topology of full resolution at every tolerance, in a region and from a viewpoint. */
void ExpectTopologyOfFullResolution(vtkIsodiamondVolumeAlgorithm* filter)
{
  filter->SetInputDataObject(0, NoisyImage());
  filter->PreserveFeaturesOff(); // which would keep pieces, too
  const Topology full = TopologyOf(Updated(filter));
  const vtkIdType fullSize = Updated(filter)->GetNumberOfCells();
  ASSERT_GT(full.size(), 20U);
  for (const int metric : { vtkIsodiamondHierarchy::FIELD, vtkIsodiamondHierarchy::DISTANCE })
  {
    filter->SetErrorMetric(metric);
    const double unit = metric == vtkIsodiamondHierarchy::FIELD ? 20.0 : 1.0;
    for (const double tolerance : { 0.25, 1.0, 2.0, std::numeric_limits<double>::infinity() })
    {
      filter->SetErrorTolerance(unit * tolerance);
      EXPECT_TRUE(TopologyOf(Updated(filter)) == full) << tolerance << ", metric " << metric;
      EXPECT_LT(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), fullSize);
    }
    // Otherwise it is lost, and the test can see that.
    filter->PreserveTopologyOff();
    EXPECT_FALSE(TopologyOf(Updated(filter)) == full);
    filter->PreserveTopologyOn();
  }
  filter->SetErrorTolerance(0.0);
  filter->UseRegionOfInterestOn();
  filter->SetRegionOfInterest(3, 7, 3, 7, 3, 7);
  EXPECT_TRUE(TopologyOf(Updated(filter)) == full);
  EXPECT_LT(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), fullSize);
  filter->UseRegionOfInterestOff();
  filter->ViewDependentOn();
  filter->SetViewPosition(0.0, 0.0, 500.0);
  filter->SetPixelTolerance(20.0);
  EXPECT_TRUE(TopologyOf(Updated(filter)) == full);
  EXPECT_LT(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), fullSize);
}

/**
 * Connected sets of samples on either side of a value. Samples are connected by edges of the finest
 * tetrahedra: if they are one apart on some axes, and the indices of each on these axes are all
 * even or all odd.
 */
class Sides
{
public:
  Sides(vtkImageData* image, double value)
    : Dimensions(image->GetDimensions(), image->GetDimensions() + 3)
  {
    vtkDataArray* samples = image->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < samples->GetNumberOfTuples(); ++i)
    {
      this->Above.push_back(samples->GetTuple1(i) > value);
    }
  }

  vtkIdType Count() const { return static_cast<vtkIdType>(this->Members().size()); }

  /** Moves small sets to the other side: those above, then those below. @return how many */
  vtkIdType RemoveSmall(int size)
  {
    vtkIdType removed = 0;
    for (const bool side : { true, false })
    {
      for (const auto& [group, members] : this->Members())
      {
        if (this->Above[group] == side && members.size() < static_cast<std::size_t>(size))
        {
          ++removed;
          for (const vtkIdType member : members)
          {
            this->Above[member] = !side;
          }
        }
      }
    }
    return removed;
  }

private:
  vtkIdType IdOf(const std::array<int, 3>& p) const
  {
    return p[0] + vtkIdType{ 1 } * this->Dimensions[0] * (p[1] + this->Dimensions[1] * p[2]);
  }

  /** The neighbours of a sample that have greater ids. */
  std::vector<vtkIdType> NextTo(const std::array<int, 3>& p) const
  {
    std::vector<vtkIdType> found;
    for (int code = 14; code < 27; ++code)
    {
      const std::array<int, 3> step = { code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1 };
      std::array<int, 3> q{};
      std::set<int> parities;
      bool isInside = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        q[axis] = p[axis] + step[axis];
        isInside = isInside && q[axis] >= 0 && q[axis] < this->Dimensions[axis];
        if (step[axis] != 0)
        {
          parities.insert(p[axis] % 2);
        }
      }
      if (isInside && parities.size() == 1)
      {
        found.push_back(this->IdOf(q));
      }
    }
    return found;
  }

  std::map<vtkIdType, std::vector<vtkIdType>> Members() const
  {
    const auto count = static_cast<vtkIdType>(this->Above.size());
    Groups groups(count);
    for (int z = 0; z < this->Dimensions[2]; ++z)
    {
      for (int y = 0; y < this->Dimensions[1]; ++y)
      {
        for (int x = 0; x < this->Dimensions[0]; ++x)
        {
          for (const vtkIdType other : this->NextTo({ x, y, z }))
          {
            if (this->Above[other] == this->Above[this->IdOf({ x, y, z })])
            {
              groups.Join(this->IdOf({ x, y, z }), other);
            }
          }
        }
      }
    }
    std::map<vtkIdType, std::vector<vtkIdType>> members;
    for (vtkIdType i = 0; i < count; ++i)
    {
      members[groups.Of(i)].push_back(i);
    }
    return members;
  }

  std::vector<int> Dimensions;
  std::vector<bool> Above;
};

vtkIdType RemovedAt(double value, int size)
{
  return Sides(NoisyImage(), value).RemoveSmall(size);
}

}

TEST(Topology, OfAContourIsThatOfFullResolution)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetValue(0, Isovalue);
  EXPECT_TRUE(contour->GetPreserveTopology());
  ExpectTopologyOfFullResolution(contour);
}

TEST(Topology, OfAnIntervalVolumeIsThatOfFullResolution)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetIsorange(Isovalue, 110.0);
  EXPECT_TRUE(volume->GetPreserveTopology());
  ExpectTopologyOfFullResolution(volume);
}

TEST(Topology, OfSampleVolumesIsThatOfFullResolution)
{
  const std::vector<std::pair<vtkSmartPointer<vtkImageData>, double>> volumes = {
    { test::SampleVolume("tooth_103x94x161_uint8.raw", { 103, 94, 161 }), 119.5 },
    { test::SampleVolume("hydrogen_atom_128x128x128_uint8.raw", { 128, 128, 128 }), 14.5 },
    { test::SampleVolume("neghip_64x64x64_uint8.raw", { 64, 64, 64 }), 60.5 }
  };
  for (const auto& [volume, isovalue] : volumes)
  {
    if (!volume)
    {
      GTEST_SKIP() << "ISODIAMONDS_DATA_DIR does not hold the tooth, hydrogen atom and neghip";
    }
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(volume);
    contour->SetValue(0, isovalue);
    contour->PreserveFeaturesOff();
    const Topology full = TopologyOf(Updated(contour));
    for (const double tolerance : { 0.25, 1.0, 4.0, std::numeric_limits<double>::infinity() })
    {
      contour->SetErrorTolerance(tolerance);
      EXPECT_TRUE(TopologyOf(Updated(contour)) == full) << isovalue << " at " << tolerance;
    }
  }
}

TEST(Topology, IsOfWhatIsLeftWithoutSmallPieces)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(NoisyImage());
  contour->SetValue(0, Isovalue);
  Updated(contour);
  EXPECT_EQ(contour->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  contour->SetMinimumPieceSize(3);
  const Topology full = TopologyOf(Updated(contour));
  EXPECT_EQ(contour->GetNumberOfRemovedPieces(), RemovedAt(Isovalue, 3));
  vtkDataArray* told = contour->GetOutput()->GetFieldData()->GetArray("NumberOfRemovedPieces");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->GetNumberOfTuples(), 1);
  EXPECT_EQ(told->GetTuple1(0), RemovedAt(Isovalue, 3));
  contour->SetErrorTolerance(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(TopologyOf(Updated(contour)) == full);
}

TEST(Topology, IsAMatterOfTheQueryOfAnHDAndOfTheBuildOfOthers)
{
  vtkNew<vtkIsodiamondBuilder> scalars;
  scalars->SetInputData(NoisyImage());
  scalars->SetModelToHierarchyOfDiamonds();
  scalars->SetIsovalue(Isovalue);
  scalars->PreserveTopologyOn();
  scalars->Update();
  EXPECT_FALSE(scalars->GetHierarchy()->GetPreservesTopology());
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(scalars->GetOutputPort());
  const Topology full = TopologyOf(Updated(extractor));
  extractor->SetErrorTolerance(1e9);
  EXPECT_FALSE(TopologyOf(Updated(extractor)) == full);
  extractor->PreserveTopologyOn();
  const auto expected = test::SortedTriangles(Updated(extractor));
  EXPECT_TRUE(TopologyOf(Updated(extractor)) == full);
  for (const bool fromScalars : { false, true })
  {
    vtkNew<vtkIsodiamondBuilder> builder;
    EXPECT_FALSE(builder->GetPreserveTopology());
    builder->SetIsovalue(Isovalue);
    fromScalars ? builder->SetInputConnection(scalars->GetOutputPort())
                : builder->SetInputData(NoisyImage());
    vtkNew<vtkIsodiamondExtractor> ofBuilt;
    ofBuilt->SetInputConnection(builder->GetOutputPort());
    ofBuilt->SetErrorTolerance(1e9);
    const auto messages = test::Watch(ofBuilt);
    EXPECT_FALSE(TopologyOf(Updated(ofBuilt)) == full);
    EXPECT_FALSE(builder->GetHierarchy()->GetPreservesTopology());
    EXPECT_EQ(messages->WarningCount, 0);
    ofBuilt->PreserveTopologyOn(); // too late
    EXPECT_FALSE(TopologyOf(Updated(ofBuilt)) == full);
    EXPECT_EQ(messages->WarningCount, 1);
    builder->PreserveTopologyOn();
    EXPECT_EQ(test::SortedTriangles(Updated(ofBuilt)), expected);
    EXPECT_TRUE(builder->GetHierarchy()->GetPreservesTopology());
    EXPECT_EQ(messages->WarningCount, 1);
  }
}

// In a box the surface's pieces separate the sets of samples, so there is one set more than pieces.
// That shows that the neighbours in Sides are those of the mesh.
TEST(SmallPieces, AreThoseOfAFloodFill)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(NoisyImage());
  contour->SetValue(0, Isovalue);
  EXPECT_EQ(contour->GetMinimumPieceSize(), 0);
  EXPECT_EQ(contour->GetNumberOfRemovedPieces(), 0);
  vtkIdType previous = 0;
  for (const int size : { 0, 1, 2, 3, 10, 100 })
  {
    Sides sides(NoisyImage(), Isovalue);
    const vtkIdType removed = sides.RemoveSmall(size);
    contour->SetMinimumPieceSize(size);
    const auto pieces = static_cast<vtkIdType>(TopologyOf(Updated(contour)).size());
    EXPECT_EQ(pieces, sides.Count() - 1) << "of " << size;
    EXPECT_EQ(contour->GetNumberOfRemovedPieces(), removed) << "of " << size;
    EXPECT_GE(removed, previous);
    previous = removed;
  }
  EXPECT_GT(previous, 50);
}

TEST(SmallPieces, OfAnIntervalVolumeAreThoseOfItsSurfaces)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(NoisyImage());
  volume->SetIsorange(Isovalue, std::numeric_limits<double>::infinity());
  volume->SetMinimumPieceSize(10);
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfRemovedPieces(), RemovedAt(Isovalue, 10));
  volume->SetIsorange(Isovalue, 110.0);
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfRemovedPieces(), RemovedAt(Isovalue, 10) + RemovedAt(110.0, 10));
}

TEST(SmallPieces, AreCountedOverIsovaluesAndBlocks)
{
  const vtkIdType removed = RemovedAt(Isovalue, 10);
  const vtkIdType together = removed + RemovedAt(70.0, 10);
  EXPECT_GT(removed, 0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(NoisyImage());
  contour->SetValue(0, Isovalue);
  contour->SetMinimumPieceSize(10);
  const auto counted = [&]
  {
    contour->Update();
    return contour->GetNumberOfRemovedPieces();
  };
  EXPECT_EQ(counted(), removed);
  contour->SetErrorTolerance(0.5); // from the hierarchy that is kept
  EXPECT_EQ(counted(), removed);
  contour->SetValue(1, 70.0);
  EXPECT_EQ(counted(), together);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, NoisyImage());
  blocks->SetBlock(1, NoisyImage());
  contour->SetInputDataObject(blocks);
  EXPECT_EQ(counted(), 2 * together);
  contour->SetInputData(NoisyImage());
  contour->SetValue(1, std::numeric_limits<double>::quiet_NaN());
  const auto messages = test::Watch(contour);
  EXPECT_EQ(counted(), 0);
  EXPECT_EQ(messages->ErrorCount, 1);
  contour->SetNumberOfContours(1);
  EXPECT_EQ(counted(), removed);
}

TEST(SmallPieces, AreKnownToTheHierarchy)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(NoisyImage());
  builder->SetIsovalue(Isovalue);
  builder->SetMinimumPieceSize(10);
  for (const int model : { vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
  {
    builder->SetModel(model);
    builder->Update();
    vtkIsodiamondHierarchy* hierarchy = builder->GetHierarchy();
    EXPECT_EQ(hierarchy->GetMinimumPieceSize(), 10);
    EXPECT_EQ(hierarchy->GetNumberOfRemovedPieces(), RemovedAt(Isovalue, 10));
    EXPECT_EQ(hierarchy->GetFieldData()->GetArray("NumberOfRemovedPieces")->GetTuple1(0),
      hierarchy->GetNumberOfRemovedPieces());
  }
}
