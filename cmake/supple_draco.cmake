# draco::draco, from its own package where that brings one, else from where headers and library lie. Used by the build, and
# installed for hosts of the static library.
if(NOT TARGET draco::draco)
    find_package(draco CONFIG QUIET)
endif()
if(NOT TARGET draco::draco)
    find_path(SUPPLE_DRACO_INCLUDE draco/compression/decode.h)
    find_library(SUPPLE_DRACO_LIBRARY draco)
    mark_as_advanced(SUPPLE_DRACO_INCLUDE SUPPLE_DRACO_LIBRARY)
    if(SUPPLE_DRACO_INCLUDE AND SUPPLE_DRACO_LIBRARY)
        add_library(draco::draco UNKNOWN IMPORTED)
        set_target_properties(draco::draco PROPERTIES
            IMPORTED_LOCATION ${SUPPLE_DRACO_LIBRARY}
            INTERFACE_INCLUDE_DIRECTORIES ${SUPPLE_DRACO_INCLUDE})
    endif()
endif()
