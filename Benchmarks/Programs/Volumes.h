// SPDX-License-Identifier: BSD-3-Clause
#ifndef Volumes_h
#define Volumes_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

/**
 * @file Volumes.h
 * What is measured on: synthetic volumes, and volumes from files.
 */
namespace benchmark
{

/** A volume, and the values of the surface and the interval volume to extract from it. */
struct Volume
{
  std::string Name; ///< of the field or file
  vtkSmartPointer<vtkImageData> Image;
  double Isovalue = 0.0;
  std::array<double, 2> Isorange{};

  std::array<double, 2> Range() const; ///< of the samples
  double Voxel() const;                ///< the shortest side of one
};

/** Volumes are made when their turn comes: large ones do not fit into memory together. */
struct VolumeSource
{
  std::string Name;
  std::function<Volume()> Make;
};

/** The names of the synthetic fields. */
std::vector<std::string> FieldNames();

/**
 * A synthetic field, sampled. Deterministic, even its noise; the field is a function of the
 * position in the cube, so that sizes can be compared.
 *
 * @throws std::invalid_argument for an unknown name
 */
VolumeSource SyntheticVolume(const std::string& field, int size);

/**
 * A volume from a file: NAME_XxYxZ_TYPE.raw (little endian; uint8, int16, uint16 or float32),
 * .nrrd, .nhdr, .nii or .nii.gz.
 *
 * @param argument FILE, FILE:ISOVALUE or FILE:ISOVALUE:LOWER:UPPER; for what is left out, the
 *        paper's values for its volumes are taken, else some from the samples' range
 * @throws std::invalid_argument, or std::runtime_error from Make(), saying what is wrong
 */
VolumeSource VolumeFile(const std::string& argument);

/** The volume padded with zeros at its high sides to (2^N + 1)^3, as for the paper's Table 2. */
Volume PadAsPaper(const Volume& volume);

}

#endif
