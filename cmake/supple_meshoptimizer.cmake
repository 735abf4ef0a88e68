# meshoptimizer::meshoptimizer, from its own package where that brings one, else from where header and library lie. Used by
# the build, and installed for hosts of the static library.
if(NOT TARGET meshoptimizer::meshoptimizer)
    find_package(meshoptimizer CONFIG QUIET)
endif()
if(NOT TARGET meshoptimizer::meshoptimizer)
    find_path(SUPPLE_MESHOPTIMIZER_INCLUDE meshoptimizer.h)
    find_library(SUPPLE_MESHOPTIMIZER_LIBRARY meshoptimizer)
    mark_as_advanced(SUPPLE_MESHOPTIMIZER_INCLUDE SUPPLE_MESHOPTIMIZER_LIBRARY)
    if(SUPPLE_MESHOPTIMIZER_INCLUDE AND SUPPLE_MESHOPTIMIZER_LIBRARY)
        add_library(meshoptimizer::meshoptimizer UNKNOWN IMPORTED)
        set_target_properties(meshoptimizer::meshoptimizer PROPERTIES
            IMPORTED_LOCATION ${SUPPLE_MESHOPTIMIZER_LIBRARY}
            INTERFACE_INCLUDE_DIRECTORIES ${SUPPLE_MESHOPTIMIZER_INCLUDE})
    endif()
endif()
