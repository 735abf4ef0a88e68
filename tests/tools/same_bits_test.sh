#!/usr/bin/env bash
# tools/same_bits.py on made-up programs: same_bits_test.sh SOURCES
set -euo pipefail
tool=$1/tools/same_bits.py
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() {
    echo "FAILED: $*"
    cat log
    exit 1
}

# program NAME REFUSAL LOOP: `supple` that refuses p-rep with that message, and whose loop surface of b.obj is that.
program() {
    cat >"$1" <<SUPPLE
#!/bin/sh
echo call >>"$folder/$1.calls"
case "\$*" in
inspect*a.glb*) echo '{"clips": [{"name": "walk"}]}' ;;
inspect*) echo '{"clips": []}' ;;
*a.glb*) case "\$1 \$*" in bake*"--clip 0"* | profile*) ;; *) exit 139 ;; esac ;;
*"--clip"*) exit 1 ;;
esac
case "\$*" in *"--scheme prep"*) echo "$2" >&2; exit 1 ;; esac
result=surface
case "\$*" in *b.obj*"--scheme loop"*) result="$3" ;; esac
case "\$1" in
bake) echo "\$result" >out.obj ;;
profile) echo "\$result" >view.txt ;;
esac
SUPPLE
    chmod +x "$1"
}
# expect CODE ARGUMENTS...
expect() {
    local wanted=$1 code=0
    shift
    "$tool" "$@" >log 2>&1 || code=$?
    [ $code -eq "$wanted" ] || fail "exit code $code"
}
mkdir files
touch files/a.glb files/b.obj files/notes.txt
program old "takes quads only" surface
program same "takes quads only" surface
program reworded "takes no triangles" surface
program other "takes quads only" another

# 9 schemes, 2 rates, 2 mappings; and 8 schemes in views.
expect 0 ./old ./same files
grep -q '^2 files, 104 cases: 92 with the same bytes, 12 refused alike, 0 different$' log || fail "counts"
expect 1 ./old ./reworded files/b.obj
[ "$(grep -c '^DIFFERENT .*/b.obj prep .*takes quads only.*takes no triangles' log)" -eq 6 ] || fail "other refusals"
expect 1 ./old ./other files
[ "$(grep -c '^DIFFERENT .*/b.obj loop rate [38] .*: out.obj differs' log)" -eq 4 ] || fail "other bytes"
[ "$(grep -c '^DIFFERENT .*/b.obj loop in a view .*: view.txt differs' log)" -eq 2 ] || fail "other views"
grep -q ' 6 different$' log || fail "counts of differences"
expect 0 ./old ./same files --no-views
grep -q ' 72 cases' log || fail "without views"

# What ends by a signal agrees with nothing.
printf '#!/bin/sh\nkill -SEGV $$\n' >crash
chmod +x crash
expect 1 ./crash ./crash files/b.obj
grep -q '52 different$' log || fail "crashes"

# OLD's results are kept; of another program they are not taken.
expect 0 ./old ./same files/b.obj --keep kept.json
rm old.calls
expect 1 ./old ./other files/b.obj --keep kept.json
[ "$(wc -l <old.calls)" -eq 1 ] || fail "runs OLD again" # inspect
expect 1 ./same ./other files/b.obj --keep kept.json
[ "$(wc -l <same.calls)" -gt 41 ] || fail "takes the results of another program"

expect 2 ./old ./none files
expect 2 ./old ./same none.glb
echo passed
