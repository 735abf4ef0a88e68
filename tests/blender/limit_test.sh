#!/bin/sh
# limit_test.sh PROGRAM OUT: Supple against what Blender has left in OUT. Exits 77 (skipped) where Blender was not there.
if [ ! -f "$2/cases.json" ]; then
    echo "skipped: Blender has evaluated nothing"
    exit 77
fi
exec "$1" "$2/cases.json"
