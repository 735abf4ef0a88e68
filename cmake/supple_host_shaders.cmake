# supple_host_shaders(TARGET path...): compiles GLSL (paths below the current source folder) as the build of a host does: with
# ${supple_SHADER_DIR} to find what Supple has for hosts. A shader becomes the header "shaders/<file with . as _>.h" of TARGET,
# which defines `const uint32_t <that name>[]`. A path may end in +NAME: compiled with the macro NAME, which the name ends in.
# For Vulkan 1.2, as compute shaders that are compiled for 1.3 need maintenance4.
function(supple_host_shaders target)
    find_program(SUPPLE_GLSLANG NAMES glslangValidator glslang REQUIRED) # not looked for with SUPPLE_COMPILED_SHADERS
    set(directory ${CMAKE_CURRENT_BINARY_DIR}/generated)
    file(MAKE_DIRECTORY ${directory}/shaders)
    foreach(entry IN LISTS ARGN)
        string(REPLACE "+" ";-D" flags ${entry})
        list(POP_FRONT flags path)
        get_filename_component(source ${path} ABSOLUTE)
        get_filename_component(file ${entry} NAME)
        string(MAKE_C_IDENTIFIER ${file} variable)
        set(header ${directory}/shaders/${variable}.h)
        add_custom_command(OUTPUT ${header}
            COMMAND ${SUPPLE_GLSLANG} --quiet -V --target-env vulkan1.2 -I${supple_SHADER_DIR} ${flags}
                    --depfile ${header}.d --vn ${variable} -o ${header} ${source}
            DEPENDS ${source} DEPFILE ${header}.d
            COMMENT "GLSL ${target}/${file}" VERBATIM)
        target_sources(${target} PRIVATE ${header})
    endforeach()
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
