#!/usr/bin/env bash
# One call on a machine with a GPU: runs tests, measures, and leaves the figures in one result.json.
# Usage: tools/gpu_check.sh [--out FOLDER] [--build-dir FOLDER] [--steps build,tests,bench,profile] [--quick]
#                           [--device NAME|INDEX] [--allow-cpu] [--instances N] [--tests REGEX] [--suites FILTER]
#                           [--timeout SECONDS] [--budget SECONDS] [--no-validation] [--no-install] [--lab FOLDER]
#        tools/gpu_check.sh --pack FOLDER [--build-dir FOLDER] [--no-build] [--lab FOLDER]
#        FOLDER/tools/gpu_check.sh --prebuilt FOLDER [--out FOLDER] [..]
#   --out         build/gpu-check; with --prebuilt: gpu-check
#   --build-dir   build/release
#   --steps       build, tests, bench, profile. There are also lab, kernels, crowd, scene, suites, patches, triangles and lab_rest.
#                 With --prebuilt: lab, kernels, crowd, scene, suites, profile, patches, triangles, lab_rest. They run in this
#                 order, in whatever order they are named
#   --quick       short forms: does it all work?
#   --device      for the measurements; tests take the best device there is
#   --allow-cpu   go on where the device is a CPU, with smaller crowds
#   --instances   of the crowds: 1000; 8 with --quick and on CPUs
#   --tests       of ctest: only these, as ctest -R has them
#   --suites      of the step suites: only these, as --gtest_filter has them
#   --timeout     of every step, instead of its own
#   --budget      of the whole call: a step gets what is left at most, and the script ends by then. With --prebuilt 360, else none
#   --lab         where the lab of kernels has its sources: ../shared/gpu_lab. If there is none, its step is left out
#   --pack        builds and collects in FOLDER what --prebuilt needs on another machine: no compiler, no cmake, no network
# Steps: lab: kernels side by side, a file lab_*.json for each kind; lab_rest: the other kinds. kernels: `supple bench --kernels`,
# evaluation by classes of patches, with fan records beside coefficients. crowd: its crowd alone, at rates 4, 8 and 16. scene: 60
# characters in one view, a group each, and the same 60 in two groups. suites: device tests of kernels that no GPU has run, and those
# that take long. profile: a crowd by passes; with --prebuilt at these rates. patches: Catmull-Clark's and Loop's in views.
# triangles: Loop's at rates.
# What it leaves: result.json, written anew after every step; lab_*.json; and what these were made of: a .json and a .txt of each
# measurement, machine.txt, tests.xml, clocks.csv (where nvidia-smi is). With --prebuilt these are packed into parts.tar.gz, anew
# after every step. So a call that is ended from outside leaves what it had.
# Exit code: 0 when every step succeeded; 1: the steps that failed are named at the end; 3: there is no device, or only a CPU.
set -euo pipefail
called_from=$PWD
cd "$(dirname "$0")/.."
root=$PWD
scripts=$root/tools/gpu_check

