#!/usr/bin/env bash
# Writes the library's binary interface as XML: functions, and the types of the public headers. At a release:
#   tools/abi_dump.sh                 # builds it, and writes tests/abi/supple-<version>.abi, to be committed
#   tools/abi_dump.sh LIBRARY OUT     # from a shared library with debug information, as the test does
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

if [ $# -eq 0 ]; then
    cd "$root"
    cmake --preset release -DSUPPLE_BUILD_TESTS=ON >/dev/null
    cmake --build --preset release --target supple_abi
    version=$(sed -n 's/^project(supple VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
    set -- build/release/tests/abi/libsupple.so "tests/abi/supple-$version.abi"
elif [ $# -ne 2 ]; then
    echo "usage: tools/abi_dump.sh [LIBRARY OUT]" >&2
    exit 2
fi

# No paths, and ids that do not depend on the order in which types are met.
abidw --headers-dir "$root/runtime/include/supple" --drop-private-types --exported-interfaces-only --type-id-style hash \
    --no-corpus-path --no-comp-dir-path --no-show-locs --out-file "$2" "$1"
sed -i -E "s/ (filepath|comp-dir-path|architecture-path)='[^']*'//g" "$2"
# Translation units keep the names of their files, which tell them apart, and lose the folders that they lay in.
sed -i -E "s@ path='[^']*/([^/']+)'@ path='\1'@g; s@='/[^']*/([^/']+)'@='\1'@g" "$2"
if grep -n "='/" "$2"; then
    echo "$2 names folders of this machine" >&2
    exit 1
fi
grep -q "name='suppleCreateContext'" "$2" || { echo "$2 lacks the library's functions" >&2; exit 1; }
echo "$2"
