#!/usr/bin/env bash
# Formatting, static analysis, and the rule that the core knows no VTK. Any finding is a failure.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages clang-format clang-tidy
cd "$root"

echo "No VTK in the core"
if grep -rnE '#include *["<](vtk|paraview|pq)' Filters/Core; then
  echo "Filters/Core must not include VTK." >&2
  exit 1
fi

echo "clang-format"
git ls-files '*.h' '*.cpp' '*.cxx' | xargs clang-format --dry-run -Werror

echo "clang-tidy"
if [ ! -f "$build/compile_commands.json" ]; then
  echo "Build first: scripts/test.sh" >&2
  exit 1
fi
git ls-files 'Filters/*.cpp' 'Filters/*.cxx' |
  xargs -P "$(nproc)" -n 2 clang-tidy --quiet -p "$build"
