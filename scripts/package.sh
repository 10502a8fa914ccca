#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes a Debian package of the plugin, the VTK module, its Python package, headers and CMake files, for
# the Debian that it runs on: build-package/isodiamonds_VERSION_ARCHITECTURE.deb.
# With --try it is installed and tried out as well: in the plugin's list, in pvpython, in C++.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case ${1:-} in
  "" | --try) ;;
  *) fail "unknown option '$1': --try or none" ;;
esac

install_packages dpkg-dev file # what cpack finds dependencies with
install_build_packages
configure_and_build package
cd "$root/build-package"
rm -f ./*.deb
cpack >cpack.log || { cat cpack.log >&2; fail "cpack failed"; }
package=$(echo "$PWD"/isodiamonds_*.deb)
echo "$package"

if [ "${1:-}" = --try ]; then
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --reinstall \
    --no-install-recommends "$package" >/dev/null
  cd /
  pvpython "$root/Testing/Filters/TestPackage.py"
  cmake -S "$root/Examples/Cxx" -B "$root/build-package/example" -G Ninja >/dev/null
  cmake --build "$root/build-package/example"
  "$root/build-package/example/LevelsOfDetail" "$root/build-package/hierarchy.vtp"
fi
