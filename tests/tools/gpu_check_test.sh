#!/usr/bin/env bash
# tools/gpu_check.sh on whatever device there is, without building: gpu_check_test.sh SOURCES SUPPLE. ctest runs two made-up
# tests, one of which fails; nvidia-smi is made up as well.
set -euo pipefail
sources=$1 supple=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder"/build/bin "$folder"/programs
ln -s "$supple" "$folder/build/bin/supple"
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
check() { "$sources/tools/gpu_check.sh" --build-dir "$folder/build" --out "$folder/out" --quick "$@" >"$folder/log" 2>&1; }
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
check --steps tests,bench,profile --allow-cpu || code=$?
[ $code -eq 1 ] || fail "exit code $code with a test that fails"
grep -q 'failed: tests (exit code 8' "$folder/log" || fail "does not name the step"
expect 'list(steps) == ["device", "tests", "bench", "profile", "view"]'
expect 'all(step["exitCode"] == (8 if step["step"] == "tests" else 0) and not step["timedOut"] for step in result["steps"])'
expect 'result["tests"] == {"passed": 1, "failed": 1, "skipped": 0, "failedNames": ["bad"], "skippedNames": []}'
expect 'result["machine"]["device"] == result["bench"]["machine"]["device"] != ""'
expect '"Made Up, 1.2" in result["system"]'
expect 'result["clocks"]["clocks.current.sm [MHz]"] == {"least": 1000, "median": 1500, "largest": 1980}'
expect 'result["clocks"]["power.draw [W]"]["largest"] == 70.5 and "timestamp" not in result["clocks"]'
expect 'result["bench"]["complete"] and len(result["bench"]["rows"]) == 1'
expect 'all(row["frameMs"] > 0 for row in result["crowd"]["rows"]) and len(result["crowd"]["rows"]) == 2'
expect 'len(result["profile"]["runs"]) == 2 and len(result["view"]["runs"]) == 1'

# A step that takes too long is ended; what was measured before is kept. No clock decides here: timeout(1) is made up and
# writes down what it was told; so is a benchmark that leaves half a result and the exit code of a program that was ended.
cat >"$folder/programs/timeout" <<TIMEOUT
#!/bin/sh
echo "\$@" >>"$folder/limits"
shift 2 # --kill-after and the limit
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
grep -q "^--kill-after=10 1234 $folder/build/bin/supple bench " "$folder/limits" || fail "gives the benchmark another time"
grep -q 'failed: bench (ended after 1234 s' "$folder/log" || fail "does not say that the step was ended"
expect 'steps["bench"]["timedOut"] and result["profile"] is None'
expect 'result["bench"] == {"complete": False, "rows": [1]}'
