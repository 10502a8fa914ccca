# SPDX-License-Identifier: BSD-3-Clause
"""The volumes of several benchmarks."""
import argparse
import re

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkExtractVOI
from vtkmodules.vtkIOImage import vtkNIFTIImageReader

HEAD = "/usr/share/mricron/templates/ch2.nii.gz"
HEAD_ISOVALUE = 40.5  # between air and skin


def parser_of_size(description, default):
    """A parser of a script's options, of which the size of its volumes is the first."""
    parser = argparse.ArgumentParser(description=description.split("\n", 1)[0])
    parser.add_argument("size", nargs="?", type=int, default=default, help="samples on each axis (%(default)s)")
    return parser


def image_of(field):
    image = vtkImageData()
    image.SetDimensions(field.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(field.ravel(), deep=True))
    return image


def gyroid(axis):
    """Sheets all over a cube, with a period of 2 pi, at these coordinates on each axis."""
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    sin, cos = numpy.sin, numpy.cos
    return sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x)


def phantom(size):
    """CT of a tilted block with bores, a slot and fins: 100 inside, 0 outside; edges are blurred
    over two voxels, and there is noise."""
    axis = (numpy.arange(size) - (size - 1) / 2) / size
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij", sparse=True)
    sin, cos = numpy.sin(0.2), numpy.cos(0.2)
    x, y = cos * x - sin * y, sin * x + cos * y
    y, z = cos * y - sin * z, sin * y + cos * z

    def box(half_x, half_y, half_z, center_y=0.0, center_z=0.0):
        """Positive inside."""
        across = numpy.minimum(half_y - abs(y - center_y), half_z - abs(z - center_z))
        return numpy.minimum(half_x - abs(x), across)

    inside = box(0.36, 0.16, 0.26)
    for level in (-0.2, -0.12, -0.04, 0.04, 0.12, 0.2):
        inside = numpy.maximum(inside, box(0.36, 0.24, 0.012, center_z=level))
    for center in (-0.22, 0, 0.22):  # with walls of 0.02 between
        inside = numpy.minimum(inside, numpy.hypot(x - center, y) - 0.1)
    inside = numpy.minimum(inside, numpy.hypot(y, z) - 0.03)
    inside = numpy.minimum(inside, -box(0.3, 0.02, 0.06, center_y=0.13, center_z=0.26))
    noise = numpy.random.default_rng(1).standard_normal(inside.shape)
    logistic = 50 + 50 * numpy.tanh(inside * size / 0.9)
    return image_of((logistic + 2 * noise).astype(numpy.float32))


def head():
    reader = vtkNIFTIImageReader()
    reader.SetFileName(HEAD)
    reader.Update()
    return reader.GetOutput()


def raw_volume(argument):
    """Name, image and isovalue."""
    path, isovalue = argument.rsplit(":", 1)
    match = re.fullmatch(r"(?:.*/)?(.+)_(\d+)x(\d+)x(\d+)_uint8\.raw", path)
    if not match:
        raise ValueError("another kind of name")
    name, *shape = match.groups()
    field = numpy.fromfile(path, dtype=numpy.uint8)
    return name, image_of(field.reshape([int(n) for n in reversed(shape)])), float(isovalue)


def cropped(image, extent):
    """A part of an image, at the same place."""
    extract = vtkExtractVOI()
    extract.SetInputData(image)
    extract.SetVOI(extent)
    extract.Update()
    return extract.GetOutput()
