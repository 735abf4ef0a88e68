// A loaded character and what the device holds of it: the deform table, and the tables of every scheme in use.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/piece.h"
#include "gpu/static_buffers.h"
#include "runtime/clip_bounds.h"
#include "skinning/clip_table.h"
#include "skinning/joints.h"
#include "skinning/layers.h"
#include "supple/supple.h"
#include "surface/choice.h"
#include "surface/schemes.h"

#include <memory>
#include <vector>

namespace supple::runtime {

/// Some parts of an asset, which groups make a surface of.
struct AssetPiece {
    std::vector<uint32_t> parts; ///< rising
    cage::CagePiece of;
    gpu::StaticBuffers vertices; ///< 0: which vertices of the whole cage it has
};

/// Static tables of a scheme for one asset and one set of options, shared by the groups that use them.
struct SchemeTables {
    surface::Recipe recipe;
    std::shared_ptr<AssetPiece> piece; ///< null: the whole cage
    surface::Tables tables;            ///< `words` is emptied once it lies in the staging memory. Patches have the
                                       ///< faces and corners of the whole cage
    gpu::StaticBuffers buffers;        ///< 0: the tables
};

/// What the API tells of a part beside cage::Part.
struct PartSummary {
    std::vector<uint32_t> materials; ///< that its faces have, rising
    uint32_t joint = cage::kNone;    ///< that all its vertices follow
    glm::vec3 low{0.0f}, high{0.0f}; ///< box of its cage vertices
};

struct Asset {
    cage::Character character;
    std::vector<PartSummary> parts;
    std::vector<surface::SchemeChoice> choices; ///< what SUPPLE_SCHEME_AUTO takes for each part
    gpu::StaticBuffers buffers;                 ///< 0: the deform table
    uint32_t firstInfluences = 0;               ///< skinning::DeformTable
    skinning::Rig rig;
    skinning::JointFrames jointFrames;
    mutable ClipBounds clipBounds; ///< what has been asked for
    // Made for the first group that plays on the device:
    skinning::ClipTable clipTable; ///< `words` is emptied once it lies in the staging memory
    gpu::StaticBuffers clips;      ///< 0: the clip table
    std::vector<std::shared_ptr<AssetPiece>> pieces;
    std::vector<std::shared_ptr<SchemeTables>> schemes;

    [[nodiscard]] static Result<std::shared_ptr<Asset>> create(const gpu::Device& device, cage::Character character);
    /// Finds or makes the piece of some parts (rising).
    [[nodiscard]] Result<std::shared_ptr<AssetPiece>> pieceOf(const gpu::Device& device,
                                                              const std::vector<uint32_t>& parts);
    /// The cage of the piece, or the whole cage if it is null.
    [[nodiscard]] const cage::Cage& cageOf(const std::shared_ptr<AssetPiece>& piece) const;
    /// Finds or builds the tables of a recipe for the piece, or for the whole cage if it is null; refuses what the
    /// scheme cannot take.
    [[nodiscard]] Result<std::shared_ptr<SchemeTables>>
    tablesFor(const gpu::Device& device, const surface::Recipe& recipe, const std::shared_ptr<AssetPiece>& piece);
    /// Sees to it that clipTable and clips are there.
    [[nodiscard]] Status makeClips(const gpu::Device& device);
    [[nodiscard]] gpu::MemoryUse memoryUse() const;
};

/// A character without skeleton or clips from the host's arrays: one joint, every vertex bound to it. A damaged cage is
/// repaired, or refused if `strict`.
[[nodiscard]] Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name,
                                                          bool strict = false);

} // namespace supple::runtime
