#!/usr/bin/env bash
# Runs the Windows build under wine and compares it with the native one: the samples, bakes of six characters with four schemes in
# both mappings, and of compressed files where it has the decoders. Files and hashes must have the same bytes.
#   windows_bakes.sh NATIVE WINDOWS SOURCE WORK
# NATIVE is a supple command; WINDOWS is what mingw_test.sh has left. Wine's Vulkan needs a display: with_display.sh.
set -euo pipefail
native=$1
windows=$2
source=$3
work=$4
fail() { echo "failed: $1"; exit 1; }
skip() { echo "skipped: $1"; exit 77; }

wine=$(command -v wine64 || command -v wine || ls /usr/lib/wine/wine64 2>/dev/null) || skip "wine is not installed (wine64)"
[ -e "$windows/build/bin/supple.exe" ] || skip "there is no supple.exe: tools/windows_libraries.sh was not run"
rm -rf "$work"
mkdir -p "$work"
cd "$work"
# Neither browser nor .NET is asked for. What other tests set is for Linux.
export WINEPREFIX=$work/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=" LC_ALL=C.UTF-8
unset GLIBC_TUNABLES VK_INSTANCE_LAYERS VK_ADD_LAYER_PATH SUPPLE_POISON SUPPLE_VALIDATION
trap '"$wine" wineboot -k >/dev/null 2>&1; rm -rf "$WINEPREFIX"' EXIT
"$wine" wineboot -i >/dev/null 2>&1 || fail "wine cannot make its folder"
echo "${SECONDS}s  wine is ready"

for program in package_{OFF,ON}/consumer_{c,cpp} build/samples/minimal/supple_minimal build/samples/c_host/supple_c_host; do
    "$wine" "$windows/$program.exe" >log 2>&1 || { cat log; fail "$program.exe"; }
done
echo "${SECONDS}s  hosts of the static library and of the DLL, minimal and c_host run"

# compare FILE SCHEME MAPPING: bakes FILE here and under wine.
compare() {
    local arguments=(bake "$1" --scheme "$2" --rate 2 --mapping "$3" --hash -o)
    "$native" "${arguments[@]}" "native 字.glb" >native.txt 2>&1 &
    "$wine" "$windows/build/bin/supple.exe" "${arguments[@]}" "windows 字.glb" >windows.txt 2>&1 || true
    wait $! || true
    grep -q '[0-9a-f]\{16\}' native.txt || { cat native.txt; fail "native: ${arguments[*]}"; }
    cmp native.txt windows.txt || { diff native.txt windows.txt || true; fail "what is printed differs: ${arguments[*]}"; }
    cmp "native 字.glb" "windows 字.glb" || fail "files differ: ${arguments[*]}"
    rm "native 字.glb" "windows 字.glb"
    same=$((same + 1))
}
# copied FILE: a copy whose name no code page of Windows has as a whole.
copied() {
    input="Hélène 字 $(basename "$1")"
    cp "$source/$1" "$input"
}
same=0
for file in samples/assets/{helmet,pip,pip_quads,wren}.glb tests/data/drivers/arm.glb tests/data/jiggle/belly.glb; do
    copied "$file"
    for scheme in pm catmull-clark loop fragments; do
        for mapping in narrow wide; do
            compare "$input" "$scheme" "$mapping"
        done
    done
done
for decoder in MESHOPT DRACO; do
    grep -q "^SUPPLE_WITH_$decoder:BOOL=ON" "$windows/build/CMakeCache.txt" || { echo "left out: files that need $decoder"; continue; }
    copied "tests/fuzz/corpus/gltf/${decoder,,}.glb"
    compare "$input" catmull-clark wide
done
echo "${SECONDS}s  $same bakes have the bytes of the native ones"
echo "passed"
