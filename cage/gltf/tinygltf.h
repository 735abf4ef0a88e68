// tinygltf, as this folder uses it: a mapping from JSON to structs that opens no file and decodes no image.
// Private to cage/gltf/. The namespace is renamed so that a host may link its own tinygltf beside ours.
#pragma once

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#define tinygltf supple_tinygltf

#if defined(__GNUC__)
#pragma GCC system_header
#endif
#include <tiny_gltf.h>
