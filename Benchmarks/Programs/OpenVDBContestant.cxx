// SPDX-License-Identifier: BSD-3-Clause
// Compiled only if OpenVDB is found.
#include "OtherContestants.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/task_arena.h>

#include <sstream>

namespace benchmark
{
namespace
{

/** The volume as a grid without empty parts. Values outside are less than all inside, so the
 *  surface is closed at the boundary. */
openvdb::FloatGrid::Ptr MakeGrid(const Volume& volume)
{
  openvdb::initialize();
  vtkNew<vtkFloatArray> samples;
  samples->DeepCopy(volume.Image->GetPointData()->GetScalars());
  int dimensions[3];
  volume.Image->GetDimensions(dimensions);
  const openvdb::CoordBBox box(
    openvdb::Coord(0), openvdb::Coord(dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1));
  const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, samples->GetPointer(0));
  auto grid = openvdb::FloatGrid::create(static_cast<float>(volume.Range()[0]) - 1.0F);
  openvdb::tools::copyFromDense(dense, *grid, 0.0F);
  return grid;
}

struct Mesh
{
  std::vector<openvdb::Vec3s> Points;
  std::vector<openvdb::Vec3I> Triangles;
  std::vector<openvdb::Vec4I> Quads;
};

}

std::vector<Contestant> OpenVDBContestants(const Task& task)
{
  const auto grid = std::make_shared<openvdb::FloatGrid::Ptr>();
  std::vector<Contestant> contestants;
  for (const double adaptivity : { 0.0, 0.1, 0.5 })
  {
    const auto mesh = std::make_shared<Mesh>();
    std::ostringstream name;
    name << "OpenVDB volumeToMesh, adaptivity " << adaptivity;
    Contestant contestant;
    contestant.Name = name.str();
    contestant.Prepare = [grid, &volume = task.Volume]
    { *grid = *grid ? *grid : MakeGrid(volume); };
    contestant.Run = [grid, mesh, adaptivity, task]
    {
      tbb::task_arena(task.Threads > 0 ? task.Threads : tbb::task_arena::automatic)
        .execute(
          [&]
          {
            openvdb::tools::volumeToMesh(
              **grid, mesh->Points, mesh->Triangles, mesh->Quads, task.Volume.Isovalue, adaptivity);
          });
    };
    contestant.Describe = [mesh](Figures& figures)
    {
      figures.Set("cells", mesh->Triangles.size() + 2 * mesh->Quads.size()); // as triangles
      figures.Set("points", mesh->Points.size());
    };
    contestant.Release = [mesh] { *mesh = {}; };
    contestant.StartsFromVolume = true;
    contestants.push_back(contestant);
  }
  return contestants;
}

}
