# supple_embed_kernels(TARGET [SHARED] path...): compiles GLSL (paths below shaders/) to SPIR-V at build time, for either mapping
# (shaders/shared/mapping.glsl) and, if SHARED, for dispatches that groups share (shaders/shared/task.glsl), optimized, and makes
# each available to TARGET as a header
# "shaders/<path with / and . as _>.h" that defines a `gpu::Spirv` of that name. A path may end in +NAME: compiled with the macro
# NAME defined, and the name ends in _NAME; +NAME+OTHER: with both.
# supple_kernel_table(TARGET NAMESPACE path...): of kernels that TARGET embeds, makes "NAMESPACE/kernels.h" with
# `enum class supple::NAMESPACE::Kernel`, an enumerator for each and `count`, and defines `Shaders::embedded()`, their table
# (NAMESPACE/shaders.h). "evaluate/bicubic.comp+LEVELS" is the enumerator evaluateBicubicLevels.
# With SUPPLE_COMPILED_SHADERS, the folder "generated" of another build of the same sources, nothing is compiled: the arrays of that
# build are taken.
# As a script (-DNAME= -DSPIRV= -DOUT=) it writes a header of such an array from a file of SPIR-V.
if(CMAKE_SCRIPT_MODE_FILE)
    file(READ "${SPIRV}" words HEX)
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${words}")
    string(REGEX REPLACE "(0x........,0x........,0x........,0x........,0x........,0x........,0x........,0x........,)" "\\1\n"
        words "${words}")
    file(WRITE "${OUT}" "#pragma once\n#include <cstdint>\n\nstatic const uint32_t ${NAME}[] = {\n${words}};\n")
    return()
endif()

set(SUPPLE_COMPILED_SHADERS "" CACHE PATH "The folder \"generated\" of another build of the same sources, whose shaders are taken")
if(NOT SUPPLE_COMPILED_SHADERS)
    find_program(SUPPLE_GLSLANG NAMES glslangValidator glslang REQUIRED)
    find_program(SUPPLE_SPIRV_OPT NAMES spirv-opt REQUIRED)
endif()

# The oldest version that kernels run on. From SPIR-V 1.6 on, workgroup sizes by specialization constants would need maintenance4.
set(SUPPLE_SPIRV_TARGET vulkan1.1)

# Drivers inline all functions before they look at constants: code that is never taken, and every early return, would cost
# time whenever a pipeline is made. And a driver keeps an array in memory until it has unrolled the loops that index it. These
# passes unroll and inline nearly all of it once, at build time, and throw away what is dead. None computes with floats in
# another way than the shader says: simplify-instructions, which -O has, would.
# loop-unroll forgets NoContraction in the copies that it makes, but inlining keeps it. So unrolling comes first, and loops to be
# unrolled call functions for what is precise (tests/runtime/precise_test.cpp).
set(SUPPLE_SPIRV_PASSES
    --eliminate-local-single-block --eliminate-local-single-store --ssa-rewrite --loop-unroll --ccp
    --eliminate-dead-branches --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions --private-to-local
    --scalar-replacement=100 --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store
    --ssa-rewrite --ccp --eliminate-dead-branches
    --scalar-replacement=100 --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store
    --ssa-rewrite --ccp --eliminate-dead-branches --eliminate-dead-code-aggressive --merge-blocks
    --redundancy-elimination --eliminate-dead-code-aggressive)

set(supple_shader_script ${CMAKE_CURRENT_LIST_FILE})

# Of `path+NAME...`: the file, the name of the array, what it is compiled for and compiler flags, in shader_source, shader_name,
# shader_target and shader_flags. Buffers by address, which shared dispatches read, are of Vulkan 1.2.
macro(supple_shader_entry entry)
    string(MAKE_C_IDENTIFIER ${entry} shader_name)
    string(REPLACE "+" ";-D" shader_flags ${entry})
    list(POP_FRONT shader_flags shader_source)
    set(shader_source ${supple_SOURCE_DIR}/shaders/${shader_source})
    set(shader_target ${SUPPLE_SPIRV_TARGET})
    if("${entry}" MATCHES "[+]TASKS")
        set(shader_target vulkan1.2)
    endif()
    list(PREPEND shader_flags --quiet -V --target-env ${shader_target} -I${supple_SOURCE_DIR})
endmacro()

