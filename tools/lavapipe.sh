#!/usr/bin/env bash
# Fetches Mesa's lavapipe of Debian's backports, which has ray queries and mesh shaders, to build/lavapipe. The next cmake finds it
# there, for the tests RayQueries and MeshShaders. Nothing is installed: apt takes the package from the mirror that this machine has
# anyway, and checks its signature. To run another program on it, set VK_DRIVER_FILES=build/lavapipe/lavapipe.json.
# Usage: tools/lavapipe.sh
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

folder=$PWD/build/lavapipe
[ ! -e "$folder/lavapipe.json" ] || exit 0
for tool in apt-get dpkg-deb; do
    command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 3; }
done
mirror=$(debian_mirror)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/out"
for suite in bookworm bookworm-backports; do
    echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main"
done >"$work/backports.list"
apt=(apt-get -qq -o APT::Sandbox::User= -o Dir::Etc::sourcelist="$work/backports.list" -o Dir::Etc::sourceparts=-
    -o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache")
"${apt[@]}" update
(cd "$work" && "${apt[@]}" download mesa-vulkan-drivers/bookworm-backports)
dpkg-deb -x "$work"/mesa-vulkan-drivers_*.deb "$work/out"

rm -rf "$folder"
mkdir -p "$folder"
driver=$(find "$work/out" -name libvulkan_lvp.so -print -quit)
missing=$(ldd "$driver" | awk '/not found/ { print $1 }' | tr '\n' ' ')
[ -z "$missing" ] || { echo "lavapipe of the backports needs $missing" >&2; exit 3; }
mv "$driver" "$folder"
# Last, as it says that all is there.
printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' \
    "$folder/libvulkan_lvp.so" >"$folder/lavapipe.json"
