# The target `docs` makes a page of the public API from the headers' comments: docs/api.md in the build folder.
find_package(Python3 COMPONENTS Interpreter QUIET)
find_program(SUPPLE_DOXYGEN doxygen)
mark_as_advanced(SUPPLE_DOXYGEN)
if(NOT SUPPLE_DOXYGEN OR NOT Python3_FOUND)
    message(STATUS "There is no target docs: doxygen and Python are not both installed")
    return()
endif()
add_custom_target(docs COMMAND ${Python3_EXECUTABLE} ${supple_SOURCE_DIR}/tools/api_docs.py ${supple_BINARY_DIR}/docs/api.md)
