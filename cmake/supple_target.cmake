# supple_target(NAME): the settings every target of the project shares. No global flags, so that a host that adds Supple
# with add_subdirectory keeps its own; and a host's own flags do not change what is compiled here: without exceptions or
# run-time types in its own code, with another standard or with fast arithmetic, it gets the same library.
function(supple_target name)
    target_compile_features(${name} PRIVATE cxx_std_20)
    set_target_properties(${name} PROPERTIES
        CXX_STANDARD 20 CXX_EXTENSIONS OFF C_STANDARD 99 C_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON
        UNITY_BUILD ${SUPPLE_UNITY_BUILD} UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE ${SUPPLE_UNITY_BATCH}
        CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    # The public library shows hosts its own include folder alone.
    target_include_directories(${name} PRIVATE ${supple_SOURCE_DIR})
    if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        # Vulkan structs are begun with their sType alone; the rest is zero by the language.
        target_compile_options(${name} PRIVATE -Wall -Wextra -Werror -Wno-missing-field-initializers)
        # GCC 12 sees copies inside std::string that overlap, or go too far, where there are none (GCC bug 105651).
        target_compile_options(${name} PRIVATE
            $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>)
        supple_collect_late(${name})
    endif()
    # Reference arithmetic must round as written: bit-exact edges are tested against it.
    if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>)
        if(NOT PROJECT_IS_TOP_LEVEL)
            target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fexceptions;-frtti;-fno-fast-math>)
        endif()
    elseif(MSVC)
        target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:/EHsc;/GR;/fp:precise>)
    endif()
endfunction()

# supple_collect_late(NAME): GCC collects its own garbage from a gigabyte on only. A batch takes a tenth less time so, and the
# largest needs 1.3 GB in place of 1.0 GB.
function(supple_collect_late name)
    if(SUPPLE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${name} PRIVATE --param=ggc-min-heapsize=1048576)
    endif()
endfunction()

# supple_built_soon(NAME): for targets whose own code has no work worth optimizing: tests, samples, the command. Compiling
# them takes most of a build. With sanitizers a batch of tests took GCC minutes and gigabytes.
function(supple_built_soon name)
    if(NOT PROJECT_IS_TOP_LEVEL OR NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        return()
    endif()
    if(CMAKE_BUILD_TYPE STREQUAL "Release" OR CMAKE_CXX_FLAGS MATCHES "-fsanitize=")
        # With so little inlined GCC 12 sees strings end where they do not (GCC bug 105651 again).
        set(gnu $<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>)
        target_compile_options(${name} PRIVATE
            -O1 $<${gnu}:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>)
    endif()
endfunction()
