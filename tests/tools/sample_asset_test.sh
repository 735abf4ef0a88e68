#!/bin/sh
# What a tool of ours makes is what lies in samples/assets, to the byte.
# Usage: sample_assets_test.sh TOOL ASSET.glb
set -eu
made=$(mktemp)
trap 'rm -f "$made"' EXIT
"$1" "$made"
cmp "$made" "$2"
