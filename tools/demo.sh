#!/usr/bin/env bash
# From a fresh clone to a picture: installs what is missing, builds the supple command, sends Pip, the demo character,
# walking through the pipeline, writes out/demo.png and, where there is a display, opens the viewer.
# Usage: tools/demo.sh [--no-view]
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

view=yes
case "${1:-}" in
    "") ;;
    --no-view) view=no ;;
    *) echo "usage: tools/demo.sh [--no-view]" >&2; exit 2 ;;
esac

step() { printf '\n[%s/4] %s (%ss)\n' "$1" "$2" "$SECONDS"; }

step 1 "Packages"
install_missing "${supple_packages[@]}"

step 2 "Building the supple command"
# A build folder that is there already keeps its settings.
[ -f build/release/CMakeCache.txt ] || cmake --preset release -DSUPPLE_BUILD_TESTS=OFF
cmake --build --preset release --target supple_command -j "$(nproc)"
supple=build/release/bin/supple

pip=samples/assets/pip.glb
step 3 "The demo character through the pipeline"
"$supple" inspect "$pip"
echo
"$supple" profile "$pip" --clip walk --rate 8 --frames 60

step 4 "The picture"
mkdir -p out
# docs/images/demo.png is this picture.
"$supple" sheet "$pip" --clip walk --columns 2 --cell 400x440 --yaw 50 --pitch 8 --no-labels -o out/demo.png
echo "Wrote $PWD/out/demo.png after ${SECONDS}s"

if [ "$view" = yes ] && [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "Opening the viewer; close its window to end."
    exec "$supple" view "$pip" samples/assets/wren.glb samples/assets/pip_quads.glb samples/assets/helmet.glb --clip walk
fi
