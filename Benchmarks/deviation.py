# SPDX-License-Identifier: BSD-3-Clause
"""How far simplified isosurfaces are from full resolution, at the same number of triangles.

    PYTHONPATH=build/lib/python3/dist-packages pvpython Benchmarks/deviation.py [OPTIONS] [RAW ...]
    xvfb-run pvpython Benchmarks/deviation.py --pictures FOLDER [OPTIONS] [RAW ...]

RAW is NAME_XxYxZ_uint8.raw:ISOVALUE; the other volumes are a phantom made here and, where Debian's
mricron-data is installed, an MRI head. Needs scipy, Debian's python3-scipy.

For Isodiamonds' two metrics, full resolution is its own surface at tolerance 0. For
vtkQuadricDecimation and meshopt_simplify it is the surface of vtkFlyingEdges3D, from which they
start; also for OpenVDB's adaptive mesher (Debian's python3-openvdb), which starts from the volume.
The distance metric's mesh sets the number of triangles for the others; "-" is for what was not run,
for instance where vtkFlyingEdges3D's surface has no more triangles than that. One thread each.

Once the triangles are counted, points at the same place are merged, and triangles left with fewer
than three points are dropped. The table has, with the smallest side of a voxel as unit of length:

- full -> mesh: distances of all vertices of full resolution from the mesh: root mean square over
  the vertices, and maximum;
- mesh -> full: distances of samples of the mesh from full resolution: root mean square over the
  mesh's area, and maximum. Samples are the centres of equal parts of each triangle, at most half a
  voxel apart, for the maximum also its corners; where there are more than a million, means are over
  about a million of them, drawn at random;
- normals: the mean angle over the mesh's area, in degrees, between a triangle's normal and that of
  full resolution's triangle nearest to the sample: of several equally near, the one with the
  smallest angle;
- folded: the share of the mesh's area where that angle is above 90 degrees. Where a wall is thinner
  than twice the deviation, the nearest triangle may be on its other side: that counts as well;
- slivers: the share of triangles with an angle below 10 degrees;
- pieces: connected components, by common points; Euler number: points - edges + triangles; loops:
  connected sets of boundary edges, those with one triangle, as around a hole or where the volume
  ends; branching: edges with more than two triangles;
- intersections: pairs of triangles that have more in common than corners and an edge, if
  IsodiamondCGALIntersections was built (Debian's libcgal-dev);
- full's vertices beyond: how many of full resolution are farther from the mesh than the tolerance.

Pictures show the meshes close up, inner sides in red; those of a raw volume need --camera.
"""
import argparse
import collections
import math
import os

from isodiamonds import vtkIsodiamondContour
from meshmeasures import Mesh, NearestTriangle, deviation_of_mesh, deviation_of_points
from meshmeasures import intersections, slivers, topology
from meshpictures import View, save_picture
from simplifiers import Contest
from volumes import HEAD, HEAD_ISOVALUE, cropped, head, phantom, raw_volume

TOLERANCES = (2, 1, 0.5, 0.25, 0.1)  # voxels
PICTURED = (1,)
DECIMATION_LIMIT = 1_000_000  # triangles
INTERSECTIONS = "build/bin/IsodiamondCGALIntersections"

# For pictures: a part of the volume, or None for all, and from where to look at it. Here the bone
# of the forehead, cut open.
HEAD_VIEW = ((50, 130, 150, 216, 70, 150), View((99, 200, 100.5), (0.3, 1, 0.3), (0, 0, 1), 28))

Volume = collections.namedtuple("Volume", "name image isovalue crop view", defaults=(None, None))
Result = collections.namedtuple(
    "Result",
    "triangles there beyond back angle folded slivers topology intersections milliseconds",
)


def phantom_view(size):
    """The walls between the bores, and fins."""
    focus, way = ([size / 128 * x for x in v] for v in ((60, 52, 100), (40, 100, 200)))
    return None, View(focus, way, (0, 1, 0), size / 128 * 46)


def assess(full, nearest, polydata, milliseconds, tolerance, voxel):
    """All figures of one mesh."""
    mesh = Mesh.of(polydata, voxel)
    there, distances = deviation_of_points(full.points, mesh)
    return Result(
        polydata.GetNumberOfCells(),
        there,
        (distances > tolerance).sum(),
        *deviation_of_mesh(mesh, nearest),
        slivers(mesh),
        topology(mesh),
        intersections(mesh, INTERSECTIONS),
        milliseconds,
    )


