#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures which lines and branches of the core its tests run. Prints totals, writes a page for each
# file to build-coverage/report, and fails if a line is run by no test without a reason in
# coverage-untested.txt. Arguments go to ctest, e.g. -R Surface
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# shellcheck disable=SC2086 # a list of words
install_packages $compile_packages libgtest-dev gcovr
cd "$root"
report=build-coverage/report
cmake --preset coverage >/dev/null
cmake --build --preset coverage >/dev/null
find build-coverage -name '*.gcda' -delete
# Always the same cases. Each test is a process: counts are added up in files, under locks.
ISODIAMONDS_SEED=1 ctest --preset coverage -L core -j "$(nproc)" --progress "$@"
mkdir -p "$report"
# Branches for exceptions do not count: they are not in the source.
gcovr -r . -f 'Filters/Core/' --exclude-throw-branches --exclude-unreachable-branches -j "$(nproc)" \
  --html-details "$report/index.html" --json "$report/report.json" --print-summary build-coverage
scripts/coverage.py "$report/report.json" "$report/branches.txt"
