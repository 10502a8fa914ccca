#!/usr/bin/env bash
# Builds, tests and installs what needs no ParaView, of the commit HEAD, on a plain VTK: Debian 12's
# libvtk9-dev, which cannot be installed beside python3-paraview, hence in a root of its own.
# Needs root.
#   scripts/check-plain-vtk.sh [FOLDER]
# FOLDER gets the root, or has it from last time. Without, a temporary one is made and removed.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

plain_packages="cmake ninja-build g++ libvtk9-dev libgtest-dev python3 python3-vtk9"

fail() {
  echo "check-plain-vtk.sh: $*" >&2
  exit 1
}

# use_apt_of_host FOLDER: the root in FOLDER gets packages from where this machine gets Debian's.
# No other part of apt's configuration: that may need programs and keys which the root lacks.
use_apt_of_host() {
  echo "$sources" >"$1/etc/apt/sources.list"
  apt-config dump | grep -iE '^Acquire::(https?|Check)' >"$1/etc/apt/apt.conf.d/90host" || true
  cp -L /etc/resolv.conf "$1/etc/resolv.conf"
}

# in_root FOLDER COMMAND...: runs COMMAND in the root in FOLDER. What it mounts is seen by nobody
# else, and gone with it.
in_root() {
  # shellcheck disable=SC2016,SC2046 # variables of the inner shell; list of words
  unshare --mount bash -c \
    'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"' "$1" \
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    $(env | grep -iE '^([a-z]+_proxy|CMAKE_BUILD_PARALLEL_LEVEL)=') "${@:2}"
}

[ $# -le 1 ] || fail "one FOLDER at most"
[ "$(id -u)" -eq 0 ] || fail "needs root"
install_packages debootstrap git
if [ $# -eq 1 ]; then
  mkdir -p "$1"
  folder=$(cd "$1" && pwd)
else
  folder=$(mktemp -d)
  chmod 755 "$folder" # apt's own user looks into it
  trap 'rm -rf --one-file-system "$folder"' EXIT
fi

apt-get update -qq # what it fetches tells which sources are Debian's
# shellcheck disable=SC2016 # apt's variables
sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(CODENAME) $(COMPONENT)' \
  'Created-By: Packages' 'Origin: Debian' | grep -E '^deb [^ ]+ bookworm(-updates|-security)? ' | sort -u) ||
  fail "apt has no sources of Debian 12"
if [ -x "$folder/usr/bin/apt-get" ] && [ ! -e "$folder/debootstrap" ]; then
  echo "Using the root in $folder"
else
  [ -z "$(ls -A "$folder")" ] || fail "neither empty nor a root: '$folder'"
  echo "Making a root in $folder"
  eval "$(apt-config shell proxy Acquire::http::Proxy)"
  http_proxy=${http_proxy:-${proxy:-}} debootstrap --variant=minbase bookworm "$folder" \
    "$(sed -n 's/^deb \([^ ]*\) bookworm .*/\1/p' <<<"$sources" | sed -n 1p)" >/dev/null
fi
use_apt_of_host "$folder"

rm -rf "$folder/root/isodiamonds"
mkdir "$folder/root/isodiamonds"
git -C "$root" archive HEAD | tar -x -C "$folder/root/isodiamonds"
prepare="set -euo pipefail; source /root/isodiamonds/scripts/common.sh"
in_root "$folder" bash -c "$prepare; install_packages $plain_packages $render_packages"
# Displays of other roots are seen, their lock files are not: hence a number of its own.
in_root "$folder" bash -c "$prepare
  configure_and_build plain-vtk -DISODIAMONDS_BUILD_BENCHMARKS=ON
  cd /root/isodiamonds/build-plain-vtk
  xvfb-run -a -n $((100 + RANDOM % 900)) -s '-screen 0 1600x1000x24' ctest --output-on-failure"
