# For Windows, from Debian, by MinGW-w64 with its POSIX threads (which std::mutex and the like need). The preset `windows` uses it.
# Libraries lie in SUPPLE_WINDOWS_LIBRARIES, where tools/windows_libraries.sh builds them. Libraries of headers alone are as good
# there as here: links to them are laid into the build folder, since all of /usr/include would bring Linux's own headers with it.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(_headers ${CMAKE_BINARY_DIR}/mingw-headers)
file(MAKE_DIRECTORY ${_headers}/include ${_headers}/share/cmake)
foreach(_header glm vulkan vk_video nlohmann xxhash.h CLI nanoflann.hpp stb)
    if(EXISTS /usr/include/${_header} AND NOT EXISTS ${_headers}/include/${_header})
        file(CREATE_LINK /usr/include/${_header} ${_headers}/include/${_header} SYMBOLIC)
    endif()
endforeach()
# Copies: their paths start from where they lie.
foreach(_package CLI11 glm nlohmann_json)
    if(EXISTS /usr/share/cmake/${_package} AND NOT EXISTS ${_headers}/share/cmake/${_package})
        file(COPY /usr/share/cmake/${_package} DESTINATION ${_headers}/share/cmake)
    endif()
endforeach()

set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SUPPLE_WINDOWS_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH ${SUPPLE_WINDOWS_LIBRARIES} ${CMAKE_PREFIX_PATH} /usr/x86_64-w64-mingw32 ${_headers})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
