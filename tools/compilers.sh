#!/usr/bin/env bash
# Whether other compilers and processors build Supple, pass the tests that need no device, and compute the words that the system's
# g++ computes: cooked files, grids and jets of the sample characters with every scheme (tests/cpu/words.cpp).
# Usage: tools/compilers.sh [--build-dir FOLDER] [--work FOLDER] [--jobs N] [--words] [NAME..]
#   NAME          gcc-O0       without optimization, but for the loops over lanes
#                 gcc-native   -O3 -march=native, with optimization at link time
#                 clang        everything: library, host, tools, samples and tests
#                 libcxx       clang with libc++: the library without Draco, whose package here speaks libstdc++, and no tests
#                 aarch64      cross-compiled, run by qemu-user
#                 i386         cross-compiled, with SSE2: pointers of 32 bits
#                 msvc-rules   which sources clang refuses by those of MSVC's rules that it knows; nothing is built
#                 without names: all of them
#   --build-dir   build/release: whose words are compared with, and whose shaders are taken
#   --work        build/compilers, with a folder for each name
#   --jobs        2
#   --words       builds the library and compares words; leaves out the tests, and of clang everything else
# Exit code: 0 all is well, 1 something failed, 2 bad usage.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh
build=build/release work=build/compilers jobs=2 words_alone=0 names=()
all=(gcc-O0 gcc-native clang libcxx aarch64 i386 msvc-rules)
usage() { sed -n '4,17p' tools/compilers.sh | sed 's/^# //' >&2; exit 2; }
while [ $# -gt 0 ]; do
    case "$1" in
        --build-dir) build=${2:?}; shift ;;
        --work) work=${2:?}; shift ;;
        --jobs) jobs=${2:?}; shift ;;
        --words) words_alone=1 ;;
        -*) usage ;;
        *) [[ " ${all[*]} " == *" $1 "* ]] || usage; names+=("$1") ;;
    esac
    shift
