# SPDX-License-Identifier: BSD-3-Clause
"""An isosurface and an interval volume of a volume at several error tolerances and with a region of
interest; run by demo.sh."""

import argparse
import contextlib
import math
import os
import statistics
import sys
import time

from isodiamonds import vtkIsodiamondBuilder, vtkIsodiamondExtractor
from vtkmodules.vtkCommonCore import vtkLogger, vtkLookupTable, vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSetAttributes, vtkPlane
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkIOImage import (
    vtkMetaImageReader,
    vtkNIFTIImageReader,
    vtkNrrdReader,
    vtkPNGWriter,
)
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkIOLegacy import vtkStructuredPointsReader
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataReader,
    vtkXMLPolyDataReader,
    vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCamera,
    vtkDataSetMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (draws text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (draws everything else)

HEAD = "/usr/share/mricron/templates/ch2.nii.gz"
HEAD_ISOVALUE = 40.5  # between air and skin

READERS = {
    ".vti": vtkXMLImageDataReader,
    ".nrrd": vtkNrrdReader,
    ".nhdr": vtkNrrdReader,
    ".mhd": vtkMetaImageReader,
    ".mha": vtkMetaImageReader,
    ".nii": vtkNIFTIImageReader,
    ".nii.gz": vtkNIFTIImageReader,
    ".vtk": vtkStructuredPointsReader,
}

TOLERANCES = (0, 0.1, 0.25, 0.5, 1)  # distances, in voxels
SHOWN_VOLUMES = (2, 4)  # of the tolerances, in the picture of the interval volume

PICTURE_SIZE = (2000, 940)
OVERSAMPLING = 2  # for thin, smooth edges
CAPTION_HEIGHT = 0.1  # of the picture
WHOLE_HEIGHT = 0.41  # the row of whole surfaces, above the row of close-ups
FRONT = (0.45, 1, 0)
SIDE = (1, 0.25, 0.2)
VOLUME_PICTURE_SIZE = (2000, 1000)
VOLUME_CAPTION_HEIGHT = 0.09
REGION_PICTURE_SIZE = (2000, 1000)
# Around the left eye, in parts of the surface's box: full detail there, elsewhere a tolerance of
# REGION_OUTSIDE voxels.
REGION = ((0.5, 0.72), (0.5, 1.0), (0.05, 0.26))
REGION_OUTSIDE = 1
REGION_EDGE_COLOR = (0.3, 0.33, 0.36)
CLOSE_UP = (0.35, 0, 0.3)  # where in the surface's box, then moved onto the surface
CLOSE_UP_SIZE = 0.16  # of the whole view
EDGE_LIMIT = 150_000  # triangles of a whole surface; denser edges only blacken it
BACKGROUND = (0.97, 0.97, 0.98)
SURFACE_COLOR = (0.93, 0.78, 0.68)
EDGE_COLOR = (0.33, 0.22, 0.17)
TEXT_COLOR = (0.15, 0.15, 0.18)


class DemoError(Exception):
    """An error that the user is told, on one line."""


class ErrorLog:
    """Keeps the errors of VTK, in place of VTK's own report of several lines."""

    def __init__(self):
        self.count = 0
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        vtkOutputWindow.GetInstance().AddObserver("ErrorEvent", self.add)

    def add(self, _window, _event):
        self.count += 1


@contextlib.contextmanager
def silent_standard_error():
    """Some readers' libraries write to the process's standard error, past VTK."""
    sys.stderr.flush()
    saved = os.dup(2)
    with open(os.devnull, "wb") as nothing:
        os.dup2(nothing.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(saved, 2)
        os.close(saved)


def timed(algorithm):
    """Milliseconds of one execution."""
    algorithm.Modified()
    start = time.perf_counter()
    algorithm.Update()
    return 1000 * (time.perf_counter() - start)


def median_time(algorithm):
    return statistics.median(timed(algorithm) for _ in range(3))


def read_volume(path, errors):
    """The image in a file, with its array as the point scalars."""
    extension = next((e for e in READERS if path.lower().endswith(e)), None)
    if extension is None:
        raise DemoError(f"unknown kind of file: '{path}'")
    reader = READERS[extension]()
    reader.SetFileName(path)
    with silent_standard_error():
        reader.Update()
    image = reader.GetOutput()
    if errors.count or image.GetNumberOfPoints() == 0:
        raise DemoError(f"cannot read '{path}': damaged, or not the kind of file its name says")
    if min(image.GetDimensions()) < 2:
        raise DemoError(f"'{path}' is not a volume: it has {image.GetDimensions()} samples")
    point_data = image.GetPointData()
    # Some writers name no active scalars: then the first array is taken.
    array = point_data.GetScalars() or point_data.GetArray(0)
    if array is None:
        raise DemoError(f"'{path}' has no point scalars")
    if array.GetNumberOfComponents() != 1:
        raise DemoError(f"'{path}' has {array.GetNumberOfComponents()} components a point, not one")
    point_data.SetScalars(array)
    return image


def use_scalars(algorithm):
    algorithm.SetInputArrayToProcess(
        0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes.SCALARS
    )


def build(image, prepare):
    """A minimal hierarchy, built as prepare(builder) sets it up, and the seconds that it took."""
    builder = vtkIsodiamondBuilder()
    builder.SetInputData(image)
    use_scalars(builder)
    builder.SetModelToMinimal()
    builder.SetErrorMetricToDistance()
    builder.PreserveTopologyOn()
    prepare(builder)
    milliseconds = timed(builder)
    return builder.GetHierarchy(), milliseconds / 1000


def extract(hierarchy, tolerance):
    extractor = vtkIsodiamondExtractor()
    extractor.SetInputData(hierarchy)
    extractor.SetErrorTolerance(tolerance)
    milliseconds = median_time(extractor)
    return extractor.GetOutput(), milliseconds


def in_voxels(tolerance):
    return f"{tolerance:g} voxel{'' if tolerance == 1 else 's'}"


def extract_region(hierarchy, surface, voxel):
    """Full detail in a box, less outside."""
    bounds = surface.GetBounds()
    extractor = vtkIsodiamondExtractor()
    extractor.SetInputData(hierarchy)
    extractor.UseRegionOfInterestOn()
    extractor.SetRegionOfInterest(
        [
            bounds[2 * axis] + part * (bounds[2 * axis + 1] - bounds[2 * axis])
            for axis, ends in enumerate(REGION)
            for part in ends
        ]
    )
    extractor.SetOutsideErrorTolerance(REGION_OUTSIDE * voxel)
    milliseconds = median_time(extractor)
    return extractor.GetOutput(), milliseconds


def extract_levels(hierarchy, voxel, noun):
    """Extracts and lists all levels. Yields each mesh with its caption."""
    print(f"{'tolerance':>18} {noun:>12} {'ms':>8}")
    for tolerance in TOLERANCES:
        mesh, milliseconds = extract(hierarchy, tolerance * voxel)
        cells = mesh.GetNumberOfCells()
        label = in_voxels(tolerance)
        print(f"{label:>18} {cells:>12,} {milliseconds:>8.1f}", flush=True)
        yield mesh, f"tolerance {label}\n{cells:,} {noun}"


def print_flying_edges(image, isovalue):
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    use_scalars(contour)
    contour.SetValue(0, isovalue)
    contour.ComputeNormalsOff()
    contour.ComputeScalarsOff()
    milliseconds = median_time(contour)
    print(
        f"For orientation, vtkFlyingEdges3D (full resolution, no normals, VTK's own threading):"
        f" {contour.GetOutput().GetNumberOfCells():,} triangles, {milliseconds:.0f} ms"
    )


def print_sizes(hierarchy, points, cells, bytes_of_cell):
    mesh_size = 12 * points + bytes_of_cell * cells
    size = hierarchy.GetStorageSize()
    print(
        f"Hierarchy: {size:,} bytes; indexed mesh of the full resolution: {mesh_size:,} bytes"
        f" ({mesh_size / size:.1f} times as many)"
    )


class Files:
    """What was written to the output folder."""

    def __init__(self, folder):
        self.folder = folder
        self.paths = []

    def write(self, writer, name, data):
        path = os.path.join(self.folder, name)
        writer.SetFileName(path)
        writer.SetInputData(data)
        if hasattr(writer, "SetDataModeToBinary"):
            writer.SetDataModeToBinary()  # see README.md on files
        writer.Write()
        if writer.GetErrorCode():
            raise DemoError(f"cannot write '{path}'")
        self.paths.append(path)
        return path


def mesh_actor(mesh, edges):
    mapper = vtkDataSetMapper()
    mapper.SetInputData(mesh)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(SURFACE_COLOR)
    look.SetEdgeColor(EDGE_COLOR)
    look.SetEdgeVisibility(edges)
    return actor


def caption(text, center):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(center, 0.5)
    look = actor.GetTextProperty()
    look.SetFontSize(24 * OVERSAMPLING)
    look.SetLineSpacing(1.2)
    look.SetColor(TEXT_COLOR)
    look.SetJustificationToCentered()
    look.SetVerticalJustificationToCentered()
    return actor


def front_camera(surface, aspect, direction=FRONT):
    """A camera whose view the surface fills, in front of a NIfTI head (y to the nose, z up).
    @param aspect width of the view divided by its height
    @param direction from the surface to the camera"""
    camera = vtkCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(direction)
    camera.SetViewUp(0, 0, 1)
    to_view = vtkTransform()
    to_view.SetMatrix(camera.GetViewTransformMatrix())
    points = vtkPoints()
    to_view.TransformPoints(surface.GetPoints(), points)
    x0, x1, y0, y1, z0, z1 = points.GetBounds()
    center = to_view.GetInverse().TransformPoint((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2)
    camera.SetParallelScale(1.12 * max(y1 - y0, (x1 - x0) / aspect) / 2)
    return look_at(camera, center, surface.GetLength(), direction)


def close_up_camera(surface, whole):
    """The view of another camera, but only of a part of the surface."""
    camera = vtkCamera()
    camera.DeepCopy(whole)
    camera.SetParallelScale(CLOSE_UP_SIZE * whole.GetParallelScale())
    bounds = surface.GetBounds()
    # From the front: y is counted from the far end.
    x, y, z = CLOSE_UP
    target = [
        bounds[0] + x * (bounds[1] - bounds[0]),
        bounds[3] - y * (bounds[3] - bounds[2]),
        bounds[4] + z * (bounds[5] - bounds[4]),
    ]
    return look_at(camera, surface.GetPoint(surface.FindPoint(target)), surface.GetLength())


def look_at(camera, point, distance, direction=FRONT):
    camera.SetFocalPoint(point)
    camera.SetPosition([p + distance * d for p, d in zip(point, direction)])
    return camera


def add_view(window, viewport, camera, actor):
    renderer = vtkRenderer()
    renderer.SetBackground(BACKGROUND)
    renderer.SetViewport(viewport)
    renderer.SetActiveCamera(camera)
    renderer.AddActor(actor)
    renderer.ResetCameraClippingRange()
    window.AddRenderer(renderer)


def draw(surfaces, captions):
    """The surfaces side by side: whole, closer with all edges, and a caption under each."""
    count = len(surfaces)
    window, text = make_window(PICTURE_SIZE, CAPTION_HEIGHT)
    whole = front_camera(surfaces[0], PICTURE_SIZE[0] / count / (PICTURE_SIZE[1] * WHOLE_HEIGHT))
    closer = close_up_camera(surfaces[0], whole)
    for i, surface in enumerate(surfaces):
        left, right = i / count, (i + 1) / count
        middle = 1 - WHOLE_HEIGHT
        actor = mesh_actor(surface, surface.GetNumberOfCells() < EDGE_LIMIT)
        add_view(window, (left, middle, right, 1), whole, actor)
        actor = mesh_actor(surface, True)
        add_view(window, (left, CAPTION_HEIGHT, right, middle), closer, actor)
        text.AddActor(caption(captions[i], (i + 0.5) / count))
    return grab_window(window)


def draw_volumes(volumes, captions, bounds, value_range):
    """Interval volumes side by side, cut open between their tetrahedra, coloured by value."""
    count = len(volumes)
    window, text = make_window(VOLUME_PICTURE_SIZE, VOLUME_CAPTION_HEIGHT)
    # The left half, seen from the right.
    plane = vtkPlane()
    plane.SetOrigin([(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)])
    plane.SetNormal(1, 0, 0)
    colours = vtkLookupTable()
    colours.SetHueRange(0.05, 0.12)
    colours.SetSaturationRange(0.45, 0.15)
    colours.SetValueRange(0.75, 1)
    camera = None
    for i, volume in enumerate(volumes):
        half = vtkExtractGeometry()
        half.SetInputData(volume)
        half.SetImplicitFunction(plane)
        half.Update()
        actor = mesh_actor(half.GetOutput(), True)
        mapper = actor.GetMapper()
        mapper.ScalarVisibilityOn()
        mapper.InterpolateScalarsBeforeMappingOn()
        mapper.SetScalarRange(value_range)
        mapper.SetLookupTable(colours)
        if camera is None:
            width, height = VOLUME_PICTURE_SIZE
            aspect = width / count / (height * (1 - VOLUME_CAPTION_HEIGHT))
            camera = front_camera(half.GetOutput(), aspect, SIDE)
        add_view(window, (i / count, VOLUME_CAPTION_HEIGHT, (i + 1) / count, 1), camera, actor)
        text.AddActor(caption(captions[i], (i + 0.5) / count))
    return grab_window(window)


def colour_by_level(actor, levels):
    colours = vtkLookupTable()
    colours.SetNumberOfTableValues(levels)
    colours.SetTableRange(-0.5, levels - 0.5)
    colours.SetHueRange(0.66, 0.05)
    colours.SetSaturationRange(0.3, 0.6)
    colours.SetValueRange(0.95, 1)
    colours.ForceBuild()
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Level")
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()


def draw_regions(surface, volume, captions, bounds):
    """A surface and half of an interval volume, both with a region of interest."""
    window, text = make_window(REGION_PICTURE_SIZE, VOLUME_CAPTION_HEIGHT)
    width, height = REGION_PICTURE_SIZE
    aspect = width / 2 / (height * (1 - VOLUME_CAPTION_HEIGHT))
    plane = vtkPlane()
    plane.SetOrigin([0.4 * bounds[2 * a] + 0.6 * bounds[2 * a + 1] for a in range(3)])
    plane.SetNormal(1, 0, 0)
    half = vtkExtractGeometry()
    half.SetInputData(volume)
    half.SetImplicitFunction(plane)
    half.Update()
    levels = int(surface.GetCellData().GetArray("Level").GetRange()[1]) + 1
    for i, (mesh, direction) in enumerate(((surface, FRONT), (half.GetOutput(), SIDE))):
        actor = mesh_actor(mesh, True)
        actor.GetProperty().SetEdgeColor(REGION_EDGE_COLOR)
        actor.GetProperty().SetLineWidth(0.5 * OVERSAMPLING)
        colour_by_level(actor, levels)
        camera = front_camera(mesh, aspect, direction)
        add_view(window, (i / 2, VOLUME_CAPTION_HEIGHT, (i + 1) / 2, 1), camera, actor)
        text.AddActor(caption(captions[i], (i + 0.5) / 2))
    return grab_window(window)


def make_window(size, caption_height):
    """A window, and the renderer of the captions at its foot."""
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize([OVERSAMPLING * s for s in size])
    text = vtkRenderer()
    text.SetBackground(BACKGROUND)
    text.SetViewport(0, 0, 1, caption_height)
    window.AddRenderer(text)
    return window, text


def grab_window(window):
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    shrink = vtkImageShrink3D()
    shrink.SetInputConnection(grab.GetOutputPort())
    shrink.SetShrinkFactors(OVERSAMPLING, OVERSAMPLING, 1)
    shrink.MeanOn()
    shrink.Update()
    return shrink.GetOutput()


def check_reload(path, full):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    again, _ = extract(reader.GetOutput(), 0)
    sizes = [(mesh.GetNumberOfPoints(), mesh.GetNumberOfCells()) for mesh in (full, again)]
    if sizes[0] != sizes[1]:
        raise DemoError(f"the reloaded hierarchy gives another surface: {sizes[1]}, not {sizes[0]}")
    print("Reloaded hierarchy: same surface")


def run(arguments, errors):
    path = arguments.file or HEAD
    image = read_volume(path, errors)
    low, high = image.GetPointData().GetScalars().GetFiniteRange(0)
    isovalue = arguments.isovalue
    if isovalue is None:
        isovalue = low / 2 + high / 2 if arguments.file else HEAD_ISOVALUE
    # A sample that equals the isovalue counts as below it.
    if not low <= isovalue < high:
        raise DemoError(f"the surface of {isovalue:g} is empty: values go from {low:g} to {high:g}")
    print(f"{path}: {' x '.join(map(str, image.GetDimensions()))} samples, isovalue {isovalue:g}")

    os.makedirs(arguments.output, exist_ok=True)
    files = Files(arguments.output)
    voxel = min(map(abs, image.GetSpacing()))
    regions = [run_surface(image, isovalue, voxel, files)]
    regions.append(run_volume(image, isovalue, (low, high), voxel, files))
    run_regions(regions, image.GetBounds(), files)
    if errors.count:
        raise DemoError("VTK reported errors")
    print("Written:", *files.paths, sep="\n  ")


def run_surface(image, isovalue, voxel, files):
    """The isosurface at all levels, and with a region of interest, which is returned."""
    hierarchy, seconds = build(image, lambda builder: builder.SetIsovalue(isovalue))
    print(f"Isosurface, hierarchy built in {seconds:.2f} s\n")
    surfaces, captions = zip(*extract_levels(hierarchy, voxel, "triangles"))
    full = surfaces[0]
    print()
    print_sizes(hierarchy, full.GetNumberOfPoints(), full.GetNumberOfCells(), 12)
    print_flying_edges(image, isovalue)
    path = files.write(vtkXMLPolyDataWriter(), "hierarchy.vtp", hierarchy)
    for i, surface in enumerate(surfaces):
        files.write(vtkXMLUnstructuredGridWriter(), f"surface-{i}.vtu", surface)
    files.write(vtkPNGWriter(), "levels.png", draw(surfaces, captions))
    check_reload(path, full)
    return extract_region(hierarchy, full, voxel)


def run_volume(image, isovalue, value_range, voxel, files):
    """The same for everything above the isovalue, as tetrahedra."""

    def prepare(builder):
        builder.SetShapeToIntervalVolume()
        builder.SetIsorange(isovalue, math.inf)

    hierarchy, seconds = build(image, prepare)
    print(f"\nInterval volume from {isovalue:g} up, hierarchy built in {seconds:.2f} s\n")
    shown, captions = [], []
    points = cells = 0
    for i, (volume, text) in enumerate(extract_levels(hierarchy, voxel, "tetrahedra")):
        if i == 0:
            points, cells = volume.GetNumberOfPoints(), volume.GetNumberOfCells()
            region = extract_region(hierarchy, volume, voxel)
        if i in SHOWN_VOLUMES:
            files.write(vtkXMLUnstructuredGridWriter(), f"volume-{i}.vtu", volume)
            shown.append(volume)
            captions.append(text)
    print()
    print_sizes(hierarchy, points, cells, 16)
    files.write(vtkXMLPolyDataWriter(), "volume-hierarchy.vtp", hierarchy)
    picture = draw_volumes(shown, captions, image.GetBounds(), (isovalue, value_range[1]))
    files.write(vtkPNGWriter(), "volume.png", picture)
    return region


def run_regions(regions, bounds, files):
    (surface, surface_time), (volume, volume_time) = regions
    print("\nFull detail in a region of interest only:")
    captions = []
    for mesh, noun, milliseconds in (
        (surface, "triangles", surface_time),
        (volume, "tetrahedra", volume_time),
    ):
        print(f"{mesh.GetNumberOfCells():>18,} {noun} {milliseconds:>8.1f} ms")
        captions.append(
            f"full resolution in a box, {in_voxels(REGION_OUTSIDE)} outside\n"
            f"{mesh.GetNumberOfCells():,} {noun}, coloured by level"
        )
    picture = draw_regions(surface, volume, captions, bounds)
    files.write(vtkPNGWriter(), "region.png", picture)


def main():
    parser = argparse.ArgumentParser(prog="demo.py", description=__doc__)
    parser.add_argument("--isovalue", type=float)
    parser.add_argument("--output", required=True)
    parser.add_argument("file", nargs="?")
    arguments = parser.parse_args()
    try:
        run(arguments, ErrorLog())
    except (DemoError, OSError) as problem:
        sys.exit(f"demo.py: {problem}")


main()
