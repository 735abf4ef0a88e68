# tinygltf, for the tests and the sample of supple_tinygltf.hpp. The library does not need it.
find_path(SUPPLE_TINYGLTF_INCLUDE tiny_gltf.h)
find_library(SUPPLE_TINYGLTF_LIBRARY tinygltf)
mark_as_advanced(SUPPLE_TINYGLTF_INCLUDE SUPPLE_TINYGLTF_LIBRARY)
