#!/usr/bin/env bash
# Cross-compiles the library for Windows, static and DLL, and links hosts in C and C++ with either, which find the package. The
# supple command and the samples minimal and c_host come along where tools/windows_libraries.sh has built what they link, and so do
# decoders and the window. windows_bakes.sh runs all but the window.
#   mingw_test.sh BUILD SOURCE WORK
# Its shaders are those of BUILD.
set -euo pipefail
build=$1
source=$2
work=$3
if ! command -v x86_64-w64-mingw32-g++-posix >/dev/null; then
    echo "skipped: g++-mingw-w64-x86-64-posix is not installed"
    exit 77
fi
fail() { echo "failed: $1"; exit 1; }
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; fail "$*"; }; }
mkdir -p "$work"
# Headers precompiled, or objects kept from the last time: ccache does not take both.
launcher=(-DCMAKE_PROJECT_supple_INCLUDE="$source/tests/packaging/precompiled.cmake")
if command -v ccache >/dev/null && [ -z "${SUPPLE_NO_CCACHE:-}" ]; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    export CCACHE_BASEDIR=$source CCACHE_NOHASHDIR=1
fi

tools=OFF
targets=(supple supple_other)
libraries=${SUPPLE_WINDOWS_LIBRARIES:-$source/build/windows-libraries}
if [ -e "$libraries/built/jpeg" ]; then
    tools=ON
    targets+=(supple_command supple_minimal supple_c_host)
else
    echo "the command is left out: tools/windows_libraries.sh was not run"
fi
# whether LIBRARY: whether windows_libraries.sh has built it.
whether() { if [ -e "$libraries/built/$1" ]; then echo ON; else echo OFF; fi; }
# Without any optimization the objects are seven times as large, and linking COFF takes minutes.
quietly cmake -S "$source" -B "$work/build" -G Ninja --toolchain "$source/cmake/mingw-w64.cmake" "${launcher[@]}" \
    -DSUPPLE_WITH_MESHOPT="$(whether meshopt)" -DSUPPLE_WITH_DRACO="$(whether draco)" \
    -DSUPPLE_BUILD_BOTH=ON -DSUPPLE_BUILD_TOOLS=$tools -DSUPPLE_BUILD_TESTS=OFF \
    -DSUPPLE_WINDOWS_LIBRARIES="$libraries" -DCMAKE_EXE_LINKER_FLAGS=-static -DCMAKE_SHARED_LINKER_FLAGS=-static \
    -DSUPPLE_COMPILED_SHADERS="$build/generated" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
    -DSUPPLE_UNITY_BATCH=30
quietly cmake --build "$work/build" --target "${targets[@]}"
rm -rf "$work/prefix"
for component in runtime development; do
    quietly cmake --install "$work/build" --prefix "$work/prefix" --component $component
done
prefix=$work/prefix
exports=$(x86_64-w64-mingw32-objdump -p "$prefix/bin/libsupple.dll" |
    sed -n '/\[Ordinal\/Name Pointer\] Table/,/^$/p' | awk '/\[ *[0-9]+\]/ {print $NF}')
strangers=$(grep -v '^supple[A-Z]' <<<"$exports" || true)
[ -z "$strangers" ] || fail "the DLL exports $strangers"
[[ $exports == *suppleCreateContext* ]] || fail "the DLL exports nothing"
echo "${SECONDS}s  built, exports are supple's alone"

for shared in OFF ON; do
    at=$work/package_$shared
    rm -rf "$at"
    quietly cmake -S "$source/tests/packaging/consumer" -B "$at" -G Ninja --toolchain "$source/cmake/mingw-w64.cmake" \
        -DHOW=package "-DLANGUAGES=C;CXX" -DCMAKE_PREFIX_PATH="$prefix" -Dsupple_SHARED=$shared \
        -DSUPPLE_WINDOWS_LIBRARIES="$libraries" -DCMAKE_EXE_LINKER_FLAGS=-static
    quietly cmake --build "$at"
done
cp "$prefix/bin/libsupple.dll" "$work/package_ON"
echo "${SECONDS}s  hosts found the package and were linked, DLL and static"
echo "passed"