function(supple_embed_kernels target)
    cmake_parse_arguments(arg "SHARED" "" "" ${ARGN})
    set(directory ${supple_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${directory}/shaders)
    set(forms NARROW WIDE)
    if(arg_SHARED)
        list(APPEND forms WIDE+TASKS)
    endif()
    foreach(entry IN LISTS arg_UNPARSED_ARGUMENTS)
        set(includes "")
        set(arrays "")
        foreach(form IN LISTS forms)
            supple_shader_entry(${entry}+${form})
            list(APPEND arrays ${shader_name})
            string(APPEND includes "#include \"shaders/${shader_name}.h\"\n")
            if(SUPPLE_COMPILED_SHADERS)
                continue()
            endif()
            set(base ${directory}/shaders/${shader_name})
            # The SPIR-V comes first: it is what the dependencies that glslang writes are of.
            add_custom_command(OUTPUT ${base}.spv ${base}.h
                COMMAND ${SUPPLE_GLSLANG} ${shader_flags} --depfile ${base}.d -o ${base}.spv ${shader_source}
                COMMAND ${SUPPLE_SPIRV_OPT} --target-env=${shader_target} ${SUPPLE_SPIRV_PASSES} ${base}.spv
                        -o ${base}.opt.spv
                COMMAND ${CMAKE_COMMAND} -DNAME=${shader_name} -DSPIRV=${base}.opt.spv -DOUT=${base}.h
                        -P ${supple_shader_script}
                DEPENDS ${shader_source} ${supple_shader_script} DEPFILE ${base}.d
                COMMENT "GLSL ${entry}+${form}" VERBATIM)
            target_sources(${target} PRIVATE ${base}.h)
        endforeach()
        string(MAKE_C_IDENTIFIER ${entry} name)
        list(JOIN arrays ", " arrays)
        file(CONFIGURE OUTPUT ${directory}/shaders/${name}.h CONTENT "// Made by cmake/supple_shaders.cmake.
#pragma once
#include \"gpu/spirv.h\"
${includes}
static const supple::gpu::Spirv ${name}{${arrays}};
" @ONLY)
    endforeach()
    target_include_directories(${target} PRIVATE ${directory})
    if(SUPPLE_COMPILED_SHADERS)
        target_include_directories(${target} PRIVATE ${SUPPLE_COMPILED_SHADERS})
    endif()
endfunction()

function(supple_kernel_table target namespace)
    set(directory ${supple_BINARY_DIR}/generated)
    set(enumerators "")
    set(includes "")
    set(table "")
    set(names "")
    foreach(entry IN LISTS ARGN)
        string(REGEX REPLACE "[./+_]" ";" words ${entry})
        list(REMOVE_ITEM words comp)
        list(POP_FRONT words enumerator)
        foreach(word IN LISTS words)
            string(SUBSTRING ${word} 0 1 initial)
            string(SUBSTRING ${word} 1 -1 rest)
            string(TOUPPER ${initial} initial)
            string(TOLOWER ${rest} rest)
            string(APPEND enumerator ${initial}${rest})
        endforeach()
        string(MAKE_C_IDENTIFIER ${entry} name)
        string(APPEND enumerators "    ${enumerator},\n")
        string(APPEND includes "#include \"shaders/${name}.h\"\n")
        string(APPEND table "        ${name},\n")
        string(APPEND names "    \"${entry}\",\n")
    endforeach()
    file(CONFIGURE OUTPUT ${directory}/${namespace}/kernels.h CONTENT "// Made by cmake/supple_shaders.cmake.
#pragma once

#include <cstdint>

namespace supple::${namespace} {

enum class Kernel : uint32_t {
${enumerators}    count
};

/// What a kernel is called in CMake's list, which outlives its number: \"pm/vertex.comp\". It must be a kernel.
const char* nameOf(Kernel kernel);

} // namespace supple::${namespace}
" @ONLY)
    file(CONFIGURE OUTPUT ${directory}/${namespace}/kernels.cpp CONTENT "// Made by cmake/supple_shaders.cmake.
#include \"${namespace}/shaders.h\"

${includes}
namespace supple::${namespace} {

Shaders Shaders::embedded() {
    return {{{
${table}    }}};
}

const char* nameOf(Kernel kernel) {
    static constexpr const char* kNames[] = {
${names}    };
    return kNames[static_cast<uint32_t>(kernel)];
}

} // namespace supple::${namespace}
" @ONLY)
    target_sources(${target} PRIVATE ${directory}/${namespace}/kernels.cpp)
    target_include_directories(${target} PUBLIC ${directory})
endfunction()
