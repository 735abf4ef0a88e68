# Install rules, in three components: runtime (the shared library), development (headers, libraries to link, packages for
# CMake and pkg-config, GLSL, documents), tools (the supple command).
include(CMakePackageConfigHelpers)

set(config_directory ${CMAKE_INSTALL_LIBDIR}/cmake/supple)
set(shader_directory ${CMAKE_INSTALL_DATADIR}/supple/shaders)

# ---- the library, of one kind or both

set(installed_kinds "")
foreach(target supple supple_other)
    if(NOT TARGET ${target})
        continue()
    endif()
    get_target_property(type ${target} TYPE)
    set(export suppleStaticTargets)
    if(type STREQUAL "SHARED_LIBRARY")
        set(export suppleSharedTargets)
    endif()
    list(APPEND installed_kinds ${type})
    install(TARGETS ${target} EXPORT ${export}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(EXPORT ${export} NAMESPACE supple:: DESTINATION ${config_directory} COMPONENT development)
endforeach()

install(FILES
    ${supple_SOURCE_DIR}/runtime/include/supple/supple.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple.hpp
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_character.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_direct.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_playback.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_points.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_queries.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_rays.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_prepare.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_recording.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_tinygltf.hpp
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_tracy.h
    ${supple_SOURCE_DIR}/runtime/include/supple/supple_view.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/supple COMPONENT development)
if(SUPPLE_WITH_CPU)
    install(FILES ${supple_SOURCE_DIR}/runtime/include/supple/supple_cpu.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/supple COMPONENT development)
endif()
list(TRANSFORM SUPPLE_HOST_SHADERS PREPEND ${supple_SOURCE_DIR}/shaders/ OUTPUT_VARIABLE host_shaders)
install(FILES ${host_shaders} DESTINATION ${shader_directory} COMPONENT development)
# The headers cite documents.
install(DIRECTORY ${supple_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/supple COMPONENT development
    FILES_MATCHING PATTERN "*.md" PATTERN "*.schema.json" PATTERN "images/*")
# If the target docs was built.
install(FILES ${supple_BINARY_DIR}/docs/api.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/supple COMPONENT development OPTIONAL)

# ---- for find_package

set(SUPPLE_CXX_LIBRARIES ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM SUPPLE_CXX_LIBRARIES ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
set(SUPPLE_INSTALL_SHADER_DIR ${shader_directory})
configure_package_config_file(${supple_SOURCE_DIR}/cmake/suppleConfig.cmake.in ${supple_BINARY_DIR}/suppleConfig.cmake
    INSTALL_DESTINATION ${config_directory} PATH_VARS SUPPLE_INSTALL_SHADER_DIR)
# Before 1.0 a minor version may change the API.
set(compatibility SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(compatibility SameMinorVersion)
endif()
write_basic_package_version_file(${supple_BINARY_DIR}/suppleConfigVersion.cmake COMPATIBILITY ${compatibility})
install(FILES ${supple_BINARY_DIR}/suppleConfig.cmake ${supple_BINARY_DIR}/suppleConfigVersion.cmake
    DESTINATION ${config_directory} COMPONENT development)
if(SUPPLE_WITH_MESHOPT AND "STATIC_LIBRARY" IN_LIST installed_kinds)
    install(FILES ${supple_SOURCE_DIR}/cmake/supple_meshoptimizer.cmake
        DESTINATION ${config_directory} COMPONENT development)
endif()
if(SUPPLE_WITH_DRACO AND "STATIC_LIBRARY" IN_LIST installed_kinds)
    install(FILES ${supple_SOURCE_DIR}/cmake/supple_draco.cmake
        DESTINATION ${config_directory} COMPONENT development)
endif()

# ---- for pkg-config

# supple_pc_path(VARIABLE DIRECTORY): the directory as the .pc file says it, below its prefix where it lies there.
function(supple_pc_path variable directory)
    if(IS_ABSOLUTE ${directory})
        set(${variable} ${directory} PARENT_SCOPE)
    else()
        set(${variable} "\${prefix}/${directory}" PARENT_SCOPE)
    endif()
endfunction()
supple_pc_path(SUPPLE_PC_LIBDIR ${CMAKE_INSTALL_LIBDIR})
supple_pc_path(SUPPLE_PC_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR})
supple_pc_path(SUPPLE_PC_SHADERDIR ${shader_directory})
set(SUPPLE_PC_PREFIX ${CMAKE_INSTALL_PREFIX})
if(NOT IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} AND NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    # From the file itself, so that the folder can be moved. What lies in /usr stays there, and pkg-config leaves out what
    # compilers know anyway.
    file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    string(REGEX REPLACE "/$" "" up ${up})
    set(SUPPLE_PC_PREFIX "\${pcfiledir}/${up}")
endif()
set(SUPPLE_PC_CFLAGS "")
if(NOT SUPPLE_VULKAN_INCLUDE IN_LIST CMAKE_C_IMPLICIT_INCLUDE_DIRECTORIES)
    string(APPEND SUPPLE_PC_CFLAGS " -I${SUPPLE_VULKAN_INCLUDE}")
endif()
if(WIN32 AND NOT "STATIC_LIBRARY" IN_LIST installed_kinds)
    string(APPEND SUPPLE_PC_CFLAGS " -DSUPPLE_SHARED")
endif()
set(private "")
if(SUPPLE_WITH_MESHOPT)
    string(APPEND private " -lmeshoptimizer")
endif()
if(SUPPLE_WITH_DRACO)
    string(APPEND private " -ldraco")
endif()
foreach(library IN LISTS SUPPLE_CXX_LIBRARIES)
    string(APPEND private " -l${library}")
endforeach()
# Where the static library is the only one, everybody needs what it needs.
if("SHARED_LIBRARY" IN_LIST installed_kinds)
    set(SUPPLE_PC_LIBS "")
    set(SUPPLE_PC_LIBS_PRIVATE "${private}")
else()
    set(SUPPLE_PC_LIBS "${private}")
    set(SUPPLE_PC_LIBS_PRIVATE "")
endif()
configure_file(${supple_SOURCE_DIR}/cmake/supple.pc.in ${supple_BINARY_DIR}/supple.pc @ONLY)
install(FILES ${supple_BINARY_DIR}/supple.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

# ---- the command

if(TARGET supple_command)
    set_target_properties(supple_command PROPERTIES EXPORT_NAME command)
    if(SUPPLE_BUILD_SHARED AND UNIX AND NOT APPLE AND NOT CMAKE_INSTALL_RPATH)
        file(RELATIVE_PATH libraries /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
        set_target_properties(supple_command PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
    endif()
    install(TARGETS supple_command EXPORT suppleToolsTargets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    install(EXPORT suppleToolsTargets NAMESPACE supple:: DESTINATION ${config_directory} COMPONENT tools)
endif()
