// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Parallel/Parts.h"

#include "Private/Common/Arrays.h"
#include "Private/Input/Grid.h"
#include "Private/Input/Request.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

namespace vtkIsodiamond
{
namespace
{

bool IsEmpty(const Extent& extent)
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}

Extent ExtentOf(vtkImageData* image)
{
  Extent extent;
  image->GetExtent(extent.data());
  return extent;
}

Extent Shared(const Extent& a, const Extent& b)
{
  return { std::max(a[0], b[0]), std::min(a[1], b[1]), std::max(a[2], b[2]), std::min(a[3], b[3]),
    std::max(a[4], b[4]), std::min(a[5], b[5]) };
}

/** The cells between samples. */
Extent CellsOf(const Extent& samples)
{
  return { samples[0], samples[1] - 1, samples[2], samples[3] - 1, samples[4], samples[5] - 1 };
}

vtkIdType RowLength(const Extent& extent)
{
  return extent[1] - extent[0] + 1;
}

vtkIdType TuplesOf(const Extent& extent)
{
  return IsEmpty(extent)
    ? 0
    : RowLength(extent) * (extent[3] - extent[2] + 1) * (extent[5] - extent[4] + 1);
}

/** Calls body(y, z, tuple) for all rows, with the number of their first tuple. */
template <typename Body>
void ForEachRow(const Extent& rows, const Extent& ofArray, Body&& body)
{
  for (int z = rows[4]; z <= rows[5]; ++z)
  {
    for (int y = rows[2]; y <= rows[3]; ++y)
    {
      const vtkIdType row =
        vtkIdType{ z - ofArray[4] } * (ofArray[3] - ofArray[2] + 1) + y - ofArray[2];
      body(y, z, row * RowLength(ofArray) + rows[0] - ofArray[0]);
    }
  }
}

/** Copies what two arrays, each of an extent, have in common. */
void CopyShared(vtkDataArray* from, const Extent& ofFrom, vtkDataArray* to, const Extent& ofTo)
{
  const Extent shared = Shared(ofFrom, ofTo);
  if (IsEmpty(shared))
  {
    return;
  }
  std::vector<vtkIdType> rows;
  ForEachRow(shared, ofFrom, [&](int, int, vtkIdType tuple) { rows.push_back(tuple); });
  auto row = rows.cbegin();
  ForEachRow(shared, ofTo,
    [&](int, int, vtkIdType tuple) { to->InsertTuples(tuple, RowLength(shared), *row++, from); });
}

/** What a ghost array, which may be null, marks as blanked. */
vtkSmartPointer<vtkUnsignedCharArray> BlanksOf(
  vtkUnsignedCharArray* ghosts, vtkIdType tuples, int blank)
{
  auto blanks = NewArray<vtkUnsignedCharArray>(vtkDataSetAttributes::GhostArrayName(), tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    blanks->SetValue(i, ghosts ? ghosts->GetValue(i) & blank : 0);
  }
  return blanks;
}

bool IsAnySet(vtkUnsignedCharArray* array)
{
  const unsigned char* begin = array->GetPointer(0);
  return std::any_of(
    begin, begin + array->GetNumberOfTuples(), [](unsigned char value) { return value != 0; });
}

/** The arrays at the points, except ghosts and those that number points. */
std::vector<vtkDataArray*> PointArraysOf(vtkImageData* image)
{
  vtkPointData* data = image->GetPointData();
  std::vector<vtkDataArray*> arrays;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (array && array != image->GetPointGhostArray() && array != data->GetGlobalIds() &&
      array != data->GetPedigreeIds() && array->GetDataType() != VTK_BIT)
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

/** The samples of the cells that are not ghosts of other processes' cells. */
Extent OwnExtent(vtkImageData* image)
{
  const Extent all = ExtentOf(image);
  vtkUnsignedCharArray* ghosts = image->GetCellGhostArray();
  if (!ghosts || IsEmpty(CellsOf(all)))
  {
    return all;
  }
  Extent own = { VTK_INT_MAX, VTK_INT_MIN, VTK_INT_MAX, VTK_INT_MIN, VTK_INT_MAX, VTK_INT_MIN };
  const Extent cells = CellsOf(all);
  ForEachRow(cells, cells,
    [&](int y, int z, vtkIdType row)
    {
      for (int x = cells[0]; x <= cells[1]; ++x)
      {
        if ((ghosts->GetValue(row + x - cells[0]) & vtkDataSetAttributes::DUPLICATECELL) == 0)
        {
          own = { std::min(own[0], x), std::max(own[1], x + 1), std::min(own[2], y),
            std::max(own[3], y + 1), std::min(own[4], z), std::max(own[5], z + 1) };
        }
      }
    });
  return own;
}

/** What has to be the same in all parts. */
std::uint64_t KindOf(vtkImageData* image, const Extent& whole)
{
  std::ostringstream text;
  text.precision(17);
  const double* directions = image->GetDirectionMatrix()->GetData();
  const auto write = [&](const auto* values, int count)
  { std::for_each(values, values + count, [&](auto value) { text << value << ' '; }); };
  write(whole.data(), 6);
  write(image->GetOrigin(), 3);
  write(image->GetSpacing(), 3);
  write(directions, 9);
  for (vtkDataArray* array : PointArraysOf(image))
  {
    text << (array->GetName() ? array->GetName() : "") << ' ' << array->GetDataType() << ' '
         << array->GetNumberOfComponents() << ' ';
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  text << (scalars && scalars->GetName() ? scalars->GetName() : "");
  return std::hash<std::string>()(text.str());
}

void Check(int success)
{
  if (success == 0)
  {
    throw std::runtime_error("The processes that work together cannot reach each other.");
  }
}

/** Whether extents cover a whole along an axis and the axes below it. */
bool CoverAlong(int axis, const std::vector<Extent>& parts, const Extent& whole)
{
  if (axis < 0)
  {
    return !parts.empty();
  }
  const int low = 2 * axis;
  // Between successive places where parts begin or end, the same parts are present.
  std::vector<int> begins = { whole[low] };
  for (const Extent& part : parts)
  {
    begins.insert(begins.end(), { part[low], part[low + 1] + 1 });
  }
  std::sort(begins.begin(), begins.end());
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  return std::all_of(begins.begin(), begins.end(),
    [&](int begin)
    {
      std::vector<Extent> there;
      std::copy_if(parts.begin(), parts.end(), std::back_inserter(there),
        [&](const Extent& part) { return part[low] <= begin && begin <= part[low + 1]; });
      return begin < whole[low] || begin > whole[low + 1] || CoverAlong(axis - 1, there, whole);
    });
}

/** Whether extents cover all samples of a whole. */
bool Cover(const std::vector<Extent>& parts, const Extent& whole)
{
  return CoverAlong(2, parts, whole);
}

}

Parts::Parts(vtkInformation* input, const ControllerPeers& peers)
  : Others(peers)
  , Own(vtkImageData::GetData(input))
  , Whole(WholeExtentOf(input))
{
  std::vector<std::uint64_t> kinds(peers.Count(), 0);
  std::vector<Extent> extents(peers.Count(), Extent{});
  this->Others.Together(
    [&]
    {
      CheckGhosts(this->Own->GetPointGhostArray(), this->Own->GetNumberOfPoints());
      CheckGhosts(this->Own->GetCellGhostArray(), this->Own->GetNumberOfCells());
      const Extent own = OwnExtent(this->Own);
      if (IsEmpty(own))
      {
        throw std::invalid_argument("A process has no part of the volume.");
      }
      extents[peers.Rank()] = own;
      kinds[peers.Rank()] = KindOf(this->Own, this->Whole);
      const Extent all = ExtentOf(this->Own);
      this->BlankPoints =
        BlanksOf(this->Own->GetPointGhostArray(), TuplesOf(all), vtkDataSetAttributes::HIDDENPOINT);
      this->BlankCells = BlanksOf(this->Own->GetCellGhostArray(), TuplesOf(CellsOf(all)),
        vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL);
    });
  isodiamond::Peers& others = this->Others;
  others.Or(kinds);
  others.Or(extents);
  this->Extents = extents;
  this->Blanks = this->Others.Any(IsAnySet(this->BlankPoints) || IsAnySet(this->BlankCells));
  if (!this->Blanks)
  {
    this->BlankPoints = nullptr;
    this->BlankCells = nullptr;
  }
  if (std::any_of(kinds.begin(), kinds.end(), [&](std::uint64_t kind) { return kind != kinds[0]; }))
  {
    throw std::invalid_argument("The processes' parts of the volume do not fit: they have another "
                                "place in the world, or other arrays.");
  }
  if (!Cover(this->Extents, this->Whole))
  {
    throw std::invalid_argument("The processes' parts of the volume leave some of it out.");
  }
}

std::vector<Parts::Located> Parts::ArraysIn(const Extent& extent, vtkDataArray* only) const
{
  const Extent all = ExtentOf(this->Own);
  std::vector<Located> arrays;
  const auto add = [&](vtkDataArray* array, const Extent& ofArray, const Extent& wanted)
  {
    const vtkSmartPointer<vtkDataArray> copy = NewLike(array, TuplesOf(wanted));
    if (array == this->BlankCells)
    {
      copy->Fill(0.0); // between two parts there may be cells that are in neither of them
    }
    CopyShared(array, ofArray, copy, wanted);
    arrays.push_back({ copy, wanted, array == this->BlankCells,
      array == this->Own->GetPointData()->GetScalars() });
  };
  for (vtkDataArray* array : PointArraysOf(this->Own))
  {
    if (!only || array == only)
    {
      add(array, all, extent);
    }
  }
  if (this->Blanks)
  {
    add(this->BlankPoints, all, extent);
    add(this->BlankCells, CellsOf(all), CellsOf(extent));
  }
  return arrays;
}

vtkSmartPointer<vtkImageData> Parts::Gather(
  int first, int last, vtkDataArray* only, int owner) const
{
  Extent slices = this->Whole;
  slices[4] = this->Whole[4] + first;
  slices[5] = this->Whole[4] + last;
  const int rank = this->Others.Rank();
  const int target = owner == Everyone ? 0 : owner;
  std::vector<Located> arrays; // all that is wanted, or what the target gets from here
  this->Others.Together(
    [&] {
      arrays = this->ArraysIn(rank == target ? slices : Shared(this->Extents[rank], slices), only);
    });
  this->Exchange(slices, target, arrays);
  if (owner == Everyone)
  {
    for (const Located& array : arrays)
    {
      Check(this->Others.Processes()->Broadcast(array.Array, target));
    }
  }
  return rank == target || owner == Everyone ? this->ImageOf(slices, arrays) : nullptr;
}

void Parts::Exchange(const Extent& slices, int target, std::vector<Located>& arrays) const
{
  constexpr int tag = 7302;
  vtkMultiProcessController* controller = this->Others.Processes();
  const int rank = this->Others.Rank();
  for (int process = 0; process < this->Others.Count(); ++process)
  {
    const Extent theirs = Shared(this->Extents[process], slices);
    if (process == target || IsEmpty(theirs) || (rank != process && rank != target))
    {
      continue;
    }
    for (Located& array : arrays)
    {
      if (rank == process)
      {
        Check(controller->Send(array.Array, target, tag));
      }
      else
      {
        const vtkSmartPointer<vtkDataArray> received = NewLike(array.Array, 0);
        Check(controller->Receive(received, process, tag));
        CopyShared(received, array.IsOfCells ? CellsOf(theirs) : theirs, array.Array, array.Of);
      }
    }
  }
}

vtkSmartPointer<vtkImageData> Parts::ImageOf(
  const Extent& slices, const std::vector<Located>& arrays) const
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(this->Own);
  image->SetExtent(slices[0], slices[1], slices[2], slices[3], slices[4], slices[5]);
  for (const Located& array : arrays)
  {
    vtkDataSetAttributes* data = array.IsOfCells
      ? static_cast<vtkDataSetAttributes*>(image->GetCellData())
      : image->GetPointData();
    const int index = data->AddArray(array.Array);
    if (array.AreScalars)
    {
      data->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  return image;
}

}
