#!/usr/bin/env bash
# Builds the lab of kernels, unless it is newer than its sources: build_lab.sh SOURCES FOLDER.
set -euo pipefail
sources=$1 folder=$2
if [ -x "$folder/gpu_lab" ] && [ -z "$(find "$sources" -type f -newer "$folder/gpu_lab" -print -quit)" ]; then
    exit 0
fi
mkdir -p "$folder"
"$sources/build.sh" "$folder"
