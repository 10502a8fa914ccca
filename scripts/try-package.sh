#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs a package that scripts/package.sh made, as a user would, and tries it out: ParaView lists
# the plugin, Python finds the module, a program in C++ links the library.
# Usage: scripts/try-package.sh FILE
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ -f "${1:-}" ] || fail "which package? see scripts/package.sh"
package=$(realpath "$1")
as_root apt-get update -qq
as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$package" >/dev/null
cd /
pvpython "$root/Testing/Python/TestPackage.py"

install_build_packages # a program needs ParaView's development files
example=$(mktemp -d)
trap 'rm -r "$example"' EXIT
cmake -S "$root/Examples/Cxx" -B "$example" -G Ninja --log-level=WARNING >/dev/null
cmake --build "$example"
"$example/LevelsOfDetail" "$example/hierarchy.vtp"
