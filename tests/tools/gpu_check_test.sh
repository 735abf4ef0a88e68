#!/usr/bin/env bash
# tools/gpu_check.sh on whatever device there is, without building: gpu_check_test.sh SOURCES SUPPLE RUNTIME_TESTS. ctest runs two
# made-up tests, one of which fails; nvidia-smi and the lab are made up as well.
set -euo pipefail
sources=$1 supple=$2 runtime_tests=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder"/build/bin "$folder"/build/tests/runtime "$folder"/programs
ln -s "$supple" "$folder/build/bin/supple"
ln -s "$runtime_tests" "$folder/build/tests/runtime/supple_runtime_tests"
printf 'add_test(good true)\nadd_test(bad false)\n' >"$folder/build/CTestTestfile.cmake"
cat >"$folder/programs/nvidia-smi" <<'SMI'
#!/bin/sh
case "$*" in
*timestamp*) printf 'timestamp, clocks.current.sm [MHz], power.draw [W]\nnow, 1000, 50.5\nnow, 1980, [N/A]\nnow, 1500, 70.5\n' ;;
*) printf 'name, driver_version\nMade Up, 1.2\n' ;;
esac
SMI
chmod +x "$folder/programs/nvidia-smi"
export PATH=$folder/programs:$PATH
# No step is ended because the machine is slow.
check() {
    "$sources/tools/gpu_check.sh" --build-dir "$folder/build" --out "$folder/out" --quick --timeout 3600 "$@" >"$folder/log" 2>&1
}
fail() {
    echo "FAILED: $*"
    cat "$folder/log"
    exit 1
}
# expect CONDITION: of result, as Python says it.
expect() {
    python3 -c 'import json, sys
result = json.load(open(sys.argv[1]))
steps = {step["step"]: step for step in result["steps"]}
assert eval(sys.argv[2]), json.dumps(result, indent=1)[:4000]' "$folder/out/result.json" "$1" || fail "$1"
}

# A CPU is no GPU.
code=0
check --steps tests || code=$?
if python3 -c 'import json, sys; sys.exit(not json.load(open(sys.argv[1]))["machine"]["cpuDevice"])' "$folder/out/result.json"; then
    [ $code -eq 3 ] || fail "exit code $code on a CPU"
    grep -q "No GPU was found" "$folder/log" || fail "does not say that there is no GPU"
    expect 'list(steps) == ["device"] and result["tests"] is None'
fi

code=0
check --steps tests,lab,bench,profile --allow-cpu --lab "$folder/nowhere" || code=$?
[ $code -eq 1 ] || fail "exit code $code with a test that fails"
grep -q 'failed: tests (exit code 8' "$folder/log" || fail "does not name the step"
expect 'list(steps) == ["device", "tests", "lab_rows", "bench", "profile", "view"]'
expect 'all(step["exitCode"] == {"tests": 8, "lab_rows": None}.get(step["step"], 0) and not step["timedOut"] for step in result["steps"])'
expect '"there is no lab" in steps["lab_rows"]["leftOut"]'
expect 'result["tests"] == {"passed": 1, "failed": 1, "skipped": 0, "failedNames": ["bad"], "skippedNames": []}'
expect 'result["machine"]["device"] == result["bench"]["machine"]["device"] != ""'
expect '"Made Up, 1.2" in result["system"]'
expect 'result["clocks"]["clocks.current.sm [MHz]"] == {"least": 1000, "median": 1500, "largest": 1980}'
expect 'result["clocks"]["power.draw [W]"]["largest"] == 70.5 and "timestamp" not in result["clocks"]'
expect 'result["bench"]["complete"] and len(result["bench"]["rows"]) == 1'
expect 'all(row["frameMs"] > 0 for row in result["crowd"]["rows"]) and len(result["crowd"]["rows"]) == 2'
expect 'len(result["profile"]["runs"]) == 2 and len(result["view"]["runs"]) == 1'

# Where no time is left, nothing begins.
code=0
check --steps profile --allow-cpu --budget 12 || code=$?
[ $code -eq 3 ] || fail "exit code $code without time"
expect 'list(steps) == ["device"] and steps["device"]["leftOut"] == "no time is left"'

