#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Plants hundreds of small faults in the core, one at a time, and prints those that its tests do not
# find. Takes an hour or two; later runs build only what changed. Arguments go to mutate.py:
# scripts/mutate.sh [--seconds N] [--again] [FILE...], e.g. scripts/mutate.sh Patches/ Encoder.cpp
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# shellcheck disable=SC2086 # a list of words
install_packages $compile_packages libgtest-dev python3
exec python3 "$root/scripts/mutate.py" "$@"
