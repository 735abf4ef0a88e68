// What supple bake has evaluated, as meshes of vertices that patches share.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/polygons.h"
#include "cage/still_mesh.h"
#include "tools/supple/evaluation.h"
#include "tools/supple/vertex_pool.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::tools {

/// What a file has a place for. What the character lacks is left out anyway.
struct BakedContent {
    bool polygons = false; ///< quads where the grid has them, and the polygons of a cage; else triangles alone
    bool uvs1 = false;     ///< the second UV set too
};

/// The faces of one part and one material. The flags say what its vertices have besides positions and normals.
struct BakedMesh {
    uint32_t part = 0;
    uint32_t material = cage::kNone;
    bool uvs[2] = {false, false};
    bool colors = false;
    bool tangents = false;
    std::vector<BakedVertex> vertices;
    cage::Polygons faces;
};

/// The faces of a patch's grid as samples: as the device draws them, or with quads on quads.
[[nodiscard]] cage::Polygons gridFaces(const EvaluatedSurface& surface, const SuppleDrawRange& range, bool quads);

/// Turns the corners of a face round. The first stays the first.
void turnRound(std::span<uint32_t> corners);

/// Linear RGBA, 65535 is 1.
[[nodiscard]] std::array<uint16_t, 4> bakedColor(const BakedVertex& vertex);

/// All surfaces, part by part, in each part by material. Vertices that patches of a mesh have in common are there once.
/// Faces that have less than three vertices then are left out. Normals have unit length: one that vanishes is made from
/// the faces round it. Tangents are those that the group was made with. The error names the part of a position that is
/// not finite.
[[nodiscard]] Result<std::vector<BakedMesh>> bakedSurfaces(const Evaluation& baked, const cage::Character& character,
                                                           const BakedContent& content);

/// The same of the deformed cage itself. Its normals are the file's in the rest pose, else those of its faces.
[[nodiscard]] Result<std::vector<BakedMesh>> bakedCage(const Evaluation& baked, const cage::Character& character,
                                                       const BakedContent& content);

/// For a GLB: the character's parts that have faces, in its order. The meshes have triangles alone.
[[nodiscard]] std::vector<cage::StillMesh> stillMeshes(std::vector<BakedMesh> meshes, const cage::Character& character);

} // namespace supple::tools
