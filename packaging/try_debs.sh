#!/usr/bin/env bash
# Installs the packages that tools/package.sh made in a bare Debian 12, and uses them there as their users would: it renders a
# picture by the supple command, and builds and runs hosts in C and C++. Needs root and debootstrap. Nothing outside FOLDER changes.
# Usage: packaging/try_debs.sh FOLDER [MIRROR]
# The bare Debian stays in FOLDER/root and is used again.
set -euo pipefail
folder=$(mkdir -p "$1" && cd "$1" && pwd)
cd "$(dirname "$0")/.."
. tools/packages.sh
mirror=${2:-$(debian_mirror)}
root=$folder/root
if [ ! -e "$root/made" ]; then
    rm -rf "$root"
    debootstrap --variant=minbase bookworm "$root" "$mirror" >"$folder/log" 2>&1 || { tail "$folder/log"; exit 1; }
    touch "$root/made"
fi
mkdir -p "$root/try"
cp build/deb/packages/*.deb "$root/try"
cp -r tests/packaging/consumer samples/assets/pip.glb "$root/try"
cat >"$root/try/try.sh" <<'EOF'
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
cd /try
apt() { apt-get -qq -y -o Dpkg::Use-Pty=0 --no-install-recommends "$@" >/dev/null; }
apt update
apt install ./libsupple0_*.deb ./libsupple-dev_*.deb ./supple-tools_*.deb mesa-vulkan-drivers
supple --version
supple render pip.glb --clip walk --size 400x400 -o picture.png
apt install gcc g++ cmake make pkg-config
version=$(supple --version | tr -dc '0-9.')
for shared in ON OFF; do
    cmake -S consumer -B build-$shared -DHOW=package "-DLANGUAGES=C;CXX" -DVERSION="$version" -DCOMPONENTS=tools -Dsupple_SHARED=$shared >/dev/null
    cmake --build build-$shared >/dev/null
    build-$shared/consumer_c
    build-$shared/consumer_cpp
done
cc -std=c99 consumer/main.c -o by_pkg_config $(pkg-config --cflags --libs supple)
./by_pkg_config
apt purge libsupple0
[ ! -e /usr/bin/supple ] || { echo "supple is still there"; exit 1; }
echo "installed, used, removed"
EOF
chroot "$root" bash /try/try.sh
cp "$root/try/picture.png" "$folder/picture.png"
echo "$folder/picture.png"
