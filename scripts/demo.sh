#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds hierarchies of a volume, extracts five levels of detail and draws them side by side.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'END'
Usage: scripts/demo.sh [--isovalue K] [--output DIR] [FILE]

Installs what is missing, builds, and shows an isosurface of FILE, and the interval volume above it,
at five error tolerances and with a region of interest.

  FILE          a volume: .vti, .nrrd, .nhdr, .mhd, .mha, .nii, .nii.gz or .vtk (structured points)
                [the MRI head of Debian's mricron-data]
  --isovalue K  value of the surface [the skin of the head; the middle of FILE's range]
  --output DIR  where results go [demo-output/ of this repository]
END
}

# Arguments are checked before anything is installed or built, as that takes minutes.
check_isovalue() {
  [[ $1 =~ ^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?$ ]] || fail "--isovalue: '$1' is not a finite number"
}

check_output() {
  [ -n "$1" ] || fail "--output: needs the name of a directory"
  [ ! -e "$1" ] || [ -d "$1" ] || fail "--output: '$1' is not a directory"
}

check_file() {
  [ -e "$1" ] || fail "no such file: '$1'"
  [ ! -d "$1" ] || fail "a directory, not a volume: '$1'"
  [ -r "$1" ] || fail "no permission to read '$1'"
  case ${1,,} in
    *.vti | *.nrrd | *.nhdr | *.mhd | *.mha | *.nii | *.nii.gz | *.vtk) ;;
    *) fail "unknown kind of file: '$1' (see --help)" ;;
  esac
}

output=$root/demo-output
arguments=()
files=()
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h)
      usage
      exit
      ;;
    --isovalue | --output)
      [ $# -ge 2 ] || fail "$1: needs a value"
      if [ "$1" = --isovalue ]; then
        check_isovalue "$2"
        arguments+=("--isovalue=$2")
      else
        output=$2
      fi
      shift
      ;;
    -*) fail "unknown option '$1' (see --help)" ;;
    *) files+=("$1") ;;
  esac
  shift
done
[ ${#files[@]} -le 1 ] || fail "one FILE at most, got ${#files[@]}"
check_output "$output"
if [ ${#files[@]} -eq 1 ]; then
  check_file "${files[0]}"
fi

# shellcheck disable=SC2086 # lists of words
install_packages $compile_packages $render_packages $demo_packages
install_build_packages
configure_and_build release

PYTHONPATH=$build/lib/python3/dist-packages on_display \
  pvpython "$root/scripts/demo.py" "${arguments[@]}" "--output=$output" "${files[@]}"
echo "The plugin for ParaView: $(find_plugin)"
