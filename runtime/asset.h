// A loaded character and what the device holds of it: the deform table, and one set of tables a scheme in use.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "gpu/static_buffers.h"
#include "skinning/clip_table.h"
#include "skinning/joints.h"
#include "skinning/layers.h"
#include "supple/supple.h"
#include "surface/schemes.h"

#include <memory>
#include <vector>

namespace supple::runtime {

/// Static tables of a scheme for one asset and one set of options, shared by the groups that use them.
struct SchemeTables {
    surface::Recipe recipe;
    surface::Tables tables;     ///< `words` is emptied once it lies in the staging memory
    gpu::StaticBuffers buffers; ///< 0: the tables
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
    gpu::StaticBuffers buffers;   ///< 0: the deform table
    uint32_t firstInfluences = 0; ///< skinning::DeformTable
    skinning::Rig rig;
    skinning::JointFrames jointFrames;
    // Made for the first group that plays on the device:
    skinning::ClipTable clipTable; ///< `words` is emptied once it lies in the staging memory
    gpu::StaticBuffers clips;      ///< 0: the clip table
    std::vector<std::shared_ptr<SchemeTables>> schemes;

    [[nodiscard]] static Result<std::shared_ptr<Asset>> create(const gpu::Device& device, cage::Character character);
    /// Finds or builds the tables of a recipe; refuses what the scheme cannot take.
    [[nodiscard]] Result<std::shared_ptr<SchemeTables>> tablesFor(const gpu::Device& device,
                                                                  const surface::Recipe& recipe);
    /// Sees to it that clipTable and clips are there.
    [[nodiscard]] Status makeClips(const gpu::Device& device);
};

/// A character without skeleton or clips from the host's arrays: one joint, every vertex bound to it. A damaged cage is
/// repaired, or refused if `strict`.
[[nodiscard]] Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name,
                                                          bool strict = false);

} // namespace supple::runtime