# The packed form, where nothing is installed but what stands here, from another folder. What it leaves is few files.
mkdir -p "$folder"/lab "$folder"/bare "$folder"/elsewhere "$folder"/tmp
cat >"$folder/lab/build.sh" <<'LAB'
#!/bin/sh
printf '#!/bin/sh\necho "$@" >>"$2"\n' >"$1/gpu_lab"
chmod +x "$1/gpu_lab"
LAB
chmod +x "$folder/lab/build.sh"
"$sources/tools/gpu_check.sh" --pack "$folder/pack" --build-dir "$folder/build" --no-build --lab "$folder/lab" >"$folder/log" 2>&1 ||
    fail "does not pack"
for name in basename bash cat cut date dirname env find free grep gzip head ldconfig ldd ln ls lscpu mkdir mktemp mv nproc realpath rm sed sh \
    sleep sort tail tar timeout uname; do
    if path=$(PATH=$PATH:/sbin:/usr/sbin command -v "$name"); then
        ln -s "$path" "$folder/bare/$name"
    fi
done
ln -s "$(python3 -c 'import sys; print(sys.executable)')" "$folder/bare/python3"
packed() {
    (cd "$folder/elsewhere" && env -i PATH="$folder/bare" TMPDIR="$folder/tmp" ASAN_OPTIONS="${ASAN_OPTIONS:-}" \
        ${VK_DRIVER_FILES:+"VK_DRIVER_FILES=$VK_DRIVER_FILES"} ${VK_ICD_FILENAMES:+"VK_ICD_FILENAMES=$VK_ICD_FILENAMES"} \
        "$folder/pack/tools/gpu_check.sh" --prebuilt ../pack --out ../out --quick --allow-cpu --timeout 3600 --budget 9000 \
        "$@") >"$folder/log" 2>&1
}
rm -rf "$folder/out"
packed --steps lab,kernels,scene,patches,suites || fail "the packed form fails"
expect '[step["step"] for step in result["steps"]] == ["device", "lab_rows", "kernels", "scene", "scene_grouped", "patch_suites", "suites",
        "levels", "loop_levels"] and all(step["exitCode"] == 0 for step in result["steps"])'
expect '[(run["instances"], len(run["surfaces"])) for scene in ("scene", "sceneGrouped") for run in result[scene]["runs"]] == [
        (60, 2 * 60), (60, 2 * 2)]'
expect '[run["scheme"] for scene in ("levels", "loopLevels") for run in result[scene]["runs"]] == ["catmull-clark", "loop"]'
expect '[(row["class"], len(row["ways"])) for row in result["kernels"]["kernels"]] == [("all", 4), ("regular", 4), ("perturbed", 4)]'
none='"failed": 0, "skipped": 0, "notRun": 0, "failedNames": [], "skippedNames": [], "endedNames": []'
expect "result['suites'] == {'passed': 4, $none} and result['patchSuites'] == {'passed': 2, $none}"
[ "$(cat "$folder/out/lab_rows.json")" = "--json $folder/out/lab_rows.json --only rows" ] || fail "the lab was told something else"
[ "$(cd "$folder/out" && echo *)" = "lab_rows.json parts.tar.gz result.json" ] || fail "leaves other files"
[[ $(tar -tzf "$folder/out/parts.tar.gz") == */scene.json* ]] || fail "the parts are not packed"
[ -z "$(ls "$folder/tmp")" ] || fail "leaves temporary files"
# Without Python all is measured, but for result.json.
rm "$folder/bare/python3"
code=0
packed --steps lab || code=$?
[ $code -eq 1 ] || fail "exit code $code without Python"
grep -q 'failed: result.json (python3 is missing)' "$folder/log" || fail "does not say that Python is missing"
[ "$(cd "$folder/out" && echo *)" = "lab_rows.json parts.tar.gz" ] || fail "leaves other files without Python"
# What the processes of suites printed before they were ended.
mkdir "$folder/parts"
echo 'suites,180,124,' >"$folder/parts/steps.csv"
cat >"$folder/parts/suites.txt" <<'SUITES'
0: [==========] Running 4 tests from 2 test suites.
1: [==========] Running 2 tests from 1 test suite.
0: [ RUN      ] A.Good
1: [ RUN      ] Mappings/B.Bad/Wide
0: [       OK ] A.Good (12 ms)
1: [  FAILED  ] Mappings/B.Bad/Wide, where GetParam() = 1 (3 ms)
0: [ RUN      ] A.Skipped
1: [ RUN      ] Mappings/B.Slow/Wide
0: [  SKIPPED ] A.Skipped (0 ms)
0: [ RUN      ] A.AlsoSlow
2: [==========] Running 1 test from 1 test suite.
2: [ RUN      ] A.Bad
2: [  FAILED  ] A.Bad (1 ms)
2: [  FAILED  ] 1 test, listed below:
2: [  FAILED  ] A.Bad
SUITES
python3 "$sources/tools/gpu_check/result.py" "$folder/parts" "$folder/out/result.json"
expect 'steps["suites"]["timedOut"] and result["suites"] == {"passed": 1, "failed": 2, "skipped": 1, "notRun": 1,
        "failedNames": ["A.Bad", "Mappings/B.Bad/Wide"], "skippedNames": ["A.Skipped"],
        "endedNames": ["A.AlsoSlow", "Mappings/B.Slow/Wide"]}'

