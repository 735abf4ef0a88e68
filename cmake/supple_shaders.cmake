# supple_embed_shaders(TARGET path...): compiles GLSL (paths below shaders/) to SPIR-V at build time and makes each available
# to TARGET as a header "shaders/<path with / and . as _>.h" that defines `static const uint32_t <that name>[]`. A path may end
# in +NAME: compiled with the macro NAME defined, and the name ends in _NAME; +NAME+OTHER: with both.
# supple_embed_kernels(TARGET path...): the same for the library's own kernels, which are compiled for either mapping
# (shaders/shared/mapping.glsl) and optimized: the name is a `gpu::Spirv`.
# As a script (-DNAME= -DSPIRV= -DOUT=) it writes a header of such an array from a file of SPIR-V.
if(CMAKE_SCRIPT_MODE_FILE)
    file(READ "${SPIRV}" words HEX)
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${words}")
    string(REGEX REPLACE "(0x........,0x........,0x........,0x........,0x........,0x........,0x........,0x........,)" "\\1\n"
        words "${words}")
    file(WRITE "${OUT}" "#pragma once\n#include <cstdint>\n\nstatic const uint32_t ${NAME}[] = {\n${words}};\n")
    return()
endif()

find_program(SUPPLE_GLSLANG NAMES glslangValidator glslang REQUIRED)
find_program(SUPPLE_SPIRV_OPT NAMES spirv-opt REQUIRED)

# Drivers inline all functions before they look at constants: code that is never taken, and every early return, would cost
# time whenever a pipeline is made. These passes inline it all once, at build time, and throw away what is dead. None computes
# with floats in another way than the shader says: simplify-instructions, which -O has, would.
set(SUPPLE_SPIRV_PASSES
    --eliminate-dead-branches --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions
    --scalar-replacement=100 --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store
    --ssa-rewrite --ccp --eliminate-dead-branches --eliminate-dead-code-aggressive --merge-blocks
    --redundancy-elimination --eliminate-dead-code-aggressive)

set(supple_shader_script ${CMAKE_CURRENT_LIST_FILE})

# Of `path+NAME...`: the file, the name of the array, and compiler flags, in shader_source, shader_name and shader_flags.
macro(supple_shader_entry entry)
    string(MAKE_C_IDENTIFIER ${entry} shader_name)
    string(REPLACE "+" ";-D" shader_flags ${entry})
    list(POP_FRONT shader_flags shader_source)
    set(shader_source ${supple_SOURCE_DIR}/shaders/${shader_source})
    list(PREPEND shader_flags --quiet -V --target-env vulkan1.3 -I${supple_SOURCE_DIR})
endmacro()

function(supple_embed_shaders target)
    set(directory ${supple_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${directory}/shaders)
    foreach(entry IN LISTS ARGN)
        supple_shader_entry(${entry})
        set(header ${directory}/shaders/${shader_name}.h)
        add_custom_command(OUTPUT ${header}
            COMMAND ${SUPPLE_GLSLANG} ${shader_flags} --depfile ${header}.d --vn ${shader_name} -o ${header} ${shader_source}
            DEPENDS ${shader_source} DEPFILE ${header}.d
            COMMENT "GLSL ${entry}" VERBATIM)
        target_sources(${target} PRIVATE ${header})
    endforeach()
    target_include_directories(${target} PRIVATE ${directory})
endfunction()

function(supple_embed_kernels target)
    set(directory ${supple_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${directory}/shaders)
    foreach(entry IN LISTS ARGN)
        set(includes "")
        foreach(mapping NARROW WIDE)
            supple_shader_entry(${entry}+${mapping})
            set(base ${directory}/shaders/${shader_name})
            add_custom_command(OUTPUT ${base}.h
                COMMAND ${SUPPLE_GLSLANG} ${shader_flags} --depfile ${base}.d -o ${base}.spv ${shader_source}
                COMMAND ${SUPPLE_SPIRV_OPT} --target-env=vulkan1.3 --scalar-block-layout ${SUPPLE_SPIRV_PASSES} ${base}.spv
                        -o ${base}.opt.spv
                COMMAND ${CMAKE_COMMAND} -DNAME=${shader_name} -DSPIRV=${base}.opt.spv -DOUT=${base}.h
                        -P ${supple_shader_script}
                DEPENDS ${shader_source} ${supple_shader_script} DEPFILE ${base}.d
                COMMENT "GLSL ${entry}+${mapping}" VERBATIM)
            target_sources(${target} PRIVATE ${base}.h)
            string(APPEND includes "#include \"shaders/${shader_name}.h\"\n")
        endforeach()
        string(MAKE_C_IDENTIFIER ${entry} name)
        file(CONFIGURE OUTPUT ${directory}/shaders/${name}.h CONTENT "// Made by cmake/supple_shaders.cmake.
#pragma once
#include \"gpu/spirv.h\"
${includes}
static const supple::gpu::Spirv ${name}{${name}_NARROW, ${name}_WIDE};
" @ONLY)
    endforeach()
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
