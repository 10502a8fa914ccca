#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests what needs no ParaView, of the commit HEAD, on a plain VTK: Debian's libvtk9-dev.
# That cannot be installed beside Debian 12's or 13's python3-paraview: hence a Debian of its own.
#   scripts/check-plain-vtk.sh [FOLDER [SUITE]]
# FOLDER is for the Debian, or has it from last time; the default is a temporary one.
# SUITE is bookworm (VTK 9.1, the default), trixie (9.3) or sid (9.6).
set -euo pipefail

[ $# -le 2 ] || { echo "check-plain-vtk.sh: one FOLDER and one SUITE at most" >&2; exit 1; }
folder=()
if [ -n "${1:-}" ]; then
  folder=(--root "$1")
fi
exec "$(dirname "${BASH_SOURCE[0]}")/check-debian.sh" "${folder[@]}" "${2:-bookworm}" bash -c '
  set -euo pipefail
  source scripts/common.sh
  install_packages $compile_packages $render_packages libvtk9-dev libgtest-dev nlohmann-json3-dev python3-dev python3-scipy python3-vtk9
  configure_and_build plain-vtk
  cd build-plain-vtk
  on_display ctest --output-on-failure'
