#!/usr/bin/env bash
# Installs what a fresh Debian 12 lacks, builds everything and runs all tests.
# Arguments go to ctest, e.g. scripts/test.sh -R Surface
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages $build_packages $render_packages $test_packages
configure_and_build release -DISODIAMONDS_BUILD_BENCHMARKS=ON

# One display for all tests: several xvfb-run at once get into each other's way.
cd "$build"
exec xvfb-run -a -s "-screen 0 1600x1000x24 -noreset" ctest --output-on-failure "$@"
