#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests with the Vulkan validation layer on.
# Usage: tools/test.sh [ctest arguments, such as -R Prep]
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

jobs=$(nproc)
install_missing "${supple_packages[@]}" "${supple_test_packages[@]}" "${supple_windows_packages[@]}"
# npm_package VARIABLE NAME VERSION: exports the package's folder. Without npm or its registry the tests that need it say that
# they were left out.
npm_package() {
    local folder=$PWD/build/$2
    if command -v npm >/dev/null && [ ! -d "$folder/node_modules/$2" ]; then
        mkdir -p "$folder"
        npm install --silent --no-audit --no-fund --prefix "$folder" "$2@$3" || true
    fi
    [ ! -d "$folder/node_modules/$2" ] || export "$1=$folder/node_modules/$2"
}
# Khronos' validator judges what supple and the add-on for Blender write; three.js opens it as viewers do.
npm_package SUPPLE_GLTF_VALIDATOR gltf-validator 2.0.0-dev.3.10
npm_package SUPPLE_THREE three 0.187.0
# Without its source package the tests of KTX2 say that they were left out.
tools/basisu.sh || echo "Textures in KTX2 are left out: Basis Universal could not be fetched" >&2
# Without it the tests of ray queries and mesh shaders say that they were left out.
tools/lavapipe.sh || echo "Ray queries and mesh shaders are left out: lavapipe of Debian's backports could not be fetched" >&2
# Without these the test mingw builds the library alone, and windows_bakes says that it was left out.
tools/windows_libraries.sh vulkan zlib png jpeg meshopt || echo "supple.exe is left out: its libraries could not be built" >&2
# demo.sh may have configured without the tests.
cmake --preset release -DSUPPLE_BUILD_TESTS=ON
cmake --build --preset release -j "$jobs"
export SUPPLE_VALIDATION=1
# Device memory is never zero: a layer fills it with patterns that change by test (tests/poison).
export VK_ADD_LAYER_PATH=$PWD/build/release/tests/poison VK_INSTANCE_LAYERS=VK_LAYER_SUPPLE_poison SUPPLE_POISON=each
# The C library keeps freed memory for the next buffer. To ask the system for its pages again takes a third of the time.
export GLIBC_TUNABLES=glibc.malloc.mmap_threshold=134217728:glibc.malloc.trim_threshold=2147483647
exec ctest --preset release -j "$jobs" "$@"
