// Which of a mesh's split vertices are one cage vertex. Private to cage/split/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/message.h"
#include "cage/split/mesh.h"
#include "cage/weld.h"

#include <cstdint>
#include <vector>

namespace supple::cage::split {

struct MeshWelding {
    Welding welding;
    WeldSource source = WeldSource::equality;
    /// Vertices of equal position that differ in something else.
    struct Disagreement {
        uint32_t a = 0; ///< the smaller one
        uint32_t b = 0;
        bool inSkin = false; ///< else in morph targets
    };
    std::vector<Disagreement> disagreements; ///< where welded by equality
    std::vector<uint32_t> places;            ///< per vertex: the same number where positions are equal
};

/// The cage vertices the mesh gives, else the merges that it lists, else by sewing `faces` where position, skin and
/// morph targets are equal. What the source merges itself must agree in position; where skin or morph targets differ
/// there is a warning.
[[nodiscard]] MeshWelding weldMesh(const Mesh& mesh, const Polygons& faces, Warnings& warnings);

/// Where welded by equality: sews edges of `faces` whose ends agree in position alone, so that no seam of a skin tears
/// the surface. The cage vertex has the skin and the morph targets of its first vertex. What is sewn is damage, what
/// stays apart a warning.
void joinSeams(const Mesh& mesh, const Polygons& faces, MeshWelding& welded, Warnings& warnings,
               std::vector<Damage>& damages);

} // namespace supple::cage::split
