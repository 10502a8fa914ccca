#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes files that include up to eight sources each, with compile commands of their own. A
directory counts with its sub-directories, except those named before it.

Usage: merge-sources.py COMPILE_COMMANDS OUTPUT_DIRECTORY SOURCE_DIRECTORY...
"""
import json
import os
import re
import sys

commands_file, output, *directories = sys.argv[1:]
with open(commands_file) as file:
    commands = json.load(file)

merged = []
for directory in directories:
    inside = os.path.abspath(directory) + os.sep
    own = [c for c in commands if c["file"].startswith(inside)]
    commands = [c for c in commands if c not in own]  # each file once: inner directories come first
    if not own:
        sys.exit(f"merge-sources.py: nothing is compiled in {directory}")
    for first in range(0, len(own), 8):
        sources = [c["file"] for c in own[first : first + 8]]
        name = f"{output}/{len(merged)}.cpp"
        with open(name, "w") as file:
            file.writelines(f'#include "{source}"\n' for source in sources)
        # They share their flags: each directory is one target. Its precompiled header is for gcc.
        command = own[first]["command"].replace(sources[0], name)
        command = re.sub(r"-Winvalid-pch|-include \S+/cmake_pch\.hxx", "", command)
        merged.append({**own[first], "file": name, "command": command})
with open(f"{output}/compile_commands.json", "w") as file:
    json.dump(merged, file)
