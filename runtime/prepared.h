// A character and what is built of it on the CPU. It knows no device and no context, so it can be made on any thread.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/piece.h"
#include "skinning/clip_table.h"
#include "skinning/deform_table.h"
#include "skinning/joints.h"
#include "skinning/layers.h"
#include "skinning/reach.h"
#include "skinning/skin_extras.h"
#include "surface/choice.h"
#include "surface/lod/instance.h"
#include "surface/schemes.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace supple::runtime {

/// What the API tells of a part beside cage::Part.
struct PartSummary {
    std::vector<uint32_t> materials; ///< that its faces have, rising
    uint32_t joint = cage::kNone;    ///< that all its vertices follow
    glm::vec3 low{0.0f}, high{0.0f}; ///< box of its cage vertices
};

/// Some parts of a character, of which a surface is made.
struct PreparedPiece {
    std::vector<uint32_t> parts; ///< rising
    cage::CagePiece of;
};

/// The tables of a recipe. Patches have the faces and corners of the whole cage.
struct PreparedTables {
    surface::Recipe recipe;
    std::shared_ptr<const PreparedPiece> piece; ///< null: the whole cage
    surface::Tables tables;
};

/// Whoever shares it may not change it: then threads, assets and contexts read it at the same time.
struct Prepared {
    cage::Character character;
    std::vector<PartSummary> parts;
    std::vector<surface::SchemeChoice> choices; ///< what SUPPLE_SCHEME_AUTO takes for each part
    skinning::DeformTable deform;
    skinning::Rig rig;
    skinning::JointFrames jointFrames;
    std::optional<skinning::ClipTable> clips; ///< if a group is to play on the device
    std::optional<skinning::Reach> reach;     ///< if a group is to be of a view
    skinning::SkinExtras extras;              ///< what groups need for the way in which they are to be skinned
    std::vector<std::shared_ptr<const PreparedPiece>> pieces;
    std::vector<std::shared_ptr<const PreparedTables>> tables;
    /// How the level of an instance is measured, if a group of a view is to have the tables.
    struct Measure {
        const PreparedTables* tables = nullptr;
        surface::lod::InstanceMeasure measure;
    };
    std::vector<Measure> measures;
    std::string madeBy; ///< the command that made the cooked file that it comes from, or empty

    /// Without clips, pieces and tables.
    [[nodiscard]] static std::shared_ptr<Prepared> of(cage::Character character);
    /// Makes what follows from the character in no time: all but choices, clips, pieces and tables.
    void follow();

    /// Packs the clips (skinning/clip_packer.h).
    void packClips(double error, double coarseError = 0.0);

    /// Finds the piece of some parts (rising), or makes one that is not kept here.
    [[nodiscard]] std::shared_ptr<const PreparedPiece> pieceOf(const std::vector<uint32_t>& parts) const;
    /// Null if the tables were not prepared.
    [[nodiscard]] std::shared_ptr<const PreparedTables> find(const surface::Recipe& recipe,
                                                             const PreparedPiece* piece) const;
    /// The same, or those of the next higher rate that serve the recipe (surface::serves): what a group draws with them
    /// has the same bits.
    [[nodiscard]] std::shared_ptr<const PreparedTables> findServing(const surface::Recipe& recipe,
                                                                    const PreparedPiece* piece) const;
    /// Builds the tables of a recipe for the piece, or for the whole cage if it is null. They are not kept here.
    /// Refuses what the scheme cannot take.
    [[nodiscard]] Result<std::shared_ptr<PreparedTables>>
    build(const surface::Recipe& recipe, const std::shared_ptr<const PreparedPiece>& piece) const;

    /// Finds the measure, or makes one that is not kept here.
    [[nodiscard]] surface::lod::InstanceMeasure measureOf(const PreparedTables& of) const;
    /// The cage of the piece, or the whole cage if it is null.
    [[nodiscard]] const cage::Cage& cageOf(const PreparedPiece* piece) const {
        return piece != nullptr ? piece->of.cage : character.cage;
    }
};

} // namespace supple::runtime
