#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Which lines and branches of the core its tests run: totals, and a page for each file in
# build-coverage/report. Arguments go to the tests, e.g. --gtest_filter=Surface*
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# shellcheck disable=SC2086 # a list of words
install_packages $compile_packages libgtest-dev gcovr
cd "$root"
cmake --preset coverage >/dev/null
cmake --build --preset coverage >/dev/null
find build-coverage -name '*.gcda' -delete
ISODIAMONDS_SEED=1 ISODIAMONDS_CASES=${ISODIAMONDS_CASES:-30} \
  build-coverage/bin/IsodiamondCoreTests --gtest_brief=1 "$@"
mkdir -p build-coverage/report
# Branches of exceptions are none of the code's own.
gcovr -r . -f 'Filters/Core/' --exclude-throw-branches --exclude-unreachable-branches \
  --html-details build-coverage/report/index.html --print-summary build-coverage
