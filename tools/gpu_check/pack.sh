#!/usr/bin/env bash
# Collects what gpu_check.sh --prebuilt needs: pack.sh FOLDER BUILD_DIR LAB_SOURCES BUILD_FIRST. FOLDER gets the scripts and one
# pack.tar.gz. In that lie tree/ (programs without symbols, libraries other than the C library's, assets, shaders, data of tests) and
# shared/ (assets, where they lie beside the sources): paths in tests lead from the sources to their neighbor.
set -euo pipefail
folder=$1 build=$2 lab_sources=$3 build_first=$4
scripts=$(cd "$(dirname "$0")" && pwd)
cd "$scripts/../.."
if [ "$build_first" = yes ]; then
    cmake --preset release -B "$build" -DSUPPLE_BUILD_TESTS=ON
    cmake --build "$build" -j "$(nproc)" --target supple_command supple_runtime_tests
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/tree
programs=(bin/supple tests/runtime/supple_runtime_tests)
if [ -d "$lab_sources" ]; then
    "$scripts/build_lab.sh" "$lab_sources" "$build/gpu_lab" >/dev/null
    programs+=(gpu_lab/gpu_lab)
else
    echo "There is no lab in $lab_sources: the check will leave it out."
fi

# Where a machine lacks them. NVIDIA's driver needs libXext, which no program of ours does.
libraries_of() { (ldd "$1" 2>/dev/null || true) | sed -n 's/^\t\([^ ]*\) => \(\/[^ ]*\) .*/\1 \2/p' | sort -u; }
mkdir -p "$tree/lib"
for program in "${programs[@]}"; do
    mkdir -p "$tree/$(dirname "$program")"
    strip -o "$tree/$program" "$build/$program" 2>/dev/null || cp "$build/$program" "$tree/$program"
    libraries_of "$build/$program"
done >"$work/libraries"

# Tests have paths compiled in: of the sources and of compilers of shaders. links.txt says what has to be found there.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt" 2>/dev/null || true; }
home=$(cached CMAKE_HOME_DIRECTORY)
echo "${home:-$PWD} ." >"$tree/links.txt"
for compiler in "$(cached SUPPLE_GLSLANG)" "$(cached SUPPLE_SPIRV_OPT)"; do
    if [ -x "$compiler" ]; then
        cp -L "$compiler" "$tree/bin/"
        libraries_of "$compiler" >>"$work/libraries"
        echo "$compiler bin/$(basename "$compiler")" >>"$tree/links.txt"
    fi
done

(PATH=$PATH:/sbin:/usr/sbin ldconfig -p 2>/dev/null || true) | sed -n 's/.*\(libXext\.so\.6\) .*x86-64.* => /\1 /p' >"$work/xext"
while read -r name path; do
    echo "$name $path"
    libraries_of "$path"
done <"$work/xext" >>"$work/libraries"
while read -r name path; do
    case "$name" in
        libc.so.* | libm.so.* | libdl.so.* | libpthread.so.* | librt.so.* | libresolv.so.* | ld-linux*) ;;
        *) cp -L "$path" "$tree/lib/$name" ;;
    esac
done <"$work/libraries"

mkdir -p "$tree/samples" "$tree/tests/data"
cp -r samples/assets "$tree/samples/"
cp -r shaders "$tree/"
for data in tests/data/*; do
    [ "$data" = tests/data/pictures ] || cp -r "$data" "$tree/tests/data/"
done
if [ -d ../shared/assets ]; then
    mkdir -p "$work/shared/assets"
    for assets in ../shared/assets/{characters,khronos,meshes}; do
        cp -r "$assets" "$work/shared/assets/"
    done
    rm -rf "$work/shared/assets/characters/reference"
else
    echo "There are no assets in ../shared: tests will leave out their cases."
fi
git describe --always --dirty >"$tree/version.txt" 2>/dev/null || echo unknown >"$tree/version.txt"

mkdir -p "$folder/tools"
rm -rf "$folder/tools/gpu_check"
cp -r tools/gpu_check tools/gpu_check.sh "$folder/tools/"
rm "$work"/{libraries,xext}
tar --owner=0 --group=0 --use-compress-program="gzip -1" -cf "$folder/pack.tar.gz" -C "$work" .
echo "$folder: $(du -sh "$folder" | cut -f 1). On the other machine: $(basename "$folder")/tools/gpu_check.sh --prebuilt $(basename "$folder")"
