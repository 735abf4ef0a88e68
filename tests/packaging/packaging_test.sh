#!/usr/bin/env bash
# Installs a build, then builds and runs hosts in C and C++ that get Supple by find_package, pkg-config, add_subdirectory
# and FetchContent, static and shared.
#   packaging_test.sh BUILD SOURCE VERSION WORK [subdirectory]
# With `subdirectory` only what compiles the library anew, with the shaders of BUILD; without it, everything else.
set -euo pipefail
build=$1
source=$2
version=$3
work=$4
part=${5:-install}

consumer=$source/tests/packaging/consumer
fail() { echo "failed: $1"; exit 1; }
say() { printf '%4ss  %s\n' "$SECONDS" "$1"; }
# Headers precompiled, or objects kept from the last time: ccache does not take both.
launcher=(-DCMAKE_PROJECT_supple_INCLUDE="$source/tests/packaging/precompiled.cmake")
if command -v ccache >/dev/null && [ -z "${SUPPLE_NO_CCACHE:-}" ]; then
    launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    # Absolute paths below these do not keep ccache from a hit.
    export CCACHE_BASEDIR=$source CCACHE_NOHASHDIR=1
fi
# quietly COMMAND...: says what it said only when it fails.
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; fail "$*"; }; }
mkdir -p "$work"

if [ "$part" = subdirectory ]; then
    # A host with flags of its own; one build folder for both kinds, of which only the ABI's file differs.
    for shared in OFF ON; do
        quietly cmake -S "$consumer" -B "$work/subdirectory" -G Ninja "${launcher[@]}" -DHOW=subdirectory \
            -DSOURCE="$source" -DSUPPLE_UNITY_BUILD=ON -DSUPPLE_UNITY_BATCH=30 \
            -DSUPPLE_COMPILED_SHADERS="$build/generated" "-DLANGUAGES=C;CXX" "-DCMAKE_CXX_FLAGS=-O0 -fno-exceptions -fno-rtti -ffast-math" \
            -DSUPPLE_BUILD_SHARED=$shared
        quietly cmake --build "$work/subdirectory" --target consumer_c consumer_cpp
        "$work/subdirectory/consumer_c"
        "$work/subdirectory/consumer_cpp"
        say "add_subdirectory, shared $shared"
    done
    quietly cmake --install "$work/subdirectory" --prefix "$work/nothing"
    [ ! -e "$work/nothing" ] || fail "Supple installs itself with a host's project"
    [[ $(ctest --test-dir "$work/subdirectory" -N 2>&1) =~ "Total Tests: 0" ]] || fail "Supple's tests are in a host's project"

    # Else Ninja compiles every library below the kernel's first.
    quietly cmake -S "$consumer" -B "$work/fetch" -G Ninja -DHOW=fetch -DFETCHCONTENT_SOURCE_DIR_SUPPLE="$source" \
        "-DLANGUAGES=C;CXX" -DBUILD_SHARED_LIBS=ON -DCMAKE_OPTIMIZE_DEPENDENCIES=ON
    grep -q "^SUPPLE_BUILD_SHARED:BOOL=ON" "$work/fetch/CMakeCache.txt" || fail "BUILD_SHARED_LIBS is not followed"
    # The kernels of the other two are those of the build proper, which takes a minute less.
    targets=$(ninja -C "$work/fetch" -t targets all)
    kernel=$(grep -m1 -o '^[^:]*deform_gather_comp_NARROW\.h' <<<"$targets") || fail "no kernel to compile"
    quietly cmake --build "$work/fetch" --target "$kernel"
    cmp "$work/fetch/$kernel" "$build/generated/shaders/deform_gather_comp_NARROW.h" || fail "another kernel"
    say "FetchContent, configured, a kernel compiled"
    exit 0
fi

# ---- install, and move it: nothing in it may know where it was made

