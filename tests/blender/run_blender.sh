#!/bin/sh
# Runs a test inside Blender, without a window: run_blender.sh SCRIPT ARGUMENTS... Exits 77 (skipped) where Blender is not
# installed. The add-on is packed as users get it, and is installed into a folder of its own.
set -u
here=$(cd "$(dirname "$0")" && pwd)
if ! command -v blender >/dev/null 2>&1; then
    echo "skipped: 1 test of the add-on left out: blender is not installed"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/scripts" "$work/config"
python3 "$here/../../tools/blender/pack.py" "$work/supple.zip" || exit 1
script=$1
shift
SUPPLE_ADDON_ZIP=$work/supple.zip BLENDER_USER_SCRIPTS=$work/scripts BLENDER_USER_CONFIG=$work/config PYTHONPATH=$here \
    PYTHONDONTWRITEBYTECODE=1 blender --background --factory-startup --python-use-system-env --python-exit-code 1 \
    --python "$here/$script" -- "$@" >"$work/log" 2>&1
status=$?
grep -vE '\| (INFO|WARNING): |^Blender |^Info: |^$|^Modules Installed|^Data are loaded|import finished|^addon_utils.disable|Draco mesh compression is not available' "$work/log"
exit $status