def slashed(numbers, form):
    return " / ".join(format(n, form) for n in numbers)


# What the table shows of a result, in this order.
FIGURES = {
    "triangles": lambda r: f"{r.triangles:,}",
    "full -> mesh: rms / max": lambda r: slashed(r.there, ".3f"),
    "mesh -> full: rms / max": lambda r: slashed(r.back, ".3f"),
    "normals / folded, % / slivers, %": lambda r: (
        f"{r.angle:.1f} / {100 * r.folded:.3f} / {100 * r.slivers:.1f}"
    ),
    "pieces / Euler / loops / branching": lambda r: slashed(r.topology, ","),
    "intersections": lambda r: "-" if r.intersections is None else f"{r.intersections:,}",
    "full's vertices beyond": lambda r: f"{r.beyond:,}",
}


def print_table(columns, rows):
    for row in (columns, ["---"] * len(columns), *rows):
        print(f"| {' | '.join(row)} |")
    print(flush=True)


def print_tables(contest, results, tolerances):
    rows = []
    for tolerance, row in zip(tolerances, results):
        for figure, text in FIGURES.items():
            rows.append([f"{tolerance:g}", figure, *(text(r) if r else "-" for r in row)])
    print_table(["tolerance", "figure", *contest.methods], rows)

    first, *others = contest.methods
    print(f"Time, in ratios to extraction by {first}:\n")
    rows = []
    for tolerance, (ours, *theirs) in zip(tolerances, results):
        unit = ours.milliseconds
        ratios = [f"{r.milliseconds / unit:.2f}" if r else "-" for r in theirs]
        builds = [f"{build / unit:.1f}" for build in contest.builds]
        rows.append([f"{tolerance:g}", f"{unit:.1f}", *builds, *ratios])
    builds = [f"build by {name}" for name in contest.ours]
    print_table(["tolerance", f"{first}, ms", *builds, *others], rows)


def print_surface(name, mesh, milliseconds):
    """Prints full resolution; points at the same place are merged before they are counted."""
    print(
        f"- {name}: {len(mesh.triangles):,} triangles, {len(mesh.points):,} points, "
        f"{100 * slivers(mesh):.1f} % slivers, {milliseconds:.1f} ms; pieces / Euler number / "
        f"loops / branching edges {slashed(topology(mesh), ',')}"
    )


def compare(volume, topologies, tolerances, limit, simplifies, plot):
    size = " x ".join(map(str, volume.image.GetDimensions()))
    print(f"## {volume.name}, {size}, isovalue {volume.isovalue:g}\n\nFull resolution:\n")
    contest = Contest(volume.image, volume.isovalue, topologies, limit, simplifies)
    theirs, ours = (Mesh.of(full, contest.voxel) for full in (contest.theirs, contest.full))
    print_surface("vtkFlyingEdges3D", theirs, contest.their_milliseconds)
    print_surface("Isodiamonds", ours, contest.milliseconds)
    for name, build in zip(contest.ours, contest.builds):
        print(f"- build by {name}: {build:.0f} ms")
    print(flush=True)

    ours, theirs = ((full, NearestTriangle(full)) for full in (ours, theirs))
    results = []
    for tolerance in tolerances:
        fulls = [ours] * len(contest.ours) + [theirs] * 3
        results.append([
            run and assess(*full, *run, tolerance, contest.voxel)
            for full, run in zip(fulls, contest.level(tolerance))
        ])
    print_tables(contest, results, tolerances)
    if plot:
        draw_errors(contest.methods, results, plot)


