// The triangles of a glTF primitive, in any of the modes that have triangles. Private to cage/gltf/.
#pragma once

#include "cage/gltf/document.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// TRIANGLES, TRIANGLE_STRIP or TRIANGLE_FAN.
[[nodiscard]] bool hasTriangles(int mode);
/// Whether something is drawn of a primitive. glTF allows one without positions, and it is skipped.
[[nodiscard]] bool isDrawn(const file::Primitive& primitive);
/// As glTF writes a mode that it knows.
[[nodiscard]] const char* modeName(int mode);

/// Three vertices of the primitive for each triangle, wound as glTF 2.0 says. A strip's triangles that repeat an index
/// draw nothing, and only lead from one place to another: they are left out. The extensions of restart values end a
/// strip or fan. Throws Refusal.
[[nodiscard]] std::vector<uint32_t> readTriangles(const Document& document, const file::Primitive& primitive,
                                                  uint32_t vertexCount, const std::string& element);

} // namespace supple::cage::gltf
