#!/bin/sh
# What files_test.sh and the test of surfaces have left in OUT, in other programs: opened_test.sh PROGRAM OUT.. PROGRAM is
# validator, three or blender. Exits 77 (skipped) where there is no such program, or no Blender has written files.
set -u
here=$(cd "$(dirname "$0")" && pwd)
program=$1
shift
if ! ls "$1"/*.glb >/dev/null 2>&1; then
    echo "skipped: there are no files of Blender's"
    exit 77
fi
set -- $(for folder in "$@"; do ls "$folder"/*.glb; done)
case $program in
validator)
    command -v node >/dev/null && [ -n "${SUPPLE_GLTF_VALIDATOR:-}" ] ||
        { echo "skipped: $# files left out: SUPPLE_GLTF_VALIDATOR does not name gltf-validator, or there is no node"; exit 77; }
    exec node "$here/../tools/validate_gltf.mjs" "$SUPPLE_GLTF_VALIDATOR" "$@"
    ;;
three)
    command -v node >/dev/null && [ -n "${SUPPLE_THREE:-}" ] ||
        { echo "skipped: $# files left out: SUPPLE_THREE does not name the npm package three, or there is no node"; exit 77; }
    exec node "$here/three_viewer.mjs" "$SUPPLE_THREE" "$@"
    ;;
blender)
    exec sh "$here/run_blender.sh" without_addon.py "$@"
    ;;
esac
echo "opened_test.sh: unknown program $program"
exit 2