done
[ ${#names[@]} -gt 0 ] || names=("${all[@]}")
install_missing "${supple_compiler_packages[@]}"
mkdir -p "$work"
work=$(realpath "$work")
build=$(realpath "$build")
files=(samples/assets/helmet.glb samples/assets/pip.glb samples/assets/pip_quads.glb samples/assets/wren.glb)
tests=(base/supple_base_tests cage/supple_cage_tests cage/supple_cage_without_decoders_tests skinning/supple_skinning_tests
    surface/supple_surface_tests cpu/supple_cpu_tests)

# foreign_libraries ARCHITECTURE: unpacks Debian's libraries of another architecture. Apt has a folder of its own for them, so this
# machine's packages stay as they are.
foreign_libraries() {
    local apt=$work/apt-$1 root=$work/libraries-$1 package
    [ ! -e "$root/complete" ] || return 0
    mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$root"
    : >"$apt/status"
    cat >"$apt/conf" <<END
APT::Architecture "$1"; APT::Architectures { "$1"; };
APT::Sandbox::User "root"; APT::Keep-Downloaded-Packages "true";
Dir::State "$apt"; Dir::State::lists "$apt/lists"; Dir::State::status "$apt/status"; Dir::Cache "$apt/cache";
END
    APT_CONFIG=$apt/conf apt-get update -qq || true # one list of several may be missing: what it costs, the next line says
    APT_CONFIG=$apt/conf apt-get install -y -qq --download-only --no-install-recommends libstdc++6 libgtest-dev libmeshoptimizer-dev \
        libdraco-dev libtinygltf-dev libvulkan-dev libpng-dev libjpeg62-turbo-dev libxxhash-dev libfast-float-dev libglm-dev \
        nlohmann-json3-dev libcli11-dev libnanoflann-dev libstb-dev >/dev/null || return 1
    for package in "$apt"/cache/archives/*.deb; do
        case $(basename "$package") in
            libc6-dev_* | linux-libc-dev_* | libstdc++-*-dev_* | libgcc-*-dev_*) ;; # the cross compiler has its own
            *) dpkg-deb -x "$package" "$root" || return 1 ;;
        esac
    done
    touch "$root/complete"
}

# configure NAME OPTIONS..: in $work/NAME.
configure() {
    local name=$1
    shift
    cmake -S . -B "$work/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSUPPLE_BUILD_TESTS=ON -DSUPPLE_BUILD_TOOLS=OFF \
        -DSUPPLE_INSTALL=OFF -DSUPPLE_BUILD_BOTH=OFF -DSUPPLE_COMPILED_SHADERS="$build/generated" "$@"
}
# configure_foreign PROCESSOR ARCHITECTURE. Debian's own CMake files of draco name where it would be installed.
configure_foreign() {
    foreign_libraries "$2" &&
        configure "$1" -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/debian_foreign.cmake" -DSUPPLE_PROCESSOR="$1" \
            -DSUPPLE_FOREIGN_LIBRARIES="$work/libraries-$2" -DCMAKE_DISABLE_FIND_PACKAGE_draco=ON
}
configure_one() {
    case $1 in
        gcc-O0) configure "$1" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O0 ;;
        gcc-native) configure "$1" -DCMAKE_CXX_FLAGS=-march=native -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON ;;
        clang)
            local everything=ON
            [ "$words_alone" = 0 ] || everything=OFF
            configure "$1" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DSUPPLE_BUILD_TOOLS=$everything
            ;;
        libcxx)
            configure "$1" -DSUPPLE_BUILD_TESTS=OFF -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
                -DCMAKE_CXX_FLAGS=-stdlib=libc++ -DSUPPLE_WITH_DRACO=OFF
            ;;
        aarch64) configure_foreign aarch64 arm64 ;;
        i386) configure_foreign i386 i386 ;;
    esac
}
# run_on NAME PROGRAM ARGUMENTS..
run_on() {
    local name=$1 root=$work/libraries-i386
    shift
    case $name in
        aarch64) qemu-aarch64 -L "$work/libraries-arm64" "$@" ;;
        i386) "$root/lib/ld-linux.so.2" --library-path "$root/lib/i386-linux-gnu:$root/usr/lib/i386-linux-gnu" "$@" ;;
        *) "$@" ;;
    esac
}
version_of() {
    case $1 in
        clang | libcxx | msvc-rules) clang++ --version | head -n 1 ;;
        aarch64) aarch64-linux-gnu-g++ --version | head -n 1 ;;
        i386) i686-linux-gnu-g++ --version | head -n 1 ;;
        *) g++ --version | head -n 1 ;;
    esac
}

# msvc_rules: prints each file that is refused; docs/windows.md says what the flags do and what they cannot find.
msvc_rules() {
    mkdir -p "$work/msvc-rules"
    clang++ -std=c++20 -dM -E -x c++ /dev/null | grep GCC_ATOMIC >"$work/msvc-rules/atomics.h"
    local flags=(-std=c++20 -fsyntax-only -fms-compatibility -fms-compatibility-version=19.29 -fgnuc-version=0 -D__STRICT_ANSI__
        -include "$work/msvc-rules/atomics.h" -DXXH_VECTOR=0 # no intrinsics of another compiler
        -pedantic-errors -Wgnu -Wmicrosoft -Werror -Wno-missing-field-initializers
        -I. -Iruntime/include -I"$build/generated")
    local folder unit refused=0
    for folder in $(git ls-files 'base/*.cpp' 'cage/*.cpp' 'skinning/*.cpp' 'surface/*.cpp' 'gpu/*.cpp' 'cpu/*.cpp' 'runtime/*.cpp' |
        xargs dirname | sort -u); do
        unit=$work/msvc-rules/${folder//\//_}.cpp
        git ls-files "$folder/*.cpp" | grep -E "^$folder/[^/]*$" | grep -vE 'lanes_avx2\.cpp$|/no_[^/]*$' |
            sed 's/.*/#include "&"/' >"$unit"
        clang++ "${flags[@]}" -x c++ "$unit" || { echo "refused: $folder"; refused=1; }
    done
    return $refused
}

# build_one NAME, test_one NAME, same_words NAME
build_one() {
    local targets=(tests/cpu/supple_cpu_words)
    if [ "$1" = libcxx ]; then
        mkdir -p "$work/$1/tests/cpu"
        configure_one "$1" && cmake --build "$work/$1" -j "$jobs" --target supple &&
            clang++ -stdlib=libc++ -std=c++20 -O1 -Iruntime/include tests/cpu/words.cpp "$work/$1/runtime/libsupple.a" -lmeshoptimizer \
                -o "$work/$1/tests/cpu/supple_cpu_words"
        return
    fi
    if [ $words_alone = 0 ]; then
        targets+=("${tests[@]/#/tests/}")
        [ "$1" != clang ] || targets+=(all)
    fi
    configure_one "$1" && cmake --build "$work/$1" -j "$jobs" --target "${targets[@]}" -- -k 0
}
test_one() {
    local test failed=0
    for test in "${tests[@]}"; do
        (cd "$work/$1" && run_on "$1" "tests/$test" --gtest_brief=1) || { echo "failed: $test"; failed=1; }
    done
    return $failed
}
same_words() {
    run_on "$1" "$work/$1/tests/cpu/supple_cpu_words" "${files[@]}" >"$work/$1.words" && diff "$work/words" "$work/$1.words"
}

cmake --build "$build" -j "$jobs" --target tests/cpu/supple_cpu_words >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$build/tests/cpu/supple_cpu_words" "${files[@]}" >"$work/words"

# step NAME WHAT FUNCTION: one cell of the table; what it prints goes to a file.
failed=0
step() {
    local name=$1 what=$2
    shift 2
    cell=passed
    if ! "$@" "$name" >"$work/$name.$what.log" 2>&1; then
        cell=FAILED
        failed=1
        echo "$name: $what failed, see $work/$name.$what.log" >&2
    fi
}
row='%-11s %-58s %-7s %-7s %-7s\n'
# shellcheck disable=SC2059
printf "$row" name compiler built tests words
for name in "${names[@]}"; do
    tested=- words=-
    if [ "$name" = msvc-rules ]; then
        step "$name" build msvc_rules
        built=$cell
    else
        step "$name" build build_one
        built=$cell
        if [ "$built" = passed ]; then
            [ $words_alone = 1 ] || [ "$name" = libcxx ] || { step "$name" tests test_one; tested=$cell; }
            step "$name" words same_words
            words=$cell
        fi
    fi
    # shellcheck disable=SC2059
    printf "$row" "$name" "$(version_of "$name")" "$built" "$tested" "$words"
done
exit $failed
