#!/bin/sh
# supple view and its window on a display of their own.
#   view_test.sh SUPPLE_COMMAND CHARACTER [WINDOW_TEST]
# Exits 77 (skipped) and says why where there is no Xvfb.
set -u
supple=$1
character=$2
window_test=${3:-}

if ! command -v Xvfb >/dev/null 2>&1; then
    echo "skipped: Xvfb is not installed"
    exit 77
fi
if "$supple" view "$character" --frames 1 2>&1 | grep -q "built without"; then
    echo "skipped: supple was built without a window"
    exit 77
fi

work=$(mktemp -d)
# Xvfb picks a free display and writes its number when it is ready.
mkfifo "$work/display"
Xvfb -displayfd 3 -screen 0 1024x768x24 -nolisten tcp 3>"$work/display" >"$work/xvfb.log" 2>&1 &
xvfb=$!
trap 'kill $xvfb 2>/dev/null; wait $xvfb 2>/dev/null; rm -rf "$work"' EXIT
read -r number <"$work/display" || { echo "Xvfb did not start:"; cat "$work/xvfb.log"; exit 1; }
DISPLAY=:$number
export DISPLAY
unset WAYLAND_DISPLAY
XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-$work}
export XDG_RUNTIME_DIR

fail() { echo "failed: $1"; exit 1; }

validate=--validate
"$supple" view "$character" --frames 1 --size 64x64 --rate 1 --validate >"$work/log" 2>&1 ||
    { grep -q "is not installed" "$work/log" && validate=; }

"$supple" view "$character" "$character" --frames 4 --size 320x240 --rate 3 --view patches --cage \
    --screenshot "$work/view.png" $validate || fail "exit code $?"
[ -s "$work/view.png" ] || fail "no screenshot"
size=$(od -An -tu1 -j16 -N8 "$work/view.png" | tr -s ' ')
[ "$size" = " 0 0 1 64 0 0 0 240" ] || fail "the screenshot is not 320x240:$size"

# One frame's step is fixed, so the same frames are the same picture.
"$supple" view "$character" --frames 3 --size 160x120 --rate 2 --scheme cage --screenshot "$work/a.png" ||
    fail "exit code $?"
[ -s "$work/a.png" ] || fail "no picture of the cage"

"$supple" view "$character" --frames 2 --size 160x120 --rate 3 --scheme catmull-clark --view patches $validate ||
    fail "exit code $?"

DISPLAY= "$supple" view "$character" --frames 1 >"$work/log" 2>&1
[ $? -eq 3 ] || fail "without a display the exit code should be 3: $(cat "$work/log")"

if [ -n "$window_test" ]; then
    "$window_test" || fail "window test"
fi
echo "passed"
