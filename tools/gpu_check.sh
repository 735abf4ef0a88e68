#!/usr/bin/env bash
# One call on a machine with a GPU: builds, runs the tests, measures, and leaves everything in one folder, the figures in one
# result.json. Needs no network where the packages of tools/packages.sh are installed.
# Usage: tools/gpu_check.sh [--out FOLDER] [--build-dir FOLDER] [--steps build,tests,bench,profile] [--quick]
#                           [--device NAME|INDEX] [--allow-cpu] [--instances N] [--tests REGEX] [--timeout SECONDS]
#                           [--no-validation] [--no-install]
#   --out         build/gpu-check
#   --build-dir   build/release
#   --steps       all four
#   --quick       short forms: does it all work?
#   --device      for the measurements; tests take the best device there is
#   --allow-cpu   go on where the device is a CPU, with smaller crowds
#   --instances   of the profiled crowd: 1000; 8 with --quick and on CPUs
#   --tests       only these, as ctest -R has them
#   --timeout     of every step, instead of its own
# What it leaves: result.json, written anew after every step; and what that was made of: device.json, machine.txt, tests.txt,
# tests.xml, bench.json, bench.txt, profile.json, profile.txt, view.json, view.txt, clocks.csv (where nvidia-smi is).
# Exit code: 0 when every step succeeded; 1: the steps that failed are named at the end; 3: there is no device, or only a CPU.
set -euo pipefail
cd "$(dirname "$0")/.."
# shellcheck source=tools/packages.sh disable=SC2154
. tools/packages.sh

out=build/gpu-check
build=build/release
steps=build,tests,bench,profile
quick=no
allow_cpu=no
device=()
instances=
selection=()
limit=
validation=1
install=yes
usage() { sed -n '4,6p' tools/gpu_check.sh | sed 's/^# //' >&2; exit 2; }
while [ $# -gt 0 ]; do
    case "$1" in
        --out) out=${2:?}; shift ;;
        --build-dir) build=${2:?}; shift ;;
        --steps) steps=${2:?}; shift ;;
        --quick) quick=yes ;;
        --device) device=(--device "${2:?}"); shift ;;
        --allow-cpu) allow_cpu=yes ;;
        --instances) instances=${2:?}; shift ;;
        --tests) selection=(-R "${2:?}"); shift ;;
        --timeout) limit=${2:?}; shift ;;
        --no-validation) validation=0 ;;
        --no-install) install=no ;;
        *) usage ;;
    esac
    shift
done
for step in ${steps//,/ }; do
    case "$step" in build | tests | bench | profile) ;; *) usage ;; esac
done
mkdir -p "$out"
out=$(cd "$out" && pwd) # ctest changes folders
# Of this call alone.
rm -f "$out"/{result,device,bench,profile,view}.json "$out"/{steps,clocks}.csv "$out"/tests.xml
supple=$build/bin/supple
jobs=$(nproc)
failed=()

wanted() { [[ ",$steps," == *",$1,"* ]]; }
result() { python3 tools/gpu_check_result.py "$out" || failed+=("result.json"); }
# run STEP LOG SECONDS command...: goes on after a failure and remembers it. What takes longer is ended.
run() {
    local step=$1 log=$2 seconds=${limit:-$3} begin=$SECONDS code=0
    shift 3
    echo "[$step] $(date +%T) $*"
    timeout --kill-after=10 "$seconds" "$@" >"$log" 2>&1 || code=$?
    local why="exit code $code"
    [ $code -ne 124 ] || why="ended after $seconds s"
    if [ $code -ne 0 ]; then
        failed+=("$step ($why, see $log)")
        tail -n 5 "$log" | sed 's/^/    /'
    fi
    echo "[$step] $(date +%T) $why, $((SECONDS - begin)) s"
    echo "$step,$((SECONDS - begin)),$code" >>"$out/steps.csv"
    result
    return $code
}
finish() {
    if [ ${#failed[@]} -gt 0 ]; then
        printf 'failed: %s\n' "${failed[@]}"
        exit "${1:-1}"
    fi
}

if wanted build; then
    if [ "$install" = yes ]; then
        # What cannot be installed, the build or a test will miss and name.
        install_missing "${supple_packages[@]}" "${supple_test_packages[@]}" || true
    fi
    # shellcheck disable=SC2016 # the inner shell's
    run build "$out/build.txt" 2400 bash -c \
        'cmake --preset release -B "$0" -DSUPPLE_BUILD_TESTS=ON && cmake --build "$0" -j "$1"' "$build" "$jobs" || finish
    rm "$out/build.txt" # says nothing when all went well
fi

{
    echo "source: $(git describe --always --dirty 2>/dev/null || echo unknown)"
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

# One frame of a cage: is there a device, and which?
run device "$out/device.txt" 120 "$supple" profile samples/assets/pip_quads.glb --scheme cage --frames 1 "${device[@]}" \
    --json "$out/device.json" || finish 3
is_cpu=$(python3 -c 'import json, sys; print("yes" if json.load(open(sys.argv[1]))["machine"]["cpuDevice"] else "no")' "$out/device.json")
if [ "$is_cpu" = yes ]; then
    echo "The device is a CPU: $(head -n 1 "$out/device.txt")"
    if [ "$allow_cpu" = no ]; then
        echo "No GPU was found, so nothing was tested or measured. --allow-cpu goes on with smaller crowds." >&2
        exit 3
    fi
fi
if [ "$quick" = yes ] || [ "$is_cpu" = yes ]; then
    instances=${instances:-8}
fi
instances=${instances:-1000}

if command -v nvidia-smi >/dev/null; then
    nvidia-smi --query-gpu=timestamp,clocks.sm,clocks.mem,utilization.gpu,power.draw,temperature.gpu --format=csv,nounits -l 1 \
        >"$out/clocks.csv" 2>/dev/null &
    watcher=$!
    trap 'kill "$watcher" 2>/dev/null || true' EXIT
fi

if wanted tests; then
    run tests "$out/tests.txt" 3600 env SUPPLE_VALIDATION=$validation ctest --test-dir "$build" -j "$jobs" \
        --output-on-failure --output-junit "$out/tests.xml" "${selection[@]}" || true
    grep -E 'tests passed|\(Failed\)|\(Timeout\)|\*\*\*' "$out/tests.txt" | sed 's/^/    /' || true
fi
if wanted bench; then
    bench=("$supple" bench "${device[@]}" --json "$out/bench.json")
    [ "$quick" = no ] || bench+=(--quick --cages pip_quads --schemes pm --crowd "$instances" --no-loading)
    run bench "$out/bench.txt" 2400 "${bench[@]}" || true
fi
if wanted profile; then
    frames=200 scheme=all
    [ "$quick" = no ] || frames=10 scheme=pm
    profile=("$supple" profile samples/assets/pip.glb samples/assets/pip_quads.glb --scheme "$scheme" --instances "$instances"
        --frames "$frames" "${device[@]}")
    run profile "$out/profile.txt" 900 "${profile[@]}" --rate 8 --json "$out/profile.json" || true
    run view "$out/view.txt" 900 "${profile[@]}" --view --json "$out/view.json" || true
fi

finish
echo "Results are in $out."
