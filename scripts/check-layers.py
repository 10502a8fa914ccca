#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that includes only go down: between rooms of Filters/Core and of Filters/Private as the
CMakeLists.txt of Core and Filters say, with no VTK in the core, no header of a room without its
folder, no ParaView in Filters, and nothing of the core or of VTK in the reference.

Usage: check-layers.py [ROOT]
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
core = root / "Filters/Core"
problems = []


def includes(folder):
    """All includes below a folder: source, number of the line, name."""
    for source in sorted(folder.rglob("*")):
        if source.suffix in (".h", ".cpp", ".cxx"):
            for number, line in enumerate(source.read_text().splitlines(), 1):
                match = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line)
                if match:
                    yield source, number, match[1]


def complain(source, number, text):
    problems.append(f"{source.relative_to(root)}:{number}: {text}")


def read_rooms(lists, function, folder):
    """The rooms that a CMakeLists.txt adds: name, and the names of those that it may include."""
    found = {}
    for name, uses in re.findall(rf"^{function}\((\w+)(?: USES ([\w ]+?))?(?:\n| FILES|\))",
                                 lists.read_text(), re.MULTILINE):
        below = uses.split()
        problems.extend(f"{name} uses {room}, which is not below it" for room in below if room not in found)
        found[name] = {name, *below}
    problems.extend(
        f"{room.name} is no room of {lists.relative_to(root)}"
        for room in folder.iterdir() if room.is_dir() and room.name not in found)
    return found


rooms = read_rooms(core / "CMakeLists.txt", "isodiamonds_add_room", core)
private = root / "Filters/Private"
private_rooms = read_rooms(root / "Filters/CMakeLists.txt", "isodiamonds_add_private_room", private)
headers = {header.name for header in core.rglob("*.h")}

for source, number, name in includes(core):
    room, *rest = name.split("/")
    own = source.relative_to(core).parts[0]
    if re.match(r"(vtk|paraview|pq)", name):
        complain(source, number, f"the core knows no VTK: {name}")
    elif name in headers:
        complain(source, number, f"{name} without its room")
    elif rest and room in rooms and room not in rooms.get(own, ()):
        complain(source, number, f"{own} may not use {room}: {name}")
for source, number, name in includes(private):
    own = source.relative_to(private).parts[0]
    folder, *rest = name.split("/")
    if folder == "Private" and rest[0] not in private_rooms.get(own, ()):
        complain(source, number, f"{own} may not use {rest[0]}: {name}")
for source, number, name in includes(root / "Filters"):
    if core not in source.parents and re.match(r"(vtkPV|vtkSM[A-Z][a-z]|pq|Plugin/)", name):
        complain(source, number, f"Filters know no ParaView: {name}")
for source, number, name in includes(root / "Testing/Reference"):
    if name.split("/")[0] in rooms or name in headers or name.startswith("vtk"):
        complain(source, number, f"the reference shares nothing: {name}")

print("\n".join(problems) if problems else f"includes go down in {len(rooms)} + {len(private_rooms)} rooms")
sys.exit(bool(problems))
