#!/usr/bin/env bash
# Installs what a fresh Debian lacks, builds everything and runs all tests.
# Arguments go to ctest, e.g. scripts/test.sh -R Surface
# ISODIAMONDS_PRESET is the preset to build with, one that builds into build/ [test].
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# shellcheck disable=SC2086 # lists of words
install_packages $compile_packages $render_packages $test_packages
install_build_packages
configure_and_build "${ISODIAMONDS_PRESET:-test}"

cd "$build"
on_display ctest --output-on-failure "$@"
