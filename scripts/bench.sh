#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the benchmark program, runs it and draws its plots.
set -euo pipefail

source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# For the results, for what Isodiamonds is compared with, and for the plots.
benchmark_packages="nlohmann-json3-dev libmeshoptimizer-dev libopenvdb-dev python3-matplotlib"
build=$root/build-bench
output=$root/benchmark-output

usage() {
  cat <<'END'
Usage: scripts/bench.sh [OPTIONS] [FILE[:ISOVALUE[:LOWER:UPPER]] ...]

Installs what is missing, builds into build-bench/, measures, and draws plots. Tables (.md), all
figures (.json) and plots (.png) go to benchmark-output/. Options and FILEs are passed on to
IsodiamondBenchmark, which without any takes --size 256. The main ones:

  --size N[,N...]  sizes of the synthetic volumes
  --fields A[,B]   which of them: marschner-lobb, gyroid, phantom, odd [all]
  --threads N      for all contestants
  --paper [--pad]  the paper's Table 2 and figure 15
  FILE             a volume, .raw with a name like tooth_103x94x161_uint8.raw, .nrrd or .nii

build-bench/bin/IsodiamondBenchmark --help lists all.
END
}

name=benchmark
arguments=()
for argument in "$@"; do
  case $argument in
    --help | -h)
      usage
      exit
      ;;
    --json | --json=*)
      echo "bench.sh: results go to $output; --json is for the program itself" >&2
      exit 1
      ;;
    --paper) name=paper ;;
  esac
  arguments+=("$argument")
done

# shellcheck disable=SC2086 # lists of words
install_packages $benchmark_packages
install_build_packages
(cd "$root" && cmake --preset release -B "$build" --log-level=WARNING \
  -DISODIAMONDS_WRAP_PYTHON=OFF -DISODIAMONDS_BUILD_BENCHMARKS=ON >/dev/null)
cmake --build "$build" --target IsodiamondBenchmark

mkdir -p "$output"
"$build/bin/IsodiamondBenchmark" "${arguments[@]}" "--json" "$output/$name.json" |
  tee "$output/$name.md"
/usr/bin/python3 "$root/Benchmarks/plots.py" "$output/$name.json" "$output"
