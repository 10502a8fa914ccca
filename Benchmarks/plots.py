# SPDX-License-Identifier: BSD-3-Clause
"""Plots what IsodiamondBenchmark wrote. Needs matplotlib, Debian's python3-matplotlib.

    /usr/bin/python3 Benchmarks/plots.py benchmark.json FOLDER

For each volume and shape, as PNG files in FOLDER: the paper's figure 15, which is front size and
time of RI and MI relative to HD over the tolerance (of a run with --paper); and cells and time of
MI over the tolerance, by both metrics.
"""
import argparse
import json
import os
import re

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

SHAPES = {"isosurface": "triangles", "interval volume": "tetrahedra"}
REFERENCES = ("vtkFlyingEdges3D", "vtkContourFilter", "vtkTableBasedClipDataSet twice")


def rows_of(rows, contestant):
    """Tolerances and rows of a contestant, sorted by tolerance."""
    return sorted(
        ((row.get("tolerance"), row) for row in rows if row["contestant"] == contestant),
        key=lambda pair: pair[0],
    )


def tolerance_axis(axes, tolerances, unit):
    """The tolerances in equal steps, as in the paper, so that 0 can be among them."""
    axes.set_xticks(range(len(tolerances)), [f"{t:g}" for t in tolerances])
    axes.set_xlabel(f"tolerance, {unit}")
    axes.grid(alpha=0.3)


def save(figure, title, folder, name):
    figure.suptitle(title)
    figure.tight_layout()
    path = os.path.join(folder, re.sub(r"[^\w.]+", "-", name) + ".png")
    figure.savefig(path, dpi=120)
    pyplot.close(figure)
    print(path)


def plot_figure_15(volume, shape, folder):
    rows = volume[shape]
    hd = dict(rows_of(rows, "HD extract, field"))
    if len(hd) < 3:
        return  # a run without --paper has only the ends
    tolerances = sorted(hd)
    figure, panels = pyplot.subplots(1, 2, figsize=(9, 3.8))
    for axes, quantity in zip(panels, ("front", "milliseconds")):
        for model, style in (("HD", "k--"), ("RI", "o-"), ("MI", "s-")):
            ours = dict(rows_of(rows, f"{model} extract, field"))
            ratios = [ours[t][quantity] / hd[t][quantity] for t in tolerances]
            axes.plot(range(len(tolerances)), ratios, style, label=model)
        tolerance_axis(axes, tolerances, "% of the range")
        axes.set_ylim(bottom=0)
        axes.set_title("front" if quantity == "front" else "time")
        axes.legend()
    panels[0].set_ylabel("relative to HD")
    title = f"{volume['title']}, {shape}"
    save(figure, title, folder, f"figure15-{title}")


def plot_levels(volume, shape, folder):
    rows = volume[shape]
    metrics = [m for m in ("field", "distance") if rows_of(rows, f"MI extract, {m}")]
    if not metrics:
        return  # a run with --shape has only the other one
    figure, panels = pyplot.subplots(
        2, len(metrics), figsize=(4.5 * len(metrics), 6.5), squeeze=False
    )
    for column, metric in enumerate(metrics):
        levels = rows_of(rows, f"MI extract, {metric}")
        tolerances = [tolerance for tolerance, _ in levels]
        unit = levels[0][1]["tolerance unit"]
        for axes, quantity in zip(panels[:, column], ("cells", "milliseconds")):
            values = [row[quantity] for _, row in levels]
            axes.plot(range(len(values)), values, "s-", label=f"MI, {metric} metric")
            for reference in REFERENCES:
                others = [row for row in rows if row["contestant"] == reference]
                if others:
                    axes.axhline(others[0][quantity], label=reference, alpha=0.7,
                                 color=f"C{1 + REFERENCES.index(reference)}")
            axes.set_yscale("log")
            axes.set_ylabel(SHAPES[shape] if quantity == "cells" else quantity)
            tolerance_axis(axes, tolerances, unit)
            axes.legend(fontsize="small")
    title = f"{volume['title']}, {shape}"
    save(figure, title, folder, f"levels-{title}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("json", help="what IsodiamondBenchmark wrote")
    parser.add_argument("folder", help="where the pictures go")
    arguments = parser.parse_args()
    with open(arguments.json, encoding="utf-8") as file:
        report = json.load(file)
    os.makedirs(arguments.folder, exist_ok=True)
    for volume in report["volumes"]:
        for shape in SHAPES:
            plot_figure_15(volume, shape, arguments.folder)
            plot_levels(volume, shape, arguments.folder)


main()
