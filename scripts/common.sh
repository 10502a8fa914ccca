# Shared by the scripts: installs what a fresh Debian 12 lacks, configures and builds.
# Sourced, not run; expects `set -euo pipefail`.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

# The plugin, the VTK module, its Python wrapping and the plugin's help pages.
build_packages="cmake ninja-build g++ paraview-dev python3-paraview libopenmpi-dev
  libdouble-conversion-dev liblz4-dev qttools5-dev qttools5-dev-tools qtxmlpatterns5-dev-tools"
# Rendering without a screen.
render_packages="xvfb xauth"
# The MRI head of the demo.
demo_packages="mricron-data"
# GoogleTest, VTK's rendering tests, and programs under MPI.
test_packages="libgtest-dev libglew-dev libfreetype-dev mpi-default-bin"

# install_packages PACKAGE...: installs those that are missing.
install_packages() {
  local missing=() package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then
    return
  fi
  echo "Installing ${missing[*]}"
  local sudo=""
  if [ "$(id -u)" -ne 0 ]; then
    sudo=sudo
  fi
  $sudo apt-get update -qq
  DEBIAN_FRONTEND=noninteractive $sudo apt-get install -qq -y --no-install-recommends \
    "${missing[@]}" >/dev/null
}

# configure_and_build PRESET [CMAKE_ARGUMENT...]: configures build/ by a preset of
# CMakePresets.json, and builds it.
configure_and_build() {
  (cd "$root" && cmake --preset "$@" --log-level=WARNING >/dev/null && cmake --build --preset "$1")
}
