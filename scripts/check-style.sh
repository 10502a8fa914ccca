#!/usr/bin/env bash
# Layers, formatting, the classes' documentation and static analysis. Any finding is a failure.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages clang-format clang-tidy
cd "$root"

echo "Layers"
python3 scripts/check-layers.py

echo "clang-format"
git ls-files '*.h' '*.cpp' '*.cxx' | xargs clang-format --dry-run -Werror

echo "Doxygen"
docs/doxygen.sh "$build/doxygen" >/dev/null

echo "clang-tidy"
if [ ! -f "$build/compile_commands.json" ]; then
  echo "Build first: scripts/test.sh" >&2
  exit 1
fi
# Most of the time goes into the headers of VTK and the standard library, so several files at a time
# are checked as one, with the flags of the first. They then share one unnamed namespace, in which
# names must not clash.
batches=$(mktemp -d)
trap 'rm -rf "$batches"' EXIT
python3 scripts/merge-sources.py "$build/compile_commands.json" "$batches" \
  Filters/Core Filters Plugin/ServerManager
cp .clang-tidy "$batches"
find "$batches" -name '*.cpp' -print0 | xargs -0 -P "$(nproc)" -n 1 \
  clang-tidy --quiet -p "$batches" --checks=-bugprone-suspicious-include
