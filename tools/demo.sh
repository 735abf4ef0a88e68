#!/usr/bin/env bash
# From a fresh clone to a picture: installs what is missing, builds the supple command, sends the demo character through
# the pipeline, writes out/demo.png and, where there is a display, opens the viewer.
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

shopt -s nullglob
characters=(samples/assets/*.glb)
if [ ${#characters[@]} -eq 0 ]; then
    echo "samples/assets holds no character" >&2
    exit 1
fi

step 3 "The demo character through the pipeline"
"$supple" inspect "${characters[0]}"
echo
"$supple" profile "${characters[0]}" --rate 8 --frames 60

step 4 "Pictures"
mkdir -p out
"$supple" sheet "${characters[0]}" -o out/demo.png
echo "Wrote $PWD/out/demo.png after ${SECONDS}s"

if [ "$view" = yes ] && [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "Opening the viewer; close its window to end."
    exec "$supple" view "${characters[@]}"
fi