rm -rf "${work:?}"/*
components=(runtime)
quietly cmake --install "$build" --prefix "$work/first" --component runtime
quietly cmake --install "$build" --prefix "$work/first" --component development
if [ -x "$build/bin/supple" ]; then
    quietly cmake --install "$build" --prefix "$work/first" --component tools
    components+=(tools)
fi
prefix=$work/moved
mv "$work/first" "$prefix"
! grep -rlF -e "$build" -e "$source" "$prefix" --include=*.cmake --include=*.pc --include=*.h* ||
    fail "installed files name the build's folders"
library=$(echo "$prefix"/lib*/libsupple.so)
[ -e "$library" ] || library=$(find "$prefix" -name libsupple.so)
lib=$(dirname "$library")
[ -e "$lib/libsupple.a" ] || fail "no static library"
strangers=$(nm -D --defined-only "$library" | awk '$3 !~ /^supple[A-Z]/ {print $3}')
[ -z "$strangers" ] || fail "the shared library shows $strangers"
[[ $(readelf -d "$library") =~ SONAME.*libsupple\.so\.[0-9]+\] ]] || fail "SONAME"
"$source/tests/packaging/cited_files.py" "$prefix" "$source" || fail "files that are cited are not there"
say "installed"

# ---- find_package

for shared in ON OFF; do
    for languages in C "C;CXX"; do
        at=$work/package-$shared-${languages/;/}
        quietly cmake -S "$consumer" -B "$at" -G Ninja -DHOW=package "-DLANGUAGES=$languages" -DCMAKE_PREFIX_PATH="$prefix" \
            -DVERSION="$version" "-DCOMPONENTS=$(IFS=';'; echo "${components[*]}")" -DBUILD_SHARED_LIBS=$shared
        quietly cmake --build "$at"
        for program in "$at"/consumer_c "$at"/consumer_cpp; do
            [ -e "$program" ] || continue
            "$program"
            needs=$(readelf -d "$program" | grep -c 'NEEDED.*libsupple' || true)
            [ "$needs" = "$([ $shared = ON ] && echo 1 || echo 0)" ] || fail "$program: shared is $shared"
        done
        say "find_package, shared $shared, $languages"
    done
done
if [ -e "$at/command.txt" ]; then
    [ "$("$(cat "$at/command.txt")" --version)" = "$version" ] || fail "the installed command's version"
fi

# ---- pkg-config

if command -v pkg-config >/dev/null; then
    c=(cc -std=c99 -pedantic -Wall -Wextra -Werror "$consumer/main.c")
    cpp=(c++ -std=c++17 -pedantic -Wall -Wextra -Werror -fno-exceptions -fno-rtti "$consumer/main.cpp")
    export PKG_CONFIG_PATH=$lib/pkgconfig
    [ "$(pkg-config --modversion supple)" = "$version" ] || fail "pkg-config's version"
    [ -e "$(pkg-config --variable=shaderdir supple)/trim.glsl" ] || fail "pkg-config's shaderdir"
    read -ra flags <<<"$(pkg-config --cflags --libs supple)"
    quietly "${c[@]}" -o "$work/pkg_c" "${flags[@]}"
    quietly "${cpp[@]}" -o "$work/pkg_cpp" "${flags[@]}"
    LD_LIBRARY_PATH=$lib "$work/pkg_c"
    LD_LIBRARY_PATH=$lib "$work/pkg_cpp"
    say "pkg-config"
    # --static says what the archive needs; the linker takes the archive where there is no shared library.
    rm "$lib"/libsupple.so*
    read -ra flags <<<"$(pkg-config --static --cflags --libs supple)"
    quietly "${c[@]}" -o "$work/pkg_static_c" "${flags[@]}"
    quietly "${cpp[@]}" -o "$work/pkg_static_cpp" "${flags[@]}"
    "$work/pkg_static_c"
    "$work/pkg_static_cpp"
    say "pkg-config --static"
else
    echo "pkg-config is not installed: its file was left untested"
fi
echo "passed"
