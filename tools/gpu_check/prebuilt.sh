# shellcheck shell=bash disable=SC2034,SC2154 # the variables are those of gpu_check.sh
# What a machine has to be given before what pack.sh has collected runs there.

# unpack FOLDER: from here on all runs in what was packed, and parts lie there too: of many files few may come back.
unpack() {
    if [ ! -f "$1/pack.tar.gz" ]; then
        echo "$1 is no folder that --pack has made: it has no pack.tar.gz." >&2
        exit 2
    fi
    unpacked=$(mktemp -d)
    timeout 10 tar -xzf "$1/pack.tar.gz" -C "$unpacked"
    mkdir "$unpacked/parts"
    parts=$unpacked/parts
    build=$unpacked/tree
    cd "$unpacked/tree" || exit 1
    make_links
    find_driver
    find_libraries bin/* tests/runtime/supple_runtime_tests
}
unpacked='' links=()

# Tests look for their data and for compilers of shaders where these lay when the tests were compiled.
make_links() {
    local path target
    while read -r path target; do
        if [ -e "$path" ]; then
            [ "$(realpath "$path")" = "$(realpath "$target")" ] || echo "Tests take $path, which is there."
        elif mkdir -p "$(dirname "$path")" 2>/dev/null && ln -s "$unpacked/tree/$target" "$path" 2>/dev/null; then
            links+=("$path")
        else
            echo "$path cannot be made: tests that need it will fail."
        fi
    done <links.txt
}

# Some machines have NVIDIA's driver where neither the loader of Vulkan nor that of libraries looks.
nvidia=/usr/local/nvidia
known_libraries=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p 2>/dev/null || true)
find_driver() {
    local found=''
    if [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || compgen -G '/etc/vulkan/icd.d/nvidia*.json' >/dev/null ||
        compgen -G '/usr/share/vulkan/icd.d/nvidia*.json' >/dev/null; then
        return
    fi
    if [ -d "$nvidia/lib64" ] && [[ $known_libraries != *libGLX_nvidia.so.0* ]]; then
        export LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$nvidia/lib64
    fi
    if [ -f "$nvidia/share/vulkan/icd.d/nvidia_icd.json" ]; then
        found=$nvidia/share/vulkan/icd.d/nvidia_icd.json
    elif [[ $known_libraries == *libGLX_nvidia.so.0* ]] || [ -e "$nvidia/lib64/libGLX_nvidia.so.0" ]; then
        found=$unpacked/nvidia_icd.json
        echo '{"file_format_version": "1.0.0", "ICD": {"library_path": "libGLX_nvidia.so.0", "api_version": "1.3.0"}}' >"$found"
    fi
    if [ -n "$found" ]; then
        echo "NVIDIA's driver is named to the loader: $found"
        export VK_ADD_DRIVER_FILES=$found
    fi
}

# find_libraries PROGRAMS...: what the machine has is taken from it, because its driver fits that; what it lacks, from the pack.
find_libraries() {
    local wanting programs=("$@") name
    mkdir "$unpacked/lacking"
    export LD_LIBRARY_PATH=${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$unpacked/lacking
    while wanting=$(lacking_libraries "${programs[@]}") && [ -n "$wanting" ]; do
        for name in $wanting; do
            if [ -e "$unpacked/lacking/$name" ] || [ ! -f "lib/$name" ]; then
                echo "$name is missing here or too old, and is not packed."
                return
            fi
            ln -s "$unpacked/tree/lib/$name" "$unpacked/lacking/$name"
        done
    done
    # The loader of Vulkan opens the driver by name, and so finds what that needs.
    local driver
    for driver in $(sed -n 's/.*libGLX_nvidia\.so\.0 .* => //p' <<<"$known_libraries") $nvidia/lib64/libGLX_nvidia.so.0; do
        for name in $( (ldd "$driver" 2>/dev/null || true) | sed -n 's/^\t\([^ ]*\) => not found.*/\1/p'); do
            [ ! -f "lib/$name" ] || ln -sf "$unpacked/tree/lib/$name" "$unpacked/lacking/$name"
        done
    done
    echo "Libraries from the pack: $(find "$unpacked/lacking" -type l -printf '%f ')"
}
# Those that are not found, and those that lack a version: what is too old here is in the pack.
lacking_libraries() {
    local program
    for program in "$@"; do
        LD_TRACE_LOADED_OBJECTS=1 LD_WARN=yes "$program" 2>&1 || true
    done | sed -n -e 's/^\t\([^ ]*\) => not found.*/\1/p' -e 's/.*\/\([^/]*\): version .* not found.*/\1/p' | sort -u
}

remove_unpacked() {
    [ ${#links[@]} -eq 0 ] || rm -f "${links[@]}"
    [ -z "$unpacked" ] || rm -rf "$unpacked"
}
