# Debian packages by CPack, one an install component. tools/package.sh makes and checks them.
set(SUPPLE_MAINTAINER "The Supple authors <supple@localhost>" CACHE STRING "Name and address in the packages")

set(library_package libsupple${SUPPLE_ABI})
set(revision 1)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME supple)
set(CPACK_PACKAGE_VENDOR "The Supple authors")
set(CPACK_PACKAGE_CONTACT ${SUPPLE_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime development)
if(TARGET supple_command)
    list(APPEND CPACK_COMPONENTS_ALL tools)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${revision})
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${supple_BINARY_DIR}/runtime)
set(about "Supple deforms animated control cages (glTF characters of a few thousand
polygons) and makes smooth surfaces of them in Vulkan compute, recorded into
the host's own command buffer.")
set(this_version "(= ${PROJECT_VERSION}-${revision})")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
file(WRITE ${supple_BINARY_DIR}/debian/shlibs "libsupple ${SUPPLE_ABI} ${library_package} (>= ${PROJECT_VERSION})\n")
file(WRITE ${supple_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
    ${supple_BINARY_DIR}/debian/shlibs ${supple_BINARY_DIR}/debian/triggers)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${about}\n\nThis package has the shared library.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsupple-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} ${this_version}, libvulkan-dev")
if(SUPPLE_WITH_MESHOPT)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libmeshoptimizer-dev")
endif()
if(SUPPLE_WITH_DRACO)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libdraco-dev")
endif()
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${about}\n\nThis package has headers for C and C++, the static library, what CMake and\npkg-config ask for, and GLSL for a host's shaders.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME supple-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
if(SUPPLE_BUILD_SHARED)
    set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${library_package} ${this_version}")
endif()
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "${about}\n\nThis package has the supple command: it inspects, converts, bakes, renders,\nmeasures and shows characters.")

# What Debian wants beside each package's files: only where packages are the purpose.
option(SUPPLE_DEBIAN_DOCS "Install copyright and changelog as Debian packages have them" OFF)
if(SUPPLE_DEBIAN_DOCS)
    string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
    set(changelog ${supple_BINARY_DIR}/debian/changelog.Debian)
    file(WRITE ${changelog} "supple (${PROJECT_VERSION}-${revision}) unstable; urgency=medium\n\n"
        "  * Version ${PROJECT_VERSION}; changelog.gz has its changes.\n\n -- ${SUPPLE_MAINTAINER}  ${date}\n")
    configure_file(CHANGELOG.md ${supple_BINARY_DIR}/debian/changelog COPYONLY)
    execute_process(COMMAND gzip -9nkf changelog changelog.Debian
        WORKING_DIRECTORY ${supple_BINARY_DIR}/debian COMMAND_ERROR_IS_FATAL ANY)
    set(package_runtime ${library_package})
    set(package_development libsupple-dev)
    set(package_tools supple-tools)
    foreach(component IN LISTS CPACK_COMPONENTS_ALL)
        install(FILES cmake/debian/copyright ${changelog}.gz ${supple_BINARY_DIR}/debian/changelog.gz
            DESTINATION share/doc/${package_${component}} COMPONENT ${component})
    endforeach()
    if(TARGET supple_command)
        configure_file(docs/supple.1 ${supple_BINARY_DIR}/debian/supple.1 COPYONLY)
        execute_process(COMMAND gzip -9nkf supple.1
            WORKING_DIRECTORY ${supple_BINARY_DIR}/debian COMMAND_ERROR_IS_FATAL ANY)
        install(FILES ${supple_BINARY_DIR}/debian/supple.1.gz DESTINATION share/man/man1 COMPONENT tools)
    endif()
endif()

include(CPack)
