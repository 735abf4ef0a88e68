# Headers that many files read are parsed once, and ccache is used where it is installed: for builds of this project alone, so
# that a host that adds Supple with add_subdirectory keeps its own ways.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    find_program(SUPPLE_CCACHE ccache)
    mark_as_advanced(SUPPLE_CCACHE)
    if(SUPPLE_CCACHE)
        # ccache keeps a file that was compiled with a precompiled header only if it may trust its macros and time stamps.
        set(launcher ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${SUPPLE_CCACHE})
        set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
        set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
    endif()
endif()

# supple_precompile(NAME HEADERS...): a target with a precompiled header of its own.
function(supple_precompile name)
    if(PROJECT_IS_TOP_LEVEL)
        list(TRANSFORM ARGN REPLACE "(.+)" "$<$<COMPILE_LANGUAGE:CXX>:<\\1$<ANGLE-R>>")
        target_precompile_headers(${name} PRIVATE ${ARGN})
    endif()
endfunction()

# What most files of the library and its tools include.
set(SUPPLE_COMMON_HEADERS
    algorithm array cmath cstdint cstring functional map memory optional set span string unordered_map utility variant vector
    glm/glm.hpp)
