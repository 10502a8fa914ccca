#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes pages of the classes' documentation; any warning is a failure. Usage: docs/doxygen.sh [OUTPUT-FOLDER]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"

output=${1:-$root/build/doxygen}
install_packages doxygen
mkdir -p "$output"
cd "$root"
(cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = $output") | doxygen -
echo "$output/html/index.html"
