# For Windows, from Debian, by MinGW-w64 with its POSIX threads (which std::mutex and the like need):
#   cmake -S . -B build/mingw --toolchain cmake/mingw-w64.cmake -DSUPPLE_WITH_MESHOPT=OFF -DSUPPLE_WITH_DRACO=OFF
# Debian has no meshoptimizer and no Draco for Windows. Libraries of headers alone are as good there as here: links to them are laid
# into the build folder, since all of /usr/include would bring Linux's own headers with it.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(_headers ${CMAKE_BINARY_DIR}/mingw-headers)
file(MAKE_DIRECTORY ${_headers}/include ${_headers}/share/cmake)
foreach(_header glm vulkan vk_video nlohmann xxhash.h)
    if(EXISTS /usr/include/${_header} AND NOT EXISTS ${_headers}/include/${_header})
        file(CREATE_LINK /usr/include/${_header} ${_headers}/include/${_header} SYMBOLIC)
    endif()
endforeach()
# A copy: its paths start from where it lies.
if(EXISTS /usr/share/cmake/glm AND NOT EXISTS ${_headers}/share/cmake/glm)
    file(COPY /usr/share/cmake/glm DESTINATION ${_headers}/share/cmake)
endif()

set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 ${_headers})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
