#!/usr/bin/env bash
# Runs every command of supple under valgrind: what is read before it is written, or outside its block, is an error.
# Usage: tools/memcheck/memcheck.sh [SUPPLE]   (by default build/release/bin/supple; a debug build names lines)
# A pass takes minutes: valgrind runs the shaders that lavapipe compiles. Not a test for that reason.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
supple=$(realpath "${1:-$here/../../build/release/bin/supple}")
assets=$here/../../samples/assets
command -v valgrind >/dev/null || { echo "valgrind is not installed"; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >box.obj <<'OBJ'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 4/2 3/3 2/4
f 5/1 6/2 7/3 8/4
f 1/1 2/2 6/3 5/4
f 2/1 3/2 7/3 6/4
f 3/1 4/2 8/3 7/4
f 4/1 1/2 5/3 8/4
OBJ

failures=0
check() {
    if valgrind -q --error-exitcode=99 --suppressions="$here/memcheck.supp" --log-file=log "$supple" "$@" >out 2>&1; then
        echo "ok      supple $*"
    else
        echo "FAILED  supple $* (exit code $?)"
        cat log out
        failures=$((failures + 1))
    fi
}

check inspect box.obj --json
check inspect box.obj --compare --rate 2
check convert box.obj -o box.glb
for scheme in catmull-clark pm prep fragments loop blend polygons cage; do
    check bake box.obj -o box_$scheme.obj --scheme $scheme --rate 2
    check render box.obj -o box.png --scheme $scheme --size 64x64 --rate 2
done
check render box.obj -o box.png --view wire --size 64x64 --rate 2
check bake box.obj -o baked.glb --rate 2
check bake "$assets/helmet.glb" -o helmet.ply --rate 2
check bake "$assets/helmet.glb" -o helmet.glb --scheme cage
check bake box.obj -o box.obj.obj --scheme pm --patches patches.json --mapping wide --rate 2
check render box.obj -o curvature.png --scheme all --view mean-curvature --size 64x64 --rate 2
check sheet box.obj -o sheet.png
check profile box.obj --frames 2 --rate 2 --json profile.json
check profile box.obj --frames 2 --view --hashes hashes.txt
check render "$assets/helmet.glb" -o helmet.png --scheme cage --size 64x64
[ $failures = 0 ] || { echo "$failures failed"; exit 1; }
