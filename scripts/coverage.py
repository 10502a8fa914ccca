#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what is new in gcovr's report: lines that no test runs and that
scripts/coverage-untested.txt does not list, and lines on that list that are tested now or gone.

Usage: coverage.py REPORT.json BRANCHES.txt
Writes the lines of which some branch never runs to BRANCHES.txt.
"""
import collections
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Lines that no test of the core runs, each with the reason: file | line | reason.
UNTESTED = ROOT / "scripts/coverage-untested.txt"


def main():
    files = json.loads(pathlib.Path(sys.argv[1]).read_text())["files"]
    reasons = collections.Counter(tuple(line.split(" | ")[:2]) for line in UNTESTED.read_text().splitlines())
    listed = sum(reasons.values())
    news, branches = [], []
    for file in sorted(files, key=lambda file: file["file"]):
        path = file["file"]
        text = (ROOT / path).read_text().splitlines()
        for line in sorted(file["lines"], key=lambda line: line["line_number"]):
            if line.get("gcovr/noncode"):
                continue
            words = text[line["line_number"] - 1].strip()
            name = f"{path}:{line['line_number']}: {words}"
            missed = sum(branch["count"] == 0 for branch in line["branches"])
            if line["count"] > 0:
                if missed > 0:
                    branches.append(f"{name} ({missed} of {len(line['branches'])})")
            elif reasons[path, words] > 0:
                reasons[path, words] -= 1
            else:
                news.append(name)
    pathlib.Path(sys.argv[2]).write_text("\n".join(branches) + "\n")
    print(f"{listed - sum(reasons.values())} lines untested with a reason, {len(news)} without")
    print("".join(f"untested: {name}\n" for name in news), end="")
    for path, words in reasons.elements():
        print(f"tested or gone, but listed: {path} | {words}")
    print(f"{len(branches)} lines of which some branch never runs: {sys.argv[2]}")
    return 1 if news else 0


if __name__ == "__main__":
    sys.exit(main())
