#!/bin/sh
# supple view as a hand drives it: keys and clicks by xdotool, on a display (with_display.sh).
#   view_driven_test.sh SUPPLE_COMMAND CHARACTER
# Exits 77 (skipped) and says why where that cannot be. SUPPLE_KEEP_PICTURES=FOLDER keeps the pictures of the window.
set -u
supple=$1
character=$2
if ! command -v xdotool >/dev/null 2>&1; then
    echo "skipped: xdotool is not installed"
    exit 77
fi
work=$(mktemp -d)
viewer=
trap '[ -z "$viewer" ] || kill $viewer 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
XDG_STATE_HOME=$work/state
export XDG_STATE_HOME
mkdir characters
cp "$character" characters/pip.glb
echo "no character" >characters/broken.glb

fail() { echo "failed: $1"; tail -n 20 "$work/log"; exit 1; }
# Waits until a condition holds: frames of a loaded machine take their time.
until_true() {
    tries=0
    until eval "$2"; do
        tries=$((tries + 1))
        [ $tries -lt 600 ] || fail "$1"
        kill -0 $viewer 2>/dev/null || fail "$1: the viewer has ended"
        sleep 0.1
    done
}
count() { grep -c -- "$1" "$work/log"; }
said() { until_true "it should say: $1" "[ \$(count '$1') -ge ${2:-1} ]"; }
key() { xdotool key "$1"; }
click() {
    xdotool mousemove "$1" "$2"
    sleep 0.3
    xdotool mousedown 1
    sleep 0.3
    xdotool mouseup 1
}
# A picture of the window, panel and all, kept under a name.
shoot() {
    shots=$(count "wrote window")
    key F12
    said "wrote window" $((shots + 1))
    mv window.png "$1.png"
    [ -z "${SUPPLE_KEEP_PICTURES:-}" ] || cp "$1.png" "$SUPPLE_KEEP_PICTURES/"
}
# The command line of what is shown, as the key K prints it.
shown() {
    lines=$(count "^supple render")
    key k
    said "^supple render" $((lines + 1))
    grep "^supple render" "$work/log" | tail -n 1
}

validate=--validate
"$supple" view "$character" --frames 1 --size 64x64 --rate 1 --validate >"$work/log" 2>&1 ||
    { grep -q "is not installed" "$work/log" && validate=; }
if grep -q "built without" "$work/log"; then
    echo "skipped: supple was built without a window"
    exit 77
fi

# Without a file: the browser is open, in the folder that the viewer runs in.
cd characters || exit 1
"$supple" view --size 900x600 --rate 2 $validate >"$work/log" 2>&1 &
viewer=$!
until_true "a window" "xdotool search --name '^supple\$' >/dev/null 2>&1"
xdotool windowfocus --sync "$(xdotool search --name '^supple$' | head -n 1)"
shoot empty

# A file that fails says why and leaves the empty studio; the next one opens, and is remembered.
click 450 108
said "broken.glb"
shoot refused
cmp -s empty.png refused.png && fail "the window does not show why a file is refused"
click 450 128
until_true "the file is remembered" "grep -q characters/pip.glb '$work/state/supple/recent' 2>/dev/null"
shoot opened

# It plays; Space stops it, then the picture refines and stays.
key space
until_true "Space stops the clip" 'first=$(shown); [ "$(shown)" = "$first" ]'
shoot paused

# Dragging turns the camera, the wheel brings it closer, F frames the figure as at first.
xdotool mousemove 600 300
shown >/dev/null
xdotool mousedown 1
until_true "dragging turns" 'xdotool mousemove_relative -- 5 0; turned=$(shown); [ "$turned" != "$first" ]'
xdotool mouseup 1
until_true "the wheel brings it closer" 'xdotool click 4; closer=$(shown); [ "$closer" != "$turned" ]'
key f
until_true "F frames the figure" '[ "$(shown)" = "$first" ]'

# Every view has its turn, and comes back to the first.
for view in wire patches normals zebra highlights isophotes tangents uv uv1 vertex-color base-color metallic roughness \
    normal-map occlusion emissive weights distance levels; do
    key v
    until_true "V shows $view" "shown | grep -Eq -- '--view $view( |\$)'"
    [ "$view" != distance ] || sleep 4 # it is measured beside
    case $view in uv | weights | distance) key j; shoot "$view"; key j ;; esac
done
cmp -s uv.png weights.png && fail "views look alike"
cmp -s weights.png distance.png && fail "distances look like weights"

# Levels follow the camera until Z freezes them; then another camera sees what they were. D has them in every view.
shoot levels
key z
xdotool mousemove 600 300
until_true "the wheel brings it closer" 'xdotool click 4; closer=$(shown); [ "$closer" != "$first" ]'
shown >/dev/null
shoot levels_frozen
key z
shown >/dev/null
shoot levels_near
cmp -s levels_frozen.png levels_near.png && fail "Z freezes nothing"
key f
for view in mean-curvature gaussian-curvature; do
    key v
    until_true "V shows $view" "shown | grep -Eq -- '--view $view( |\$)'"
    sleep 4 # it is measured beside
done
key v
until_true "V comes back" '[ "$(shown)" = "$first" ]'
key d
until_true "D asks for levels" "shown | grep -q -- '--levels'"
key d

# S puts the cage beside the surface, both in sight.
key s
until_true "S splits the window" "shown | grep -q -- '--split'"
shoot split
key s
key f
until_true "S takes the cage away" '[ "$(shown)" = "$first" ]'

# What E writes is what the copied command line makes.
key e
said "wrote pip.png"
line=$(shown)
# shellcheck disable=SC2086
(eval "\"$supple\" ${line#supple }") >>"$work/log" 2>&1 || fail "the copied line fails: $line"
cmp pip.png pip_2.png || fail "the copied line makes another picture: $line"

# The keys are shown, and Esc ends it. What failed was no file of the command line.
key F1
shown >/dev/null # a window of a size of its own is there a frame later
shoot keys
key Escape
wait $viewer
code=$?
viewer=
[ $code -eq 0 ] || fail "the exit code is $code"
echo "passed"
