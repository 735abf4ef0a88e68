#!/usr/bin/env bash
# Whether clang takes the library with libc++, version 14 or later, as toolchains of Apple, Android and consoles have it: one unit a
# folder, of which no code is made. Warnings are errors, but for what g++ does not say of designated initializers.
#   libcxx_test.sh BUILD SOURCE WORK
# Its shaders are those of BUILD.
set -euo pipefail
build=$1
source=$2
work=$3
if ! command -v clang++ >/dev/null || ! clang++ -stdlib=libc++ -x c++ -fsyntax-only - <<<'#include <vector>' 2>/dev/null; then
    echo "skipped: clang and libc++-dev are not installed"
    exit 77
fi
mkdir -p "$work"
cd "$source"
flags=(-stdlib=libc++ -std=c++20 -fsyntax-only -Wall -Wextra -Wno-missing-field-initializers -Werror -fno-rtti -I. -Iruntime/include -I"$build/generated")
failed=0
folders=$(find base cage skinning surface gpu cpu runtime -name '*.cpp' -printf '%h\n' | sort -u)
count=$(wc -l <<<"$folders")
if [ "$count" -lt 25 ]; then
    echo "the library has more folders than these $count: $folders"
    exit 1
fi
for folder in $folders; do
    unit=$work/${folder//\//_}.cpp
    # Lanes of AVX2 have flags of their own, and no_*.cpp stand for what is left out.
    find "$folder" -maxdepth 1 -name '*.cpp' ! -name 'lanes_avx2.cpp' ! -name 'no_*.cpp' | sort | sed 's/.*/#include "&"/' >"$unit"
    if ! clang++ "${flags[@]}" -x c++ "$unit" >"$work/log" 2>&1; then
        grep -E -m 20 'error' "$work/log" || cat "$work/log"
        echo "failed: $folder"
        failed=1
    fi
done
[ $failed = 1 ] || echo "${SECONDS}s  $count folders, clean"
exit $failed
