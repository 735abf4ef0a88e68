#!/bin/sh
# What a tool of ours makes is what lies in samples/assets, to the byte.
# Usage: sample_asset_test.sh ASSET.glb TOOL [OPTION..]
set -eu
asset=$1
shift
made=$(mktemp)
trap 'rm -f "$made"' EXIT
"$@" "$made"
cmp "$made" "$asset"
