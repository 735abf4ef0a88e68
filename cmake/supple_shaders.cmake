# supple_embed_shaders(TARGET path...): compiles GLSL (paths below shaders/) to SPIR-V at build time and makes each available
# to TARGET as a header "shaders/<path with / and . as _>.h" that defines `static const uint32_t <that name>[]`. A path may end
# in +NAME: compiled with the macro NAME defined, and the name ends in _NAME.
find_program(SUPPLE_GLSLANG NAMES glslangValidator glslang REQUIRED)

function(supple_embed_shaders target)
    set(directory ${supple_BINARY_DIR}/generated)
    foreach(shader IN LISTS ARGN)
        string(MAKE_C_IDENTIFIER ${shader} name)
        set(defined)
        if(shader MATCHES "^(.*)[+](.*)$")
            set(shader ${CMAKE_MATCH_1})
            set(defined -D${CMAKE_MATCH_2})
        endif()
        set(source ${supple_SOURCE_DIR}/shaders/${shader})
        set(header ${directory}/shaders/${name}.h)
        file(MAKE_DIRECTORY ${directory}/shaders)
        add_custom_command(OUTPUT ${header}
            COMMAND ${SUPPLE_GLSLANG} --quiet -V --target-env vulkan1.3 ${defined} -I${supple_SOURCE_DIR}
                    --depfile ${header}.d --vn ${name} -o ${header} ${source}
            DEPENDS ${source} DEPFILE ${header}.d
            COMMENT "GLSL ${shader}" VERBATIM)
        target_sources(${target} PRIVATE ${header})
    endforeach()
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
