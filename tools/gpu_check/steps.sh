# shellcheck shell=bash disable=SC2034,SC2154 # the variables are those of gpu_check.sh
# What gpu_check.sh runs and how it ends what takes too long.

has_python=yes
if ! command -v python3 >/dev/null; then
    has_python=no
    echo "python3 is missing: no result.json is written, but all that it would be made of."
    failed+=("result.json (python3 is missing)")
fi
grace=3 # seconds from TERM to KILL
ending=5 # seconds of the budget that are kept for writing results
least=5 # seconds: with less a step is not begun
patience=$([ -n "$budget" ] && echo 5 || echo 20) # seconds for what only describes the machine

# What a step may take at most, in seconds, in the order of --prebuilt. The first nine always fit into six minutes, with what it takes
# to end each of them: 299 s, 9 times the grace and a second, 20 for unpacking and describing the machine, and what is kept. The others
# get what is left (tests/tools/gpu_check_test.sh adds them up).
limits="device:20 lab_patches:30 lab_columns:30 kernels:50 crowd:45 scene:20 scene_grouped:20 patch_suites:39 suites:45
    profile:40 view:30 levels:20 loop_levels:20 triangles:30 lab_cluster:20 lab_rows:15 lab_only:10"
# seconds_of STEP: where nobody has set a budget, it may take six times as long.
seconds_of() {
    local entry
    for entry in $limits; do
        [ "${entry%%:*}" != "$1" ] || echo $((${entry##*:} * $([ -n "$budget" ] && echo 1 || echo 6)))
    done
}
# Whatever hangs: by the end of the budget the script ends, and clean_up keeps what there is. For budgets of a minute and less steps
# alone keep to them.
guard_budget() {
    [ -n "$budget" ] || return 0
    (
        trap 'kill "$sleeper"; exit' TERM
        sleep $((budget > 65 ? budget - ending : 60)) &
        sleeper=$!
        wait "$sleeper" && kill -TERM $$
    ) </dev/null >/dev/null 2>&1 &
    guard=$!
}
guard=''

# After every step, so that nothing is lost if somebody ends the script.
result() {
    if [ "$has_python" = yes ]; then
        timeout $ending python3 "$scripts/result.py" "$parts" "$out/result.json" || failed+=("result.json")
    fi
    pack_parts
}
# Few files come back: one for all that result.json was made of.
pack_parts() {
    if [ "$parts" != "$out" ] && timeout $ending tar -czf "$out/parts.new" -C "$parts" .; then
        mv "$out/parts.new" "$out/parts.tar.gz"
    fi
}
# leave_out STEP REASON: so that nobody takes it for done.
leave_out() {
    echo "[$1] left out: $2"
    echo "$1,0,,$2" >>"$parts/steps.csv"
    result
}
# run STEP SECONDS command...: goes on after a failure and remembers it. What takes longer is ended. The log is STEP.txt.
run() {
    local step=$1 seconds=${limit:-$2} begin=$SECONDS code=0 log=$parts/$1.txt
    shift 2
    if [ -n "$budget" ]; then
        local left=$((budget - ending - grace - SECONDS))
        if [ $left -lt $least ]; then
            failed+=("$step (left out: no time is left)")
            leave_out "$step" "no time is left"
            return 1
        fi
        seconds=$((seconds < left ? seconds : left))
    fi
    echo "[$step] $(date +%T) $(shortened "$*")"
    timeout --kill-after=$grace "$seconds" "$@" >"$log" 2>&1 &
    running=$!
    # What hangs in a driver can outlive even KILL: then nobody waits for it.
    local end=$((SECONDS + seconds + grace + 1))
    while kill -0 $running 2>/dev/null && [ $SECONDS -le $end ]; do
        sleep 0.05
    done
    if kill -0 $running 2>/dev/null; then
        code=137
    else
        wait $running || code=$?
    fi
    running=''
    local why="exit code $code"
    case $code in
        124 | 137) why="ended after $seconds s" ;;
    esac
    if [ $code -ne 0 ]; then
        failed+=("$step ($why, see $(basename "$log"))")
        tail -n 5 "$log" | cut -c 1-500 | sed 's/^/    /'
    fi
    echo "[$step] $(date +%T) $why, $((SECONDS - begin)) s"
    echo "$step,$((SECONDS - begin)),$code," >>"$parts/steps.csv"
    result
    return $code
}
shortened() { if [ ${#1} -gt 300 ]; then echo "${1:0:300} .."; else echo "$1"; fi }
finish() {
    local step code why ended=''
    while IFS=, read -r step _ code why; do
        [ "$code$why" != 0 ] || ended+=" $step"
    done < <(cat "$parts/steps.csv" 2>/dev/null)
    echo "ran to their end:${ended:- nothing}"
    if [ ${#failed[@]} -gt 0 ]; then
        printf 'failed: %s\n' "${failed[@]}"
        exit "${1:-1}"
    fi
}
running='' watcher=''
# However the script ends: nothing stays behind, and what has been measured is kept.
clean_up() {
    [ -z "$running" ] || kill "$running" 2>/dev/null || true
    [ -z "$watcher" ] || kill "$watcher" 2>/dev/null || true
    [ -z "$guard" ] || kill "$guard" 2>/dev/null || true
    if [ -n "$prebuilt" ]; then
        pack_parts
        remove_unpacked
    fi
}
trap clean_up EXIT
trap 'failed+=("the rest (ended from outside, or the budget was over)"); finish 143' INT TERM

describe_machine() {
    echo "source: $(source_version)"
    uname -sr
    lscpu | grep -E '^(Model name|CPU\(s\)|Thread|L[23])' || true
    free -h | head -2 || true
    if command -v nvidia-smi >/dev/null; then
        timeout "$patience" nvidia-smi --format=csv \
            --query-gpu=name,driver_version,pstate,clocks.sm,clocks.mem,clocks.max.sm,clocks.max.mem,power.limit,memory.total || true
    else
        echo "no nvidia-smi"
    fi
    if command -v vulkaninfo >/dev/null; then
        timeout "$patience" vulkaninfo --summary 2>/dev/null | sed -n '/^Devices/,$p' || true
    fi
}
source_version() { cat "$build/version.txt" 2>/dev/null || git describe --always --dirty 2>/dev/null || echo unknown; }
watch_clocks() {
    if command -v nvidia-smi >/dev/null; then
        nvidia-smi --query-gpu=timestamp,clocks.sm,clocks.mem,utilization.gpu,power.draw,temperature.gpu --format=csv,nounits -l 1 \
            >"$parts/clocks.csv" 2>/dev/null &
        watcher=$!
    fi
}

# short SHORT LONG: the first with --quick.
short() { if [ "$quick" = yes ]; then echo "$1"; else echo "$2"; fi }
# frames LONG: few where they take long.
frames() { if [ "$is_cpu" = yes ]; then short 3 5; else short 3 "$1"; fi }
# profile STEP arguments...
profile() {
    local step=$1
    shift
    run "$step" "$(seconds_of "$step")" "$supple" profile "$@" "${device[@]}" --json "$parts/$step.json" || true
}

step_tests() {
    run tests 3600 "${validated[@]}" ctest --test-dir "$build" -j "$jobs" \
        --output-on-failure --output-junit "$parts/tests.xml" "${selection[@]}" || true
    grep -E 'tests passed|\(Failed\)|\(Timeout\)|\*\*\*' "$parts/tests.txt" | sed 's/^/    /' || true
}

# lab KIND: of kernels. The lab writes its figures at its end, so each kind has a run of its own, which measures `rows` besides.
lab() {
    local arguments=(--json "$out/lab_$1.json" --only "$1")
    if [ ! -x "$lab" ]; then
        leave_out "lab_$1" "there is no lab: $lab"
        return
    fi
    if [ ${#device[@]} -gt 0 ] && [[ ! ${device[1]} =~ ^[0-9]+$ ]]; then
        arguments+=("${device[@]}") # the lab knows devices by name alone
    fi
    run "lab_$1" "$(seconds_of "lab_$1")" "$lab" "${arguments[@]}" || true
}
step_lab() {
    if [ "$quick" = yes ]; then
        lab rows
    else
        lab patches
        lab columns
    fi
}
step_lab_rest() {
    local kind
    for kind in cluster rows only; do
        lab $kind
    done
}

step_bench() {
    local bench=("$supple" bench "${device[@]}" --json "$parts/bench.json")
    [ "$quick" = no ] || bench+=(--quick --cages pip_quads --schemes pm --crowd "$instances" --no-loading)
    run bench 2400 "${bench[@]}" || true
}

step_crowd() {
    local bench=("$supple" bench "${device[@]}" --json "$parts/bench.json" --cages none --crowd "$instances" --no-loading)
    if [ "$quick" = yes ]; then
        bench+=(--quick --schemes pm)
    else
        bench+=(--schemes 'prep,pm,catmull-clark')
    fi
    run crowd "$(seconds_of crowd)" "${bench[@]}" || true
}

# Evaluation by classes of patches: either mapping, and fan records beside coefficients.
step_kernels() {
    local bench=("$supple" bench "${device[@]}" --json "$parts/kernels.json" --cages none --crowd 0 --no-loading --kernels "$instances")
    if [ "$quick" = yes ]; then
        bench+=(--quick --schemes prep)
    else
        bench+=(--rounds 5)
    fi
    run kernels "$(seconds_of kernels)" "${bench[@]}" || true
}

step_profile() {
    local files=(samples/assets/pip.glb samples/assets/pip_quads.glb)
    local common=(--scheme "$(short pm all)" --instances "$instances")
    if [ -n "$prebuilt" ]; then
        profile profile samples/assets/pip_quads.glb "${common[@]}" --frames "$(frames 40)" --sweep "rate=$(short 4 4,8,16)"
        profile view "${files[@]}" "${common[@]}" --frames "$(frames 60)" --view
    else
        profile profile "${files[@]}" "${common[@]}" --frames "$(short 10 200)" --rate 8
        profile view "${files[@]}" "${common[@]}" --frames "$(short 10 200)" --view
    fi
}

# What a group of its own costs each of 60 characters is the difference between the two.
step_scene() {
    local kinds=(samples/assets/pip.glb samples/assets/pip_quads.glb) files=() i
    for ((i = 0; i < 60; ++i)); do
        files+=("${kinds[i % 2]}")
    done
    local common=(--view --instances 60 --frames "$(frames 100)" --budget "$(short 100000 1000000)")
    profile scene "${files[@]}" "${common[@]}"
    profile scene_grouped "${kinds[@]}" "${common[@]}"
}

# In views Catmull-Clark and Loop ask how far chains are to go, and have a dispatch for each kind of edge and patch.
step_patches() {
    local loop=(samples/assets/helmet.glb) file
    for file in ../shared/assets/characters/spot.glb ../shared/assets/khronos/Fox.glb; do
        [ ! -f "$file" ] || loop+=("$file")
    done
    local common=(--view --instances "$instances" --frames "$(frames 100)")
    profile levels samples/assets/pip.glb samples/assets/pip_quads.glb --scheme catmull-clark "${common[@]}"
    profile loop_levels "${loop[@]}" --scheme loop "${common[@]}"
}

# Loop's patches at rates.
step_triangles() {
    local bench=("$supple" bench "${device[@]}" --json "$parts/triangles.json" --cages triangles --schemes loop --crowd 0 --no-loading)
    if [ "$quick" = yes ]; then
        bench+=(--quick)
    else
        bench+=(--rates '4,8,16')
    fi
    run triangles "$(seconds_of triangles)" "${bench[@]}" || true
}

# Those of patches and kernels that had not run on a GPU at all, then those that had not run to their end on one.
step_suites() {
    local tests=$build/tests/runtime/supple_runtime_tests
    if [ ! -x "$tests" ]; then
        leave_out suites "there is no $tests"
    elif [ -n "$filter" ]; then
        suites suites "$filter"
    else
        suites patch_suites "$(short '*/LoopOnGpu.LowerRates*' "$(of_suites FanRecords LanePatches LodExact LodLoop LoopMappings LoopOnGpu)")"
        suites suites "$(short '*/SubdivisionOnGpu.AttributesReach*' \
            "$(of_suites BlendOnGpu ExactOnGpu IndexedMesh LodViewsOnce PmMappings PmOnGpu SubdivisionOnGpu)")"
    fi
}
# suites STEP FILTER
suites() {
    run "$1" "$(seconds_of "$1")" "${validated[@]}" "$scripts/suites.sh" "$tests" "$2" "$jobs" || true
    grep -F '[  FAILED  ]' "$parts/$1.txt" | sort -u | head -n 20 | sed 's/^/    /' || true
}
of_suites() {
    local suite
    for suite in "$@"; do
        printf '%s.*:*/%s.*:' "$suite" "$suite"
    done
}