out='' pack='' prebuilt=''
build=$root/build/release
lab_sources=$root/../shared/gpu_lab
steps='' build_first=yes install=yes
quick=no allow_cpu=no
device=() instances='' selection=() filter='' validated=(env SUPPLE_VALIDATION=1)
limit='' budget=''
usage() { sed -n '3,7p' "$root/tools/gpu_check.sh" | sed 's/^# //' >&2; exit 2; }
absolute() { case "$1" in /*) echo "$1" ;; *) echo "$called_from/$1" ;; esac }
while [ $# -gt 0 ]; do
    case "$1" in
        --out) out=$(absolute "${2:?}"); shift ;;
        --build-dir) build=$(absolute "${2:?}"); shift ;;
        --pack) pack=$(absolute "${2:?}"); shift ;;
        --prebuilt) prebuilt=$(absolute "${2:?}"); shift ;;
        --lab) lab_sources=$(absolute "${2:?}"); shift ;;
        --steps) steps=${2:?}; shift ;;
        --quick) quick=yes ;;
        --device) device=(--device "${2:?}"); shift ;;
        --allow-cpu) allow_cpu=yes ;;
        --instances) instances=${2:?}; shift ;;
        --tests) selection=(-R "${2:?}"); shift ;;
        --suites) filter=${2:?}; shift ;;
        --timeout) limit=${2:?}; shift ;;
        --budget) budget=${2:?}; shift ;;
        --no-validation) validated=(env -u SUPPLE_VALIDATION) ;; # any value switches it on
        --no-install) install=no ;;
        --no-build) build_first=no ;;
        *) usage ;;
    esac
    shift
done
if [ -n "$pack" ]; then
    exec "$scripts/pack.sh" "$pack" "$build" "$lab_sources" "$build_first"
fi
known=" build tests bench lab kernels crowd scene suites profile patches triangles lab_rest "
if [ -n "$prebuilt" ]; then
    known=" lab kernels crowd scene suites profile patches triangles lab_rest "
    steps=${steps:-lab,kernels,crowd,scene,suites,profile,patches,triangles,lab_rest}
    budget=${budget:-360}
    validated=(env -u SUPPLE_VALIDATION) # the layer is not carried
    out=${out:-$called_from/gpu-check}
fi
steps=${steps:-build,tests,bench,profile} out=${out:-$root/build/gpu-check}
wanted() { [[ ",$steps," == *",$1,"* ]]; }
for step in ${steps//,/ }; do
    [[ "$known" == *" $step "* ]] || usage
done
if wanted bench && wanted crowd; then
    echo "The step bench has the crowd already: leave out one of bench and crowd." >&2
    exit 2
fi
mkdir -p "$out"
out=$(cd "$out" && pwd)
parts=$out # what result.json is made of
# Of this call alone.
rm -f "$out"/{result,device,bench,kernels,triangles,profile,view,scene,scene_grouped,levels,loop_levels}.json "$out"/lab_*.json \
    "$out"/{steps,clocks}.csv \
    "$out"/{tests.xml,suites.txt,patch_suites.txt,parts.tar.gz}
jobs=$(nproc)
failed=()

# shellcheck source=tools/gpu_check/steps.sh
. "$scripts/steps.sh"
guard_budget
if [ -n "$prebuilt" ]; then
    # shellcheck source=tools/gpu_check/prebuilt.sh
    . "$scripts/prebuilt.sh"
    unpack "$prebuilt"
fi
supple=$build/bin/supple
lab=$build/gpu_lab/gpu_lab

if wanted build; then
    if [ "$install" = yes ]; then
        # shellcheck source=tools/packages.sh disable=SC2154
        . tools/packages.sh
        # What cannot be installed, the build or a test will miss and name.
        install_missing "${supple_packages[@]}" "${supple_test_packages[@]}" || true
    fi
    # shellcheck disable=SC2016 # the inner shell's
    run build 2400 bash -c \
        'cmake --preset release -B "$0" -DSUPPLE_BUILD_TESTS=ON && cmake --build "$0" -j "$1"' "$build" "$jobs" || finish
    rm "$parts/build.txt" # says nothing when all went well
fi
if { wanted lab || wanted lab_rest; } && [ -z "$prebuilt" ] && [ -d "$lab_sources" ]; then
    run lab_build 600 "$scripts/build_lab.sh" "$lab_sources" "$build/gpu_lab" || true
fi

describe_machine >"$parts/machine.txt"
cat "$parts/machine.txt"
# One frame of a cage: is there a device, and which?
run device "$(seconds_of device)" "$supple" profile samples/assets/pip_quads.glb --scheme cage --frames 1 "${device[@]}" --json "$parts/device.json" ||
    finish 3
is_cpu=no
if grep -Eq '"cpuDevice": *true' "$parts/device.json"; then
    is_cpu=yes
    echo "The device is a CPU: $(head -n 1 "$parts/device.txt")"
    if [ "$allow_cpu" = no ]; then
        echo "No GPU was found, so nothing was tested or measured. --allow-cpu goes on with smaller crowds." >&2
        exit 3
    fi
fi
if [ "$quick" = yes ] || [ "$is_cpu" = yes ]; then
    instances=${instances:-8}
fi
instances=${instances:-1000}
watch_clocks

# The most valuable first: what comes late gets what is left of the budget.
for step in tests lab bench kernels crowd scene suites profile patches triangles lab_rest; do
    if wanted "$step"; then
        "step_$step"
    fi
done

finish
echo "Results are in $out."