# The first nine steps fit into six minutes, whatever each of them does: with the grace of each, what comes before, and the end.
seconds=$((20 + 5))
# shellcheck disable=SC2013 # words
for entry in $(sed -n '/^limits="/,/"$/p' "$sources/tools/gpu_check/steps.sh" | tr -d '"' | sed 's/^limits=//' | tr '\n' ' ' | cut -d ' ' -f 1-9); do
    seconds=$((seconds + ${entry##*:} + 4))
done
[ $seconds -gt 300 ] && [ $seconds -le 360 ] || fail "the first steps take up to $seconds s"

# A filter for a suite that has another name by now would run nothing.
known=$("$runtime_tests" --gtest_list_tests)
# shellcheck disable=SC2013 # words
for suite in $(sed -n 's/.*(of_suites \([^)]*\)).*/\1/p' "$sources/tools/gpu_check/steps.sh"); do
    grep -Eq "^([A-Za-z]+/)?$suite\.$" <<<"$known" || fail "there are no tests $suite"
    suites_found=yes
done
[ "${suites_found:-no}" = yes ] || fail "finds no names of suites"

# A step that takes too long is ended; what was measured before is kept. No clock decides here: timeout(1) is made up and
# writes down what it was told; so is a benchmark that leaves half a result and the exit code of a program that was ended.
cat >"$folder/programs/timeout" <<TIMEOUT
#!/bin/sh
echo "\$@" >>"$folder/limits"
case "\$1" in --kill-after=*) shift ;; esac
shift # the limit
exec "\$@"
TIMEOUT
rm "$folder/build/bin/supple"
cat >"$folder/build/bin/supple" <<SUPPLE
#!/bin/sh
[ "\$1" = bench ] || exec "$supple" "\$@"
while [ "\$1" != --json ]; do shift; done
echo '{"complete": false, "rows": [1]}' >"\$2"
exit 124
SUPPLE
chmod +x "$folder/programs/timeout" "$folder/build/bin/supple"
code=0
check --steps bench --allow-cpu --timeout 1234 || code=$?
[ $code -eq 1 ] || fail "exit code $code after a timeout"
grep -q "^--kill-after=3 1234 $folder/build/bin/supple bench " "$folder/limits" || fail "gives the benchmark another time"
grep -q 'failed: bench (ended after 1234 s' "$folder/log" || fail "does not say that the step was ended"
expect 'steps["bench"]["timedOut"] and result["profile"] is None'
expect 'result["bench"] == {"complete": False, "rows": [1]}'
# What is benched, within what is left of the whole.
: >"$folder/limits"
check --steps crowd,triangles --allow-cpu --timeout 9000 --budget 3600 || true
expect 'result["bench"] == result["triangles"] == {"complete": False, "rows": [1]}'
expect 'steps["crowd"]["timedOut"] and steps["triangles"]["timedOut"]'
grep " $folder/build/bin/supple bench .*--cages none --crowd 8 " "$folder/limits" | (read -r _ seconds _ && [ "$seconds" -le 3592 ]) ||
    fail "the crowd gets more than what is left"
