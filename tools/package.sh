#!/usr/bin/env bash
# Makes the Debian packages in build/deb/packages and checks them.
# Usage: tools/package.sh [cmake arguments, such as -DSUPPLE_MAINTAINER="Name <address>"]
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

install_missing "${supple_packages[@]}" "${supple_deb_packages[@]}"
cmake --preset deb "$@"
cmake --build build/deb --target supple supple_other supple_command docs -j "$(nproc)"
rm -rf build/deb/packages
(cd build/deb && cpack -B "$PWD/packages")
for package in build/deb/packages/*.deb; do
    echo
    dpkg -I "$package"
    dpkg -c "$package"
done
if command -v lintian >/dev/null; then
    echo
    # The address is the packager's to give (-DSUPPLE_MAINTAINER=...), and there is no bug to close.
    lintian --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog,initial-upload-closes-no-bugs \
        build/deb/packages/*.deb
fi
