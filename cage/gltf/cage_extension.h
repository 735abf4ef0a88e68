// SUPPLE_mesh_cage of a glTF file: a primitive's polygons, cage vertices, creases and holes. Private to cage/gltf/. All
// of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/split/mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The accessors of a primitive's SUPPLE_mesh_cage, -1 where it has none. Those that come in pairs are both there or
/// neither, and holes come with polygons.
struct CageExtension {
    std::string element; ///< "mesh 0 primitive 0 SUPPLE_mesh_cage"
    int faceVertexCounts = -1;
    int faceVertexIndices = -1;
    int cageVertices = -1;
    int creaseIndices = -1;
    int creaseSharpnesses = -1;
    int cornerIndices = -1;
    int cornerSharpnesses = -1;
    int creaseScalarIndices = -1;
    int creaseScalars = -1;
    int holeIndices = -1;
    const Json* creaseSets = nullptr; ///< an array, if the file has it
    std::optional<UvMode> uvMode;     ///< faceVaryingLinearInterpolation, if the file says it
    bool roundCorners = false;        ///< interpolateBoundary: edgeOnly
    std::optional<MadeFor> madeFor;   ///< scheme, if the file says it
};

/// Warns of rules that surfaces here do not follow.
[[nodiscard]] std::optional<CageExtension> findCageExtension(const Document& document, const Json& primitive,
                                                             const std::string& element, Warnings& warnings);

/// Creases or corners as written.
using split::SharpList;
[[nodiscard]] SharpList readCreaseList(const Document& document, const CageExtension& extension);
[[nodiscard]] SharpList readCornerList(const Document& document, const CageExtension& extension);
/// Alphas instead of sharpnesses.
[[nodiscard]] SharpList readScalarList(const Document& document, const CageExtension& extension);
[[nodiscard]] std::vector<split::CreaseSet> readCreaseSets(const Document& document, const CageExtension& extension);

} // namespace supple::cage::gltf
