# Shared by the scripts: installs what a fresh Debian lacks, configures and builds.
# Sourced, not run; expects `set -euo pipefail`.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

# libxxhash: hashes by which the filters recognize content.
compile_packages="cmake ninja-build g++ libxxhash-dev"
# Rendering without a screen.
render_packages="xvfb xauth"
# The MRI head of the demo.
demo_packages="mricron-data"
# GoogleTest, VTK's rendering tests, programs under MPI, and the benchmarks' files.
test_packages="libgtest-dev libglew-dev libfreetype-dev mpi-default-bin python3-scipy
  nlohmann-json3-dev"

fail() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    command -v sudo >/dev/null || fail "needs root or sudo for: $*"
    sudo "$@"
  fi
}

# version_of PACKAGE: the version that apt has installed or would install; nothing if it knows none.
version_of() {
  apt-cache policy "$1" 2>/dev/null | sed -n 's/^  Candidate: \([^(]*\)$/\1/p'
}

# install_packages PACKAGE...: installs those that are missing.
install_packages() {
  local missing=() unknown=() package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then
    return
  fi
  command -v apt-get >/dev/null || fail "no apt-get here to install ${missing[*]}"
  echo "Installing ${missing[*]}"
  as_root apt-get update -qq
  for package in "${missing[@]}"; do
    if [ -z "$(version_of "$package")" ]; then
      unknown+=("$package")
    fi
  done
  [ ${#unknown[@]} -eq 0 ] || fail "apt knows no package ${unknown[*]}; see Systems in README.md"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
    "${missing[@]}" >/dev/null
}

# install_build_packages: installs what it takes to build the plugin, the VTK module and its Python
# wrapping.
install_build_packages() {
  local version
  version=$(version_of paraview-dev)
  if [ -z "$version" ]; then # perhaps no list of packages yet
    command -v apt-get >/dev/null || fail "no apt-get here to install paraview-dev"
    as_root apt-get update -qq
    version=$(version_of paraview-dev)
    [ -n "$version" ] || fail "apt knows no package paraview-dev; see Systems in README.md"
  fi
  # What paraview-dev's CMake files need beyond its dependencies. ParaView 5.11 has Qt 5, whose
  # tools make the help pages; from 6.0 on, Debian's ParaView is built on the system's VTK.
  local packages="paraview-dev python3-paraview python3-dev libopenmpi-dev libdouble-conversion-dev liblz4-dev"
  if dpkg --compare-versions "$version" lt 5.12; then
    packages+=" qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools"
  elif dpkg --compare-versions "$version" ge 6; then
    packages+=" libvtk9-dev"
  fi
  # shellcheck disable=SC2086 # lists of words
  install_packages $compile_packages $packages
}

# configure_and_build PRESET [CMAKE_ARGUMENT...]: configures and builds by a preset of
# CMakePresets.json.
configure_and_build() {
  (cd "$root" && cmake --preset "$@" --log-level=NOTICE >/dev/null && cmake --build --preset "$1")
}

# on_display COMMAND...: runs COMMAND on an invisible screen of its own. There is one screen for all
# that a COMMAND starts: several at once get in each other's way. ISODIAMONDS_DISPLAY is the first
# number to try.
on_display() {
  xvfb-run -a -n "${ISODIAMONDS_DISPLAY:-99}" -s "-screen 0 1600x1000x24 -noreset" "$@"
}

# find_plugin: the plugin that was built; its folder's name has ParaView's version.
find_plugin() {
  local files=("$build"/lib*/paraview-*/plugins/Isodiamonds/Isodiamonds.so)
  [ -e "${files[0]}" ] || fail "no plugin in $build"
  echo "${files[0]}"
}
