#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Looks for arrays and files that do harm, with libFuzzer, AddressSanitizer and UBSan.
# Usage: scripts/fuzz.sh [SECONDS [Arrays|Files...]], by default both, for 30 minutes each. Findings
# stay in build-fuzz/found: put them into Testing/Data, where ctest runs them, and mend the cause.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=${1:-1800}
targets=("${@:2}")
if [ ${#targets[@]} -eq 0 ]; then
  targets=(Arrays Files)
fi

# shellcheck disable=SC2086 # a list of words
install_packages $render_packages $test_packages clang libclang-rt-14-dev
install_build_packages
configure_and_build fuzz >/dev/null

cd "$root"
# A file may claim any size: VTK's reader then runs out of memory, and leaks; that is no finding.
options=allocator_may_return_null=1:max_allocation_size_mb=2000
declare -A leaks=([Arrays]=1 [Files]=0)
for target in "${targets[@]}"; do
  corpus=build-fuzz/corpus/$target
  mkdir -p "$corpus" build-fuzz/found
  echo "Fuzz$target for $seconds s"
  ASAN_OPTIONS=$options:detect_leaks=${leaks[$target]} \
    build-fuzz/bin/Fuzz"$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4000 \
    -malloc_limit_mb=0 -print_final_stats=1 -artifact_prefix=build-fuzz/found/ \
    "$corpus" "Testing/Data/$target" >"build-fuzz/$target.log" 2>&1 ||
    { tail -n 60 "build-fuzz/$target.log"; exit 1; }
  grep -E "^Done|stat::number_of_executed_units" "build-fuzz/$target.log"
done
