#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests with the Vulkan validation layer on.
# Usage: tools/test.sh [ctest arguments, such as -R Prep]
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

jobs=$(nproc)
install_missing "${supple_packages[@]}" "${supple_test_packages[@]}"
# Khronos' validator judges what supple convert and bake write. Without npm or its registry that test says that it was left out.
validator=$PWD/build/gltf-validator
if command -v npm >/dev/null && [ ! -d "$validator/node_modules/gltf-validator" ]; then
    mkdir -p "$validator"
    npm install --silent --no-audit --no-fund --prefix "$validator" gltf-validator@2.0.0-dev.3.10 || true
fi
[ ! -d "$validator/node_modules/gltf-validator" ] || export SUPPLE_GLTF_VALIDATOR=$validator/node_modules/gltf-validator
# demo.sh may have configured without the tests.
cmake --preset release -DSUPPLE_BUILD_TESTS=ON
cmake --build --preset release -j "$jobs"
export SUPPLE_VALIDATION=1
# The C library keeps freed memory for the next buffer. To ask the system for its pages again takes a third of the time.
export GLIBC_TUNABLES=glibc.malloc.mmap_threshold=134217728:glibc.malloc.trim_threshold=2147483647
exec ctest --preset release -j "$jobs" "$@"
