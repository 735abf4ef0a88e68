# shellcheck shell=bash disable=SC2034
# What Supple needs of Debian 12 (bookworm) or a relative of it. The one list; sourced by demo.sh, test.sh, compilers.sh,
# windows.sh and package.sh.

# To build and run.
supple_packages=(
    g++ cmake ninja-build
    libvulkan-dev mesa-vulkan-drivers
    glslang-tools spirv-tools
    libglm-dev nlohmann-json3-dev libmeshoptimizer-dev libdraco-dev libstb-dev libpng-dev libjpeg62-turbo-dev libcli11-dev
    libnanoflann-dev libxxhash-dev
    libglfw3-dev libimgui-dev libsdl2-dev libwebp-dev libzstd-dev libfontconfig-dev
)
# To test as well.
supple_test_packages=(
    libgtest-dev vulkan-validationlayers libtinygltf-dev libtinyobjloader-dev
    libosd-dev libegl-dev libgl-dev
    xvfb xauth xdotool
    qt6-declarative-dev qml6-module-qtquick qml6-module-qtquick-controls
    qml6-module-qtquick-templates qml6-module-qtqml-workerscript
    abigail-tools pkg-config spirv-cross
    doxygen python3
    clang libc++-dev libc++abi-dev libfast-float-dev
    blender python3-numpy chromium fonts-dejavu-core
)
# To build for Windows, and to run that here.
supple_windows_packages=(
    g++-mingw-w64-x86-64-posix dpkg-dev
    wine64 xvfb xauth
)
# To try other compilers and processors: tools/compilers.sh, not the tests. Debian removes gcc-multilib for these.
supple_compiler_packages=(
    clang libc++-dev libc++abi-dev libfast-float-dev
    g++-aarch64-linux-gnu g++-i686-linux-gnu qemu-user
)
# To make Debian packages: tools/package.sh, not the tests.
supple_deb_packages=(
    dpkg-dev fakeroot lintian
    doxygen python3
)

# install_missing PACKAGE...: installs those that are not there yet; asks nothing and does nothing when all are.
install_missing() {
    local missing=() package
    if ! command -v apt-get >/dev/null; then
        echo "Not a Debian system: make sure that the counterparts of these are installed: $*" >&2
        return 0
    fi
    for package in "$@"; do
        if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
            missing+=("$package")
        fi
    done
    [ ${#missing[@]} -gt 0 ] || return 0

    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "These packages are missing; install them as root: apt-get install ${missing[*]}" >&2
            return 1
        fi
        as_root=(sudo)
    fi
    echo "Installing ${missing[*]}"
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# debian_mirror: where this machine gets Debian 12 from; says so and fails if it does not.
debian_mirror() {
    local mirror
    mirror=$(apt-get indextargets --format '$(ORIGIN)|$(CODENAME)|$(REPO_URI)' 'Created-By: Packages' |
        awk -F'|' '$1 == "Debian" && $2 == "bookworm" { print $3 }' | sort -u | head -n 1)
    [ -n "$mirror" ] || { echo "no mirror of Debian 12 among this machine's package sources" >&2; return 3; }
    echo "$mirror"
}
