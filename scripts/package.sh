#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes a Debian package of the plugin, the VTK module, its Python package, headers and CMake files,
# for the Debian that this runs on: build-package/isodiamonds_VERSION_ARCHITECTURE.deb.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -eq 0 ] || fail "takes no arguments"
install_packages dpkg-dev file # cpack finds dependencies with them
install_build_packages
configure_and_build package
cd "$root/build-package"
rm -f ./*.deb
cpack >cpack.log || { cat cpack.log >&2; fail "cpack failed"; }
package=$(echo "$PWD"/isodiamonds_*.deb)
echo "$package"
