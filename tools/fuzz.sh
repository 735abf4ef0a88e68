#!/usr/bin/env bash
# Fuzzes the readers with libFuzzer under the address and undefined-behaviour sanitizers; needs clang.
# Usage: tools/fuzz.sh HOURS [TARGET...]   (targets: gltf convert obj clips arrays cooked recordings replays pictures api; each gets its share of the time)
# Inputs that were new to it stay in build/fuzz/corpus, findings in build/fuzz/findings. The exit status is 1 if there are any.
# What it does without, for more inputs a second: notes of each comparison (trace-cmp in the preset, half of the time), weights of
# rare features (-entropic), and long inputs (-max_len): a few kilobytes hold every kind of element.
set -euo pipefail
cd "$(dirname "$0")/.."

hours=${1:?usage: tools/fuzz.sh HOURS [TARGET...]}
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(gltf convert obj clips arrays cooked recordings replays pictures api)
if ! command -v clang++ >/dev/null; then
    echo "clang++ is not installed: apt-get install clang libclang-rt-dev" >&2
    exit 3
fi
jobs=$(nproc)
cmake --preset fuzz
cmake --build --preset fuzz -j "$jobs" --target "${targets[@]/#/supple_fuzz_}"
seconds=$(awk -v hours="$hours" -v targets="${#targets[@]}" 'BEGIN { printf "%d", hours * 3600 / targets }')
findings=$PWD/build/fuzz/findings
mkdir -p "$findings"
status=0
for target in "${targets[@]}"; do
    seeds=$target
    [[ $target != convert && $target != cooked ]] || seeds=gltf
    [ "$target" != recordings ] || seeds=../../data/recordings
    corpus=build/fuzz/corpus/$target
    limits=(-timeout=10 -rss_limit_mb=2048)
    leaks=1
    case $target in
        obj) length=2048 ;;
        pictures | cooked) length=65536 ;;
        *) length=8192 ;;
    esac
    if [ "$target" = api ] || [ "$target" = replays ]; then # the driver under it compiles shaders, and keeps some memory
        limits=(-timeout=120 -rss_limit_mb=4096)
        leaks=0
    fi
    mkdir -p "$corpus"
    echo "== $target, $seconds s"
    ASAN_OPTIONS=detect_leaks=$leaks "build/fuzz/tests/fuzz/supple_fuzz_$target" -entropic=0 -max_total_time="$seconds" \
        -max_len="$length" "${limits[@]}" -malloc_limit_mb=256 -print_final_stats=1 -artifact_prefix="$findings/$target-" \
        "$corpus" "tests/fuzz/corpus/$seeds" 2>&1 | tail -n 25 || status=1
done
exit $status
