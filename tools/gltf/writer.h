// Writes a Character as GLB.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/still_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage {

struct GlbFile {
    std::vector<std::byte> bytes;
    uint32_t vertexCount = 0;          ///< glTF vertices: cage vertices, split where corners differ
    std::vector<std::string> warnings; ///< what was left out or repaired, one line each
};

/// Everything a Character holds, as one GLB; the same bytes for the same character.
///
/// A part has one primitive per material, in the order of their first faces; faces keep their order in it. Polygons,
/// creases, sharp vertices and holes go into SUPPLE_mesh_cage (docs/SUPPLE_mesh_cage.md), and the triangles
/// that other viewers show follow FB_ngon_encoding. Materials are those of glTF 2.0's core, with emissive strength,
/// unlit and texture transforms; extensions that Supple does not read are not written. Images that no material uses are
/// left out. So are images in a format that glTF does not know, and clips without channels, which glTF forbids; a
/// warning names them.
///
/// Springs and colliders go into VRMC_springBone; those of VRM 0.x as chains, with nodes for the tails of leaves.
///
/// The character is one that a reader made: indices in range, weights normalised, numbers finite. One without faces is
/// refused. Never throws. Errors are one line that begins with the character's name.
[[nodiscard]] Result<GlbFile> writeGlb(const Character& character);

/// Meshes as they are shown, one node each, with all materials of the character, whose images keep their bytes. There
/// is no skeleton, and nothing of SUPPLE_mesh_cage. A trim that needs faces of the cage (TrimDomain::face) is left out;
/// a warning names it. Meshes have at least one triangle in every entry, and name materials of the character. Never
/// throws; errors as above.
[[nodiscard]] Result<GlbFile> writeGlb(const Character& character, std::span<const StillMesh> meshes);

} // namespace supple::cage
