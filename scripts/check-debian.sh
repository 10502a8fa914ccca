#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tries a command of the README as a new user would: in a bare Debian, on a clone of HEAD.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'END'
Usage: scripts/check-debian.sh [--root FOLDER] [--copy FILE] bookworm|trixie|sid [demo|test|COMMAND...]

Makes a bare Debian in a folder (debootstrap), clones HEAD into it, and in the clone runs
scripts/demo.sh [default], scripts/test.sh or a COMMAND. Fails if that fails. Needs root, and apt
with Debian's sources.

  --root FOLDER  where to make the Debian and keep it; one that is there already is used again, with
                 everything installed in it [a temporary folder, removed afterwards]
  --copy FILE    copies FILE into the clone
END
}

# use_apt_of_host FOLDER: makes apt in the root in FOLDER get packages from where the host gets
# Debian's. Of the host's other settings it takes only those for HTTP and checks: others may need
# programs and keys which the root lacks.
use_apt_of_host() {
  local archive=$1/etc/apt
  echo "deb $debian $suite main" >"$archive/sources.list"
  if [ "$suite" != sid ]; then
    echo "deb $debian $suite-updates main" >>"$archive/sources.list"
    echo "deb $security $suite-security main" >>"$archive/sources.list"
  fi
  apt-config dump | grep -iE '^Acquire::(https?|Check)' >"$archive/apt.conf.d/90host" || true
  cp -L /etc/resolv.conf "$1/etc/resolv.conf"
}

# in_root FOLDER COMMAND...: runs COMMAND in the root in FOLDER. Its mounts are seen by nothing
# else, and end with it.
in_root() {
  # shellcheck disable=SC2016,SC2046 # variables of the inner shell; list of words
  unshare --mount bash -c \
    'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"' "$1" \
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    $(env | grep -iE '^([a-z]+_proxy|CMAKE_BUILD_PARALLEL_LEVEL)=') "${@:2}"
}

# source_of LABEL: where apt gets Debian's archive of this label from.
source_of() {
  # shellcheck disable=SC2016 # apt's variables
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' "Label: $1" |
    sed -n 1p
}

folder=
copy=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --help) usage; exit ;;
    --root)
      [ $# -ge 2 ] || fail "--root: needs a folder"
      mkdir -p "$2"
      folder=$(cd "$2" && pwd)
      shift 2
      ;;
    --copy)
      [ -f "${2:-}" ] || fail "--copy: needs a file"
      copy=$(realpath "$2")
      shift 2
      ;;
    *) fail "unknown option '$1' (see --help)" ;;
  esac
done
suite=${1:-}
case $suite in
  bookworm | trixie | sid) ;;
  *) fail "which Debian? bookworm, trixie or sid (see --help)" ;;
esac
case ${2:-demo} in
  demo | test)
    [ $# -le 2 ] || fail "$2 takes no arguments (see --help)"
    command=("scripts/${2:-demo}.sh")
    ;;
  *) command=("${@:2}") ;;
esac
[ "$(id -u)" -eq 0 ] || fail "needs root"
install_packages debootstrap git

if [ -z "$folder" ]; then
  folder=$(mktemp -d)
  chmod 755 "$folder" # apt's own user looks into it
  trap 'rm -rf --one-file-system "$folder"' EXIT
fi
apt-get update -qq # what it fetches tells which sources are Debian's
debian=$(source_of Debian)
security=$(source_of Debian-Security)
[ -n "$debian" ] || fail "apt has no sources of Debian"
security=${security:-${debian%/debian*}/debian-security}
if [ -x "$folder/usr/bin/apt-get" ] && [ ! -e "$folder/debootstrap" ]; then
  echo "Using the Debian in $folder"
else
  [ -z "$(ls -A "$folder")" ] || fail "neither empty nor a Debian: '$folder'"
  echo "Making a bare $suite in $folder"
  eval "$(apt-config shell proxy Acquire::http::Proxy)"
  http_proxy=${http_proxy:-${proxy:-}} debootstrap --variant=minbase "$suite" "$folder" "$debian" \
    >/dev/null || fail "debootstrap failed; $folder/debootstrap/debootstrap.log tells why"
fi
use_apt_of_host "$folder"

rm -rf "$folder/root/isodiamonds"
git clone -q "$root" "$folder/root/isodiamonds"
if [ -n "$copy" ]; then
  cp "$copy" "$folder/root/isodiamonds"
fi
# X servers of other roots are seen, but their lock files are not: hence other numbers.
first=$((100 + RANDOM % 900))
in_root "$folder" bash -c "cd /root/isodiamonds && ISODIAMONDS_DISPLAY=$first \"\$@\"" bash "${command[@]}"
