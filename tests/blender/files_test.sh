#!/bin/sh
# Characters through Blender and back: files_test.sh SUPPLE SAMPLES SHARED OUT. SAMPLES: the repository's own; SHARED: characters
# that lie beside the checkout on some machines. The files are left in OUT for the tests that open them.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
supple=$1 samples=$2 shared=$3 out=$4
rm -rf "$out"
mkdir -p "$out/before"
cp "$samples"/*.glb "$out/before"
if [ -d "$shared" ]; then
    for file in "$shared"/*.glb; do
        "$supple" convert "$file" -o "$out/before/$(basename "$file")" >/dev/null 2>&1
    done
else
    echo "19 characters left out: $shared is not present"
fi
exec sh "$here/run_blender.sh" files.py "$out" "$out"/before/*.glb
