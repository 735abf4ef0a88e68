// Reads .gltf and .glb into a Character.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/clip_set.h"
#include "cage/file_reader.h"
#include "cage/normal_creases.h"
#include "cage/skeleton.h"
#include "cage/split/cage.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::cage {

/// A glTF file whose clips a character takes.
struct ClipFile {
    std::string name;                 ///< begins messages about it
    std::span<const std::byte> bytes; ///< needed while the character is read
    std::string baseDirectory;        ///< as readGltf()'s
    FileReader readFile;              ///< as GltfOptions::readFile
};

struct GltfOptions {
    /// Which scene's meshes are read: the file's own choice if it is not given.
    std::optional<uint32_t> scene;
    /// Which of KHR_materials_variants the materials are; empty: the file's own. The error lists the variants there
    /// are.
    std::string variant;
    /// Sew parts together where their boundaries coincide.
    bool sewParts = true;
    /// Make vertices of a part of an OBJ file one where they lie in one place (cage/obj/reader.h).
    bool weldObj = true;
    /// Whether triangles are paired into quads where the file carries no polygons.
    Pairing pairing = Pairing::whereClean;
    /// Which edges with split normals become infinitely sharp.
    NormalCreases normalCreases = NormalCreases::never;
    /// Refuse a file with faults (cage/leniency.h), and a damaged cage (cage/repair.h), instead of mending them. The
    /// error has one line for each fault and each kind of damage.
    bool strict = false;
    /// Most bytes that reading a file may take; 0: kBaseMemory, and kMemoryPerByte for each of its own
    /// (cage/memory_budget.h).
    uint64_t memoryLimit = 0;
    /// Where external buffers and images come from, instead of the folder given to readGltf().
    FileReader readFile;
    /// Files whose clips come behind the character's own, file after file (cage/clip_set.h). Their meshes are not read.
    std::vector<ClipFile> clipFiles;
    /// Makes the clips of such a file fit the character's skeleton before they are matched (skinning/retarget.h). None:
    /// they move the nodes of their names. May throw Refusal (cage/refusal.h).
    std::function<void(ClipSet& set, const Skeleton& skeleton)> fitClips;
};

/// Parses a glTF or GLB held in memory; docs/gltf.md says in full what is taken, repaired and refused.
///
/// Every node of the scene with a mesh is a part of the character. All TRIANGLES primitives of a mesh make its cage.
/// Its polygons are those
/// of the first PolygonSource that a primitive has, its vertices are welded by the first WeldSource that the mesh has.
/// Cage vertices keep the order of the file's own numbers for them, or else of the POSITION elements they come from
/// (those of all primitives that are read, one after the other; primitives over the same accessors share them). Creases
/// and sharp vertices are those of SUPPLE_mesh_cage, or else of mesh.extras.creases, [vertex, vertex, sharpness], and
/// mesh.extras.corners, [vertex, sharpness], whose vertices are counted in the same order. If a primitive is left out
/// with its vertices, these lists are left out too.
///
/// Mended or left out with a line in Character::warnings: whatever of the file is broken, as little of it as can be
/// (cage/leniency.h), weights that do not sum to 1 beyond rounding (normalised), vertices whose weights are all zero
/// (bound to the first joint they name, as three.js does), primitives that are not triangles, unused vertices,
/// degenerate triangles, missing or unreadable images, entries of extras that make no sense, channels other than
/// translation, rotation and scale, and weights of nodes without morph targets. Joint numbers of zero weights are not
/// looked at. With options.strict, everything that glTF 2.0 forbids and that could change the shape or its motion is an
/// error, and so is an extension named here whose data is malformed.
///
/// `name` begins every error and becomes Character::name; warnings are without it. External buffers and images are
/// looked up below `baseDirectory` (no "..", no absolute paths, no URL schemes but data:); an empty baseDirectory
/// allows none; with options.readFile it is not looked at. Never throws. Errors have a line for each
/// fault, "NAME: element: reason".
[[nodiscard]] Result<Character> readGltf(std::span<const std::byte> bytes, const std::string& name,
                                         const std::string& baseDirectory, const GltfOptions& options = {});

/// Reads a file and parses it; external resources are looked up in its folder.
[[nodiscard]] Result<Character> readGltfFile(const std::string& path, const GltfOptions& options = {});

} // namespace supple::cage
