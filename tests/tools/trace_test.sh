#!/usr/bin/env bash
# supple render --trace: trace_test.sh SUPPLE CHARACTER [DRIVER]. Where the device has no ray queries it says so; on DRIVER, the
# manifest of one that has, the picture is another than that of shadow maps. Exits 77 (skipped) without it.
set -euo pipefail
supple=$1 character=$2 driver=${3:-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
render() { "$supple" render "$character" --size 160x120 --rate 2 "$@" >"$folder/log" 2>&1; }
fail() {
    echo "FAILED: $*"
    cat "$folder/log"
    exit 1
}

code=0
render --trace -o "$folder/here.png" || code=$?
case $code in
0) ;;
3) grep -q 'VK_KHR_acceleration_structure\|VK_KHR_ray_query' "$folder/log" || fail "what the device lacks is not named" ;;
*) fail "exit code $code" ;;
esac
for other in '--scheme cage' '--view levels' --levels --split; do
    code=0
    # shellcheck disable=SC2086
    render --trace $other -o "$folder/other.png" || code=$?
    [ $code = 2 ] || fail "--trace $other: exit code $code"
    grep -q -- --trace "$folder/log" || fail "--trace $other: the message does not name it"
done
[ -n "$driver" ] || { echo "left out: no driver with ray queries; tools/lavapipe.sh fetches one"; exit 77; }

export VK_DRIVER_FILES=$driver
render --trace --validate -o "$folder/traced.png" || fail "--trace"
render -o "$folder/mapped.png" || fail "without --trace"
cmp -s "$folder/traced.png" "$folder/mapped.png" && fail "no ray was cast"
echo passed
