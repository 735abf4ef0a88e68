#!/usr/bin/env bash
# Fetches the transcoder of Basis Universal, which textures in KTX2 need, to build/basis-universal. The next cmake finds it there.
# Debian 12 has neither a library of it nor its source. Debian's sid has the source package basis-universal: apt takes it
# from the mirror that this machine has anyway, checks its signature, and nothing is installed.
# Usage: tools/basisu.sh
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$PWD/build/basis-universal
[ ! -e "$folder/transcoder/basisu_transcoder.cpp" ] || exit 0
for tool in apt-get tar; do
    command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 3; }
done
mirror=$(apt-get indextargets --format '$(ORIGIN)|$(CODENAME)|$(REPO_URI)' 'Created-By: Packages' |
    awk -F'|' '$1 == "Debian" && $2 !~ /-/ { print $3 }' | sort -u | head -n 1)
[ -n "$mirror" ] || { echo "no mirror of Debian among this machine's package sources" >&2; exit 3; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/out"
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror sid main" >"$work/sid.list"
apt=(apt-get -qq -o APT::Sandbox::User= -o Dir::Etc::sourcelist="$work/sid.list" -o Dir::Etc::sourceparts=-
    -o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache")
"${apt[@]}" update
(cd "$work/out" && "${apt[@]}" source --download-only basis-universal)
version=$(sed -n 's/^Version: //p' "$work"/out/*.dsc)
case $version in
    2.*) ;;
    *) echo "sid has Basis Universal $version; supple is known to build with 2" >&2; exit 3 ;;
esac
# Of 130 MB the transcoder and the license are kept. It reads zstd by Debian's library.
tar -xf "$work"/out/*.orig.tar.* -C "$work/out" --strip-components=1 --wildcards '*/transcoder/*' '*/LICENSE'
# Found by fuzzing: a Huffman table of one long code has a tree whose last pair is not whole, and is read beyond its end.
internal=$work/out/transcoder/basisu_transcoder_internal.h
leaf='m_tree\[idx\] = (int16_t)sym_index;'
[ "$(grep -c "$leaf" "$internal")" = 1 ] || { echo "Basis Universal $version has other Huffman trees" >&2; exit 3; }
sed -i "s/$leaf/& if (idx + 1 == (int)m_tree.size()) m_tree.resize(idx + 2);/" "$internal"
rm -rf "$folder"
mkdir -p "$folder/zstd"
mv "$work/out/LICENSE" "$folder"
echo '#include <zstd.h>' >"$folder/zstd/zstd.h"
mv "$work/out/transcoder" "$folder"
echo "Basis Universal $version lies in $folder"
