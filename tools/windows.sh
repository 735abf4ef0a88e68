#!/usr/bin/env bash
# Builds Supple for Windows, from Debian, in build/windows: the library, bin/supple.exe and the samples minimal and c_host.
# Usage: tools/windows.sh [cmake arguments]
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

install_missing "${supple_packages[@]}" "${supple_windows_packages[@]}"
tools/windows_libraries.sh
tools/basisu.sh || echo "Textures in KTX2 are left out: Basis Universal could not be fetched" >&2
cmake --preset windows "$@"
cmake --build --preset windows -j "$(nproc)"
