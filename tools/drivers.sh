#!/usr/bin/env bash
# Whether other Vulkan drivers compute what the system's one computes: positions of bakes, and the hashes of recorded scenes, in both
# mappings. Normals may differ in their last bits: how far is printed.
# Usage: tools/drivers.sh [--build-dir FOLDER] [--files FILE,..] [--jobs N] [DRIVER..]
#   DRIVER        a driver's manifest (.json), or a folder with an unpacked mesa-vulkan-drivers, as `dpkg-deb -x` leaves it.
#                 The lavapipe that tools/lavapipe.sh has fetched and Chromium's SwiftShader are tried as well where they are
#   --build-dir   build/release, with the command and the tests
#   --files       characters that are baked, with every scheme: samples/assets/helmet.glb, samples/assets/pip.glb
#   --jobs        bakes at a time: 2
# Exit code: 0 all is the same, 1 something differs, 2 bad usage, 77 there is no driver to compare with.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release files=samples/assets/helmet.glb,samples/assets/pip.glb jobs=2 drivers=()
usage() { sed -n '4,10p' tools/drivers.sh | sed 's/^# //' >&2; exit 2; }
while [ $# -gt 0 ]; do
    case "$1" in
        --build-dir) build=${2:?}; shift ;;
        --files) files=${2:?}; shift ;;
        --jobs) jobs=${2:?}; shift ;;
        -*) usage ;;
        *) [ -e "$1" ] || usage; drivers+=("$(realpath "$1")") ;;
    esac
    shift
done
supple=$(realpath "$build/bin/supple")
scenes=$(realpath "$build/tests/runtime/supple_runtime_tests")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# manifest NAME LIBRARY: one of our own, since a browser's says less than the driver can, and an unpacked one names another place.
manifest() {
    printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$2" >"$work/$1.json"
    echo "$work/$1.json"
}
manifests=()
for driver in "${drivers[@]}"; do
    if [ -d "$driver" ]; then
        library=$(find "$driver" -name libvulkan_lvp.so -print -quit)
        [ -n "$library" ] || { echo "$driver: no libvulkan_lvp.so" >&2; exit 2; }
        driver=$(manifest "lavapipe-${#manifests[@]}" "$library")
    fi
    manifests+=("$driver")
done
[ ! -e build/lavapipe/lavapipe.json ] || manifests+=("$PWD/build/lavapipe/lavapipe.json")
for library in /usr/lib/chromium/libvk_swiftshader.so /usr/lib/chromium-browser/libvk_swiftshader.so; do
    [ ! -e "$library" ] || manifests+=("$(manifest swiftshader "$library")")
done
if [ ${#manifests[@]} -eq 0 ]; then
    echo "left out: there is no other driver; run tools/lavapipe.sh, install chromium, or name one"
    exit 77
fi

# on MANIFEST NAME: a command that is supple on that driver alone; without a manifest on the system's.
on() {
    printf '#!/bin/bash\n%s\nexec %s "$@"\n' "${1:+export VK_DRIVER_FILES=${1@Q}}" "${supple@Q}" >"$work/$2"
    chmod +x "$work/$2"
}
# name_of COMMAND: what the driver calls itself.
name_of() {
    "$work/$1" profile samples/assets/helmet.glb --scheme cage --instances 1 --frames 1 --json "$work/$1.profile" >/dev/null 2>&1 || true
    python3 -c 'import json, sys; m = json.load(open(sys.argv[1]))["machine"]; print(m["device"], m["driverInfo"], sep=", ")' \
        "$work/$1.profile" 2>/dev/null || echo "a driver that takes nothing"
}
IFS=, read -ra characters <<<"$files"
on '' system
echo "compared with $(name_of system)"
failed=0
for manifest in "${manifests[@]}"; do
    on "$manifest" other
    echo "== $(name_of other), $manifest"
    python3 -B tools/same_bits.py "$work/system" "$work/other" "${characters[@]}" --positions --jobs "$jobs" --keep "$work/kept" || failed=1
    if VK_DRIVER_FILES=$manifest "$scenes" --gtest_filter='*RecordedScenes.*' --gtest_brief=1 >"$work/scenes" 2>&1; then
        echo "recorded scenes: the pinned hashes; $(grep -c 'narrow mapping left out' "$work/scenes" || true) without the narrow mapping"
    else
        failed=1
        echo "recorded scenes: DIFFERENT"
        tail -n 20 "$work/scenes"
    fi
done
exit $failed
