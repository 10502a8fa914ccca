#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The tests of the VTK filters under valgrind's memcheck: errors and definite leaks are failures.
# Slow: Distance.IsAPromiseOnAnalyticVolumes alone took 15 minutes beside other work.
# Arguments go to the tests, e.g. --gtest_filter=Contour*
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# shellcheck disable=SC2086 # lists of words
install_packages $render_packages $test_packages valgrind
install_build_packages
configure_and_build test >/dev/null

arguments=("$@")
if [ ${#arguments[@]} -eq 0 ]; then
  arguments=(--gtest_filter=-Images*:Speed*) # tests that draw would test the driver, not us
fi
exec valgrind --error-exitcode=3 --leak-check=full --show-leak-kinds=definite \
  --errors-for-leak-kinds=definite --num-callers=30 \
  "$build/bin/IsodiamondFilterTests" "${arguments[@]}"
