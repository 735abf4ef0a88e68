#!/usr/bin/env bash
# Builds the libraries that the supple command links, for Windows, static, to build/windows-libraries: from the sources of this
# Debian, by MinGW-w64. The preset `windows` finds them there. Nothing is installed.
# Usage: tools/windows_libraries.sh [LIBRARY...]
# Without arguments all: vulkan zlib png jpeg, without which there is no command, and meshopt draco webp zstd glfw imgui. What the
# command lacks without one of these stands in docs/windows.md.
set -euo pipefail
cd "$(dirname "$0")/.."

source=$PWD
prefix=${SUPPLE_WINDOWS_LIBRARIES:-$PWD/build/windows-libraries}
triple=x86_64-w64-mingw32
all=(vulkan zlib png jpeg meshopt draco webp zstd glfw imgui)
[ $# -gt 0 ] || set -- "${all[@]}"
for tool in apt-get dpkg-source cmake ninja $triple-gcc-posix $triple-g++-posix; do
    command -v "$tool" >/dev/null || { echo "$tool is missing" >&2; exit 3; }
done
mkdir -p "$prefix/include" "$prefix/lib" "$prefix/built"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# sources_of PATTERN FILE: this release's archives whose code names match, from the mirrors that this machine has.
sources_of() {
    apt-get indextargets --format '$(ORIGIN)|$(REPO_URI)|$(CODENAME)' 'Created-By: Packages' |
        awk -F'|' -v wanted="^$1\$" '$1 == "Debian" && $3 ~ wanted { print $2, $3 }' | LC_ALL=C sort -ru |
        sed 's|.*|deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] & main|' >"$2"
    [ -s "$2" ] || { echo "no mirror of Debian among this machine's package sources" >&2; exit 3; }
}

# unpack PACKAGE: the source of Debian's package, with its patches, to $work/PACKAGE. Some mirrors lack the sources of security
# updates: then it is what the release came with.
unpack() {
    local release archive
    release=$(. /etc/os-release && echo "$VERSION_CODENAME")
    for archive in "$release.*" "$release"; do
        local here="$work/archive $archive"
        local apt=(apt-get -qq -o APT::Sandbox::User= -o Dir::Etc::sourcelist="$here/sources.list" -o Dir::Etc::sourceparts=-
            -o Dir::State::lists="$here/lists" -o Dir::Cache="$here/cache")
        if [ ! -e "$here" ]; then
            mkdir -p "$here/lists/partial" "$here/cache/archives/partial"
            sources_of "$archive" "$here/sources.list"
            "${apt[@]}" update
        fi
        rm -rf "$work/get"
        mkdir "$work/get"
        if (cd "$work/get" && "${apt[@]}" source --download-only "$1" 2>"$work/log"); then
            (cd "$work/get" && dpkg-source -q -x ./*.dsc "$work/$1" 2>/dev/null)
            return
        fi
    done
    cat "$work/log" >&2
    exit 3
}

# build_target PACKAGE TARGET ARGUMENTS...: builds a target of the package's own CMakeLists.txt in $work/PACKAGE-build.
build_target() {
    local package=$1 target=$2
    shift 2
    unpack "$package"
    cmake -S "$work/$package" -B "$work/$package-build" -G Ninja --toolchain "$source/cmake/mingw-w64.cmake" --log-level=WARNING \
        -DSUPPLE_WINDOWS_LIBRARIES="$prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX:STRING="$prefix" \
        -DCMAKE_INSTALL_LIBDIR:STRING=lib -DBUILD_SHARED_LIBS=OFF -Wno-dev "$@" >/dev/null
    cmake --build "$work/$package-build" --target "$target" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
}

# What vulkan-1.dll exports that hosts link: the functions of the core and of surfaces, by the headers.
build_vulkan() {
    {
        echo "LIBRARY vulkan-1.dll"
        echo "EXPORTS"
        cat /usr/include/vulkan/vulkan_core.h /usr/include/vulkan/vulkan_win32.h | awk '
            /^#define VK_(VERSION|KHR)_[A-Za-z0-9_]+ 1/ { part = $2 }
            part ~ /^VK_(VERSION_|KHR_surface|KHR_swapchain|KHR_win32_surface)/ && match($0, /VKAPI_CALL vk[A-Za-z0-9]+\(/) {
                print substr($0, RSTART + 11, RLENGTH - 12) }'
    } >"$work/vulkan-1.def"
    $triple-dlltool -d "$work/vulkan-1.def" -l "$prefix/lib/libvulkan-1.a"
    ln -sfn /usr/include/vulkan "$prefix/include/vulkan"
    ln -sfn /usr/include/vk_video "$prefix/include/vk_video"
}

build_zlib() {
    unpack zlib
    (cd "$work/zlib" && $triple-gcc-posix -O2 -c ./*.c && $triple-ar rcs "$prefix/lib/libz.a" ./*.o)
    cp "$work/zlib/zlib.h" "$work/zlib/zconf.h" "$prefix/include"
}

build_png() {
    build_target libpng1.6 png_static -DPNG_SHARED=OFF -DPNG_TESTS=OFF
    cp "$work/libpng1.6-build/libpng16.a" "$prefix/lib/libpng.a"
    cp "$work"/libpng1.6/{png,pngconf}.h "$work/libpng1.6-build/pnglibconf.h" "$prefix/include"
}

# Without SIMD, which needs an assembler; what is decoded is the same.
build_jpeg() {
    build_target libjpeg-turbo jpeg-static -DENABLE_SHARED=OFF -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF
    cp "$work/libjpeg-turbo-build/libjpeg.a" "$prefix/lib"
    cp "$work"/libjpeg-turbo/{jpeglib,jmorecfg,jerror}.h "$work/libjpeg-turbo-build/jconfig.h" "$prefix/include"
}

build_meshopt() {
    build_target meshoptimizer install
}

build_draco() {
    build_target draco install
}

# Without the programs that come with it. Animated pictures need its muxer.
build_webp() {
    local part off=()
    for part in ANIM_UTILS CWEBP DWEBP GIF2WEBP IMG2WEBP VWEBP WEBPINFO WEBPMUX EXTRAS; do
        off+=("-DWEBP_BUILD_$part=OFF")
    done
    build_target libwebp install -DWEBP_BUILD_LIBWEBPMUX=ON "${off[@]}"
}

# What Basis Universal unpacks textures with: tools/basisu.sh fetches the rest.
build_zstd() {
    unpack libzstd
    (cd "$work/libzstd/lib" && $triple-gcc-posix -O2 -DZSTD_DISABLE_ASM=1 -c common/*.c decompress/*.c &&
        $triple-ar rcs "$prefix/lib/libzstd.a" ./*.o)
    cp "$work"/libzstd/lib/zstd*.h "$prefix/include"
}

build_glfw() {
    build_target glfw3 install -DGLFW_BUILD_EXAMPLES=OFF -DGLFW_BUILD_TESTS=OFF -DGLFW_BUILD_DOCS=OFF
}

# After glfw and vulkan. It has no CMakeLists.txt.
build_imgui() {
    unpack imgui
    mkdir -p "$prefix/include/imgui/backends"
    cp "$work"/imgui/*.h "$prefix/include/imgui"
    cp "$work"/imgui/backends/imgui_impl_{glfw,vulkan}.h "$prefix/include/imgui/backends"
    (cd "$work/imgui" && $triple-g++-posix -O2 -I. -I"$prefix/include" -c imgui*.cpp backends/imgui_impl_{glfw,vulkan}.cpp &&
        $triple-ar rcs "$prefix/lib/libimgui.a" ./*.o)
}

for library in "$@"; do
    declare -F "build_$library" >/dev/null || { echo "$library is none of: ${all[*]}" >&2; exit 2; }
    [ ! -e "$prefix/built/$library" ] || continue
    "build_$library"
    touch "$prefix/built/$library"
    echo "${SECONDS}s  $library"
done