def draw_errors(methods, results, path):
    """A plot of errors over numbers of triangles."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, panels = pyplot.subplots(1, 2, figsize=(9.6, 4.2), sharex=True)
    titles = ("root of the mean square, both ways", "maximum, both ways")
    for figure_of, (axes, title) in enumerate(zip(panels, titles)):
        for method, runs in zip(methods, zip(*results)):
            runs = [run for run in runs if run]
            errors = [max(run.there[figure_of], run.back[figure_of]) for run in runs]
            style = "o-" if method == "Simplify" else "s-" if "distance" in method else ".--"
            axes.loglog([run.triangles for run in runs], errors, style, label=method)
        axes.set_title(title, fontsize=10)
        axes.set_xlabel("triangles")
        axes.grid(alpha=0.3, which="both")
    panels[0].set_ylabel("distance, voxels")
    names = panels[0].get_legend_handles_labels()
    figure.legend(*names, loc="lower center", ncol=len(methods), fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    figure.savefig(path, dpi=110)


def draw(volume, topologies, tolerances, folder):
    """A picture for each tolerance, full resolution at the right."""
    image = cropped(volume.image, volume.crop) if volume.crop else volume.image
    contest = Contest(image, volume.isovalue, topologies, math.inf)
    os.makedirs(folder, exist_ok=True)
    for tolerance in tolerances:
        level = zip(contest.methods, contest.level(tolerance))
        meshes = [(name, run[0]) for name, run in level if run and name != "field"]
        meshes += [("Isodiamonds at full resolution", contest.full)]
        name = f"{volume.name}-tolerance-{tolerance:g}.png".replace(" ", "-")
        save_picture(os.path.join(folder, name), meshes, volume.view)


def numbers(kind):
    """Parses an option's numbers, with commas between them."""
    return lambda text: [kind(number) for number in text.split(",")]


def view_of(text):
    x, y, z, *way, height = numbers(float)(text)
    dx, dy, dz = way
    up = (0, 0, 1) if dz**2 < dx**2 + dy**2 else (0, 1, 0)
    return View((x, y, z), way, up, height)


def parse():
    parser = argparse.ArgumentParser(prog="deviation.py", description=__doc__.split("\n", 1)[0])
    parser.add_argument("--size", type=int, default=128, help="of the phantom, in samples")
    parser.add_argument("--only-raw", action="store_true", help="neither phantom nor head")
    parser.add_argument("--all", action="store_true", help="decimate large surfaces too (slow)")
    parser.add_argument("--tolerances", type=numbers(float), metavar="T[,T...]", help="in voxels")
    parser.add_argument(
        "--preserve-topology",
        type=numbers(int),
        default=[None],
        metavar="0|1|0,1",
        help="of Isodiamonds' meshes; both: two by distance, of which the first sets the number of "
        "triangles",
    )
    parser.add_argument(
        "--simplify", action="store_true", help="with a simplified mesh, which sets the number"
    )
    parser.add_argument(
        "--plot", metavar="FILE", help="errors over triangles as well, into this file: one volume"
    )
    parser.add_argument("--pictures", metavar="FOLDER", help="only pictures, into this folder")
    parser.add_argument(
        "--camera",
        type=view_of,
        metavar="X,Y,Z,DX,DY,DZ,HEIGHT",
        help="for pictures of RAW: the point to look at, the way from there to the camera, behind "
        "which nothing is seen, and how much is seen from top to bottom",
    )
    parser.add_argument("raw", nargs="*", type=raw_volume, help="NAME_XxYxZ_uint8.raw:ISOVALUE")
    arguments = parser.parse_args()
    if arguments.preserve_topology != [None] and not hasattr(
        vtkIsodiamondContour, "SetPreserveTopology"
    ):
        parser.error("this vtkIsodiamondContour has no PreserveTopology")
    if arguments.pictures and arguments.raw and not arguments.camera:
        parser.error("pictures of a raw volume need --camera")
    return arguments


def main():
    arguments = parse()
    volumes = []
    if not arguments.only_raw:
        size = arguments.size
        volumes.append(Volume("CT phantom", phantom(size), 50, *phantom_view(size)))
        if os.path.exists(HEAD):
            volumes.append(Volume("MRI head", head(), HEAD_ISOVALUE, *HEAD_VIEW))
    volumes += [Volume(*raw, None, arguments.camera) for raw in arguments.raw]
    topologies = arguments.preserve_topology
    for volume in volumes:
        if arguments.pictures:
            draw(volume, topologies, arguments.tolerances or PICTURED, arguments.pictures)
        else:
            limit = math.inf if arguments.all else DECIMATION_LIMIT
            compare(
                volume,
                topologies,
                arguments.tolerances or TOLERANCES,
                limit,
                arguments.simplify,
                arguments.plot,
            )


main()
