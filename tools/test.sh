#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests with the Vulkan validation layer on.
# Usage: tools/test.sh [ctest arguments, such as -R Prep]
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

jobs=$(nproc)
install_missing "${supple_packages[@]}" "${supple_test_packages[@]}"
# demo.sh may have configured without the tests.
cmake --preset release -DSUPPLE_BUILD_TESTS=ON
cmake --build --preset release -j "$jobs"
export SUPPLE_VALIDATION=1
exec ctest --preset release -j "$jobs" "$@"
