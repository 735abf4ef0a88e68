# The port lies in Supple's own sources and builds these.
get_filename_component(source "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

string(COMPARE EQUAL "${VCPKG_LIBRARY_LINKAGE}" "dynamic" shared)
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES
    cpu SUPPLE_WITH_CPU
    draco SUPPLE_WITH_DRACO
    meshopt SUPPLE_WITH_MESHOPT)

# Shaders are compiled by programs of the machine that builds, also where that builds for another one.
foreach(tool IN ITEMS glslang spirv-tools)
    vcpkg_add_to_path("${CURRENT_HOST_INSTALLED_DIR}/tools/${tool}")
endforeach()

vcpkg_cmake_configure(SOURCE_PATH "${source}" OPTIONS
    -DSUPPLE_BUILD_SHARED=${shared}
    -DSUPPLE_BUILD_BOTH=OFF
    -DSUPPLE_BUILD_TOOLS=OFF
    -DSUPPLE_BUILD_TESTS=OFF
    -DSUPPLE_INSTALL=ON
    ${features})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/supple)
vcpkg_fixup_pkgconfig()
vcpkg_copy_pdbs()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share"
    "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${source}/LICENSE")
