// A mesh of a glTF file as the file has it: vertices, triangles, attributes; nothing welded. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/polygons.h"
#include "cage/gltf/skin.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// What is read of one primitive.
struct MeshPrimitive {
    std::string element;
    int material = -1;
    int positionAccessor = -1;
    std::optional<CageExtension> extension;
    PolygonData faces;        ///< vertices counted as in `triangles`
    uint32_t firstVertex = 0; ///< of its POSITION elements among all vertices read
    uint32_t vertexCount = 0;
    std::vector<uint32_t> triangles; ///< three vertices each, counted over all primitives
    std::vector<float> uvs;          ///< two per POSITION element, or empty
    std::vector<float> uvs1;         ///< two per POSITION element, or empty
    std::vector<float> colors;       ///< four per POSITION element, or empty
    std::vector<glm::vec3> normals;  ///< one per POSITION element, or empty; zero: none
    std::vector<glm::vec4> tangents; ///< one per POSITION element, or empty; zero: none
    std::vector<uint32_t> trimTiles; ///< per POSITION element: kNone for no tile; or empty
};

/// Primitives over the same accessors share their vertices.
struct Mesh {
    size_t index = 0; ///< among the file's meshes
    std::string element;
    std::vector<glm::vec3> positions;
    VertexWeights weights;
    VertexMorphs morphs;
    std::vector<uint32_t> cageNumbers; ///< per vertex, where the file numbers cage vertices; else empty
    WeldSource numberSource = WeldSource::cageExtension; ///< of cageNumbers
    std::vector<MeshPrimitive> primitives;               ///< at least one
};

/// Primitives of points and lines are left out with a warning; nothing comes back if no others are there. Throws
/// Refusal.
[[nodiscard]] std::optional<Mesh> readMesh(const Document& document, uint32_t meshNode, size_t jointCount,
                                           std::span<const Material> materials, Warnings& warnings);

/// What a mesh without triangles is.
[[nodiscard]] std::string nameOfNoTriangles(const file::Mesh& mesh);

} // namespace supple::cage::gltf
