#!/usr/bin/env bash
# One call on a machine with a GPU: builds, runs the tests, measures, and leaves everything in one folder. Needs no network
# where the packages of tools/packages.sh are installed. Works on CPU devices, too.
# Usage: tools/gpu_check.sh [--out FOLDER] [--steps build,tests,bench,profile] [--quick] [--device NAME|INDEX]
#                           [--instances N] [--tests REGEX] [--no-validation] [--no-install]
#   --out         build/gpu-check
#   --steps       all four
#   --quick       the benchmark's quick form and a crowd of 8: does it all work?
#   --device      for the measurements; tests take the best device there is
#   --instances   of the crowd: 1000
#   --tests       only these, as ctest -R has them
# What it leaves: machine.txt, tests.txt, bench.json, bench.txt, profile.json, profile.txt, clocks.csv (where nvidia-smi is).
# Exit code: 0 when every step succeeded; otherwise the steps that failed are named at the end.
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck source=tools/packages.sh disable=SC2154
. tools/packages.sh

out=build/gpu-check
steps=build,tests,bench,profile
quick=no
device=()
instances=
selection=()
validation=1
install=yes
usage() { sed -n '4,5p' tools/gpu_check.sh | sed 's/^# //' >&2; exit 2; }
while [ $# -gt 0 ]; do
    case "$1" in
        --out) out=${2:?}; shift ;;
        --steps) steps=${2:?}; shift ;;
        --quick) quick=yes ;;
        --device) device=(--device "${2:?}"); shift ;;
        --instances) instances=${2:?}; shift ;;
        --tests) selection=(-R "${2:?}"); shift ;;
        --no-validation) validation=0 ;;
        --no-install) install=no ;;
        *) usage ;;
    esac
    shift
done
for step in ${steps//,/ }; do
    case "$step" in build | tests | bench | profile) ;; *) usage ;; esac
done
[ "$quick" = yes ] && instances=${instances:-8} || instances=${instances:-1000}
mkdir -p "$out"
supple=build/release/bin/supple
jobs=$(nproc)
failed=()

wanted() { [[ ",$steps," == *",$1,"* ]]; }
# run STEP LOG command...: goes on after a failure and remembers it.
run() {
    local step=$1 log=$2 begin=$SECONDS code=0
    shift 2
    echo "[$step] $*"
    "$@" >"$log" 2>&1 || code=$?
    if [ $code -ne 0 ]; then
        failed+=("$step ($code, see $log)")
        tail -n 5 "$log" | sed 's/^/    /'
    fi
    echo "[$step] exit code $code after $((SECONDS - begin)) s"
}

if wanted build; then
    if [ "$install" = yes ]; then
        # What cannot be installed, the build or a test will miss and name.
        install_missing "${supple_packages[@]}" "${supple_test_packages[@]}" || true
    fi
    build() { cmake --preset release -DSUPPLE_BUILD_TESTS=ON && cmake --build --preset release -j "$jobs"; }
    run build "$out/build.txt" build
    if [ ${#failed[@]} -gt 0 ]; then
        exit 1
    fi
    rm "$out/build.txt" # says nothing when all went well
fi

{
    git describe --always --dirty 2>/dev/null || true
    uname -sr
    lscpu | grep -E '^(Model name|CPU\(s\)|Thread|L[23])' || true
    free -h | head -2 || true
    if command -v nvidia-smi >/dev/null; then
        nvidia-smi --query-gpu=name,driver_version,pstate,clocks.sm,clocks.mem,clocks.max.sm,clocks.max.mem,power.limit,memory.total \
            --format=csv || true
    else
        echo "no nvidia-smi"
    fi
    if command -v vulkaninfo >/dev/null; then
        vulkaninfo --summary 2>/dev/null | sed -n '/^Devices/,$p' || true
    fi
} >"$out/machine.txt"
cat "$out/machine.txt"

watcher=
if command -v nvidia-smi >/dev/null; then
    nvidia-smi --query-gpu=timestamp,clocks.sm,clocks.mem,utilization.gpu,power.draw,temperature.gpu --format=csv -l 1 \
        >"$out/clocks.csv" 2>/dev/null &
    watcher=$!
    trap 'kill "$watcher" 2>/dev/null || true' EXIT
fi

if wanted tests; then
    run tests "$out/tests.txt" env SUPPLE_VALIDATION=$validation ctest --preset release -j "$jobs" "${selection[@]}"
    grep -E 'tests passed|\(Failed\)|\(Timeout\)|\*\*\*' "$out/tests.txt" | sed 's/^/    /' || true
fi
if wanted bench; then
    bench=("$supple" bench "${device[@]}" --json "$out/bench.json")
    [ "$quick" = no ] || bench+=(--quick)
    run bench "$out/bench.txt" "${bench[@]}"
fi
if wanted profile; then
    frames=200
    [ "$quick" = no ] || frames=10
    run profile "$out/profile.txt" "$supple" profile samples/assets/pip.glb samples/assets/pip_quads.glb --scheme all --rate 8 \
        --instances "$instances" --frames "$frames" "${device[@]}" --json "$out/profile.json"
fi

if [ ${#failed[@]} -gt 0 ]; then
    printf 'failed: %s\n' "${failed[@]}"
    exit 1
fi
echo "Results are in $out."
