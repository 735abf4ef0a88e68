// Where a glTF primitive's polygons come from. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/cage_extension.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/polygons.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

using split::PolygonData;

/// Looks at the sources in the order of PolygonSource. One that is malformed is refused by name; one of a form that is
/// not understood is passed over with a warning. `triangles` and the polygons count the primitive's own vertices.
/// Throws Refusal.
[[nodiscard]] PolygonData readPolygons(const Document& document, const Json& primitive, int mode,
                                       const std::optional<CageExtension>& extension,
                                       std::span<const uint32_t> triangles, size_t vertexCount,
                                       const std::string& element, Warnings& warnings);

} // namespace supple::cage::gltf
