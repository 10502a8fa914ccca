#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes a Debian package of the commit HEAD in a bare Debian, and tries it out in another.
# Needs root.
#   scripts/check-package.sh bookworm|trixie|sid
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

[ $# -eq 1 ] || fail "which Debian? bookworm, trixie or sid"
folder=$(mktemp -d)
chmod 755 "$folder"
trap 'rm -rf --one-file-system "$folder"' EXIT
"$root/scripts/check-debian.sh" --root "$folder/make" "$1" scripts/package.sh
package=$(echo "$folder"/make/root/isodiamonds/build-package/isodiamonds_*.deb)
"$root/scripts/check-debian.sh" --root "$folder/try" --copy "$package" "$1" \
  scripts/try-package.sh "$(basename "$package")"
