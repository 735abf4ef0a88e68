#!/bin/sh
# supple view and its window, on a display (with_display.sh).
#   view_test.sh SUPPLE_COMMAND CHARACTER [WINDOW_TEST]
# Exits 77 (skipped) and says why where there is no window to be had.
set -u
supple=$1
character=$2
window_test=${3:-}

if "$supple" view "$character" --frames 1 2>&1 | grep -q "built without"; then
    echo "skipped: supple was built without a window"
    exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "failed: $1"; exit 1; }

validate=--validate
"$supple" view "$character" --frames 1 --size 64x64 --rate 1 --validate >"$work/log" 2>&1 ||
    { grep -q "is not installed" "$work/log" && validate=; }

"$supple" view "$character" "$character" --frames 4 --size 320x240 --rate 3 --view patches --cage \
    --screenshot "$work/view.png" $validate || fail "exit code $?"
[ -s "$work/view.png" ] || fail "no screenshot"
size=$(od -An -tu1 -j16 -N8 "$work/view.png" | tr -s ' ')
[ "$size" = " 0 0 1 64 0 0 0 240" ] || fail "the screenshot is not 320x240:$size"

# One frame's step is fixed, so the same frames are the same picture: of the surface and of the cage, panel and all, whatever
# malloc hands out (repeat_test.cpp).
for scheme in auto cage; do
    for fill in 128 64; do
        MALLOC_PERTURB_=$fill "$supple" view "$character" --frames 3 --size 640x480 --rate 2 --scheme $scheme \
            --screenshot "$work/$fill.png" || fail "exit code $?"
    done
    cmp "$work/128.png" "$work/64.png" || fail "another picture when drawn again, scheme $scheme"
done

"$supple" view "$character" --frames 2 --size 160x120 --rate 3 --scheme fragments --view patches $validate ||
    fail "exit code $?"

# A file that is refused does not keep the others from being shown, but it is said.
echo "no character" >"$work/broken.glb"
for files in "$work/broken.glb $character" "$character $work/broken.glb"; do
    rm -f "$work/view.png"
    "$supple" view $files --frames 2 --size 320x240 --rate 2 --screenshot "$work/view.png" >"$work/log" 2>&1
    [ $? -eq 1 ] || fail "with a refused file the exit code should be 1: $(cat "$work/log")"
    [ -s "$work/view.png" ] || fail "no screenshot beside a refused file"
    [ "$(grep -c "broken.glb" "$work/log")" -eq 1 ] || fail "the refused file is not named once: $(cat "$work/log")"
done
"$supple" view "$work/broken.glb" "$work/none.glb" --frames 1 >"$work/log" 2>&1
[ $? -eq 1 ] || fail "without a file that can be shown the exit code should be 1"
[ "$(grep -c "broken.glb\|none.glb" "$work/log")" -eq 2 ] || fail "not every refused file is named: $(cat "$work/log")"

DISPLAY= "$supple" view "$character" --frames 1 >"$work/log" 2>&1
[ $? -eq 3 ] || fail "without a display the exit code should be 3: $(cat "$work/log")"

if [ -n "$window_test" ]; then
    "$window_test" || fail "window test"
fi
echo "passed"
