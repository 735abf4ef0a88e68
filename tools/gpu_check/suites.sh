#!/usr/bin/env bash
# Runs tests of one program in several processes side by side: suites.sh PROGRAM FILTER PROCESSES. What they print comes line by line
# behind the number of the process: so it is known which tests ran when a process was ended.
set -uo pipefail
program=$1 filter=$2 processes=$3
export GTEST_TOTAL_SHARDS=$processes
children=()
for ((shard = 0; shard < processes; ++shard)); do
    GTEST_SHARD_INDEX=$shard "$program" --gtest_color=no --gtest_filter="$filter" 2>&1 | sed -u "s/^/$shard: /" &
    children+=($!) # with pipefail, its code is that of the program
done
code=0
for child in "${children[@]}"; do
    wait "$child" || code=1
done
exit $code
