#!/usr/bin/env bash
# Fails when programs linked against the last release of the same ABI would break.
#   abi_test.sh LIBRARY SOURCE ABI WORK
# New functions and new enumerators pass. Structs that say their size may grow at their end (runtime/sized.h).
# Exits 77 (skipped) and says why where there is nothing to compare.
set -euo pipefail
library=$1
source=$2
abi=$3
work=$4

if ! command -v abidw >/dev/null || ! command -v abidiff >/dev/null; then
    echo "skipped: abidw and abidiff (abigail-tools) are not installed"
    exit 77
fi
# The newest dump of this ABI.
last=$(grep -lF "soname='libsupple.so.$abi'" "$source"/tests/abi/supple-*.abi 2>/dev/null | sort -V | tail -n 1 || true)
if [ -z "$last" ]; then
    echo "skipped: no release has libsupple.so.$abi yet; tools/abi_dump.sh writes tests/abi/supple-<version>.abi at one"
    exit 77
fi

sized=$(awk '/^typedef struct Supple/ { name = $3 } /^struct Supple/ { name = $2 } /^    uint32_t structSize;/ { print name }' "$source"/runtime/include/supple/*.h)
cat > "$work/growth.suppr" <<END
[suppress_type]
  type_kind = struct
  name_regexp = ^($(paste -sd '|' <<< "$sized"))\$
  has_data_member_inserted_at = end
END
"$source/tools/abi_dump.sh" "$library" "$work/now.abi"
# Programs have the value of an enumerator, not its name.
sed 's/SUPPLE_PATCH_CATMULL_CLARK/SUPPLE_PATCH_FRAGMENT/' "$last" > "$work/last.abi"
result=0
abidiff --no-added-syms --leaf-changes-only --suppressions "$work/growth.suppr" "$work/last.abi" "$work/now.abi" || result=$?
if [ $result -ne 0 ]; then
    echo "failed: libsupple.so.$abi is not what $(basename "$last") was (abidiff: $result). Undo the change, or raise SUPPLE_ABI in CMakeLists.txt."
    exit 1
fi
echo "passed: as $(basename "$last"), or with more functions"
