#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the figures of docs/algorithm.md. Usage: docs/figures.sh [OUTPUT-FOLDER]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"

output=${1:-$root/docs/pictures}
# shellcheck disable=SC2086 # lists of words
install_packages $render_packages
install_build_packages
configure_and_build release >/dev/null
mkdir -p "$output"
PYTHONPATH=$build/lib/python3/dist-packages on_display \
  pvpython "$root/docs/figures.py" "$output"
