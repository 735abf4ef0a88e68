# supple_embed_files(TARGET HEADER NAME=file...): makes the bytes of each file available to TARGET in a header
# "generated-name.h" of arrays `static const uint8_t <NAME>[]`.
# As a script (-DOUT= -DFILES=NAME=file;..) it writes that header: that is how the build calls it.
if(CMAKE_SCRIPT_MODE_FILE)
    set(text "// Made by cmake/supple_embed_file.cmake.\n#pragma once\n\n#include <cstdint>\n")
    foreach(entry IN LISTS FILES)
        string(REGEX MATCH "^([^=]+)=(.*)$" _ "${entry}")
        set(name ${CMAKE_MATCH_1})
        file(READ "${CMAKE_MATCH_2}" bytes HEX)
        string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
        string(REGEX REPLACE "(........................................)" "\\1\n" bytes "${bytes}")
        string(APPEND text "\nstatic const uint8_t ${name}[] = {\n${bytes}};\n")
    endforeach()
    file(WRITE "${OUT}" "${text}")
    return()
endif()

set(supple_embed_script ${CMAKE_CURRENT_LIST_FILE})
function(supple_embed_files target header)
    set(directory ${supple_BINARY_DIR}/generated)
    set(files "")
    foreach(entry IN LISTS ARGN)
        string(REGEX REPLACE "^[^=]+=" "" file "${entry}")
        list(APPEND files ${file})
    endforeach()
    add_custom_command(OUTPUT ${directory}/${header}
        COMMAND ${CMAKE_COMMAND} -DOUT=${directory}/${header} "-DFILES=${ARGN}" -P ${supple_embed_script}
        DEPENDS ${files} ${supple_embed_script}
        COMMENT "Embedding ${header}" VERBATIM)
    target_sources(${target} PRIVATE ${directory}/${header})
    target_include_directories(${target} PRIVATE ${directory})
endfunction()
