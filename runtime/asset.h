// A loaded character and what the device holds of it: the deform table, and the tables of every scheme in use.
#pragma once

#include "base/result.h"
#include "gpu/static_buffers.h"
#include "runtime/clip_bounds.h"
#include "runtime/clip_stream.h"
#include "runtime/prepared.h"
#include "skinning/contacts.h"
#include "skinning/driver_table.h"
#include "skinning/update_errors.h"
#include "supple/supple.h"

#include <memory>
#include <optional>
#include <vector>

namespace supple::runtime {

/// Some parts of an asset, which groups make a surface of.
struct AssetPiece {
    std::shared_ptr<const PreparedPiece> prepared;
    gpu::StaticBuffers vertices; ///< 0: which vertices of the whole cage it has
};

/// Static tables of a scheme for one asset and one set of options, shared by the groups that use them.
struct SchemeTables {
    std::shared_ptr<const PreparedTables> prepared;
    std::shared_ptr<AssetPiece> piece; ///< null: the whole cage
    gpu::StaticBuffers buffers;        ///< 0: the tables

    [[nodiscard]] const surface::Recipe& recipe() const { return prepared->recipe; }
    [[nodiscard]] const surface::Tables& tables() const { return prepared->tables; }
};

/// What an asset has of one kind of what is soft: vertices that jiggle, or cloths.
struct SoftOfAsset {
    gpu::StaticBuffers table;   ///< 0: as the device reads it (shaders/shared/soft.h)
    uint32_t count = 0;         ///< vertices that jiggle, or cloths
    uint32_t stateElements = 0; ///< of an instance
};

/// The deform table of a way of skinning.
struct SkinTables {
    gpu::StaticBuffers buffers;                    ///< 0: the table
    uint32_t firstInfluences = 0, firstCenter = 0; ///< skinning::DeformTable
};

struct Asset {
    /// If it is the asset's own, the words of its tables are gone: who uploads them has them.
    const std::shared_ptr<const Prepared> prepared;
    // All of them are its.
    const cage::Character& character;
    const std::vector<PartSummary>& parts;
    const std::vector<surface::SchemeChoice>& choices;
    const skinning::Rig& rig;
    const skinning::JointFrames& jointFrames;

    SkinTables skins[skinning::kSkinTables]; ///< by skinning::SkinTableKind; but for `plain`, made for the first group
                                             ///< that asks
    mutable ClipBounds clipBounds;           ///< what has been asked for
    mutable std::optional<skinning::Contacts> contacts; ///< once they have been asked for
    // Made for the first group that plays on the device:
    std::shared_ptr<const skinning::ClipTable> clipTable; ///< its words stay: the CPU poses by them as well
    gpu::StaticBuffers clips;                             ///< 0: the clip table
    SoftOfAsset jiggles, cloths; ///< of skinning::JiggleTable and ClothTable, made for the first group that is soft
    std::shared_ptr<ClipStream> stream;      ///< null: all segments of clips are on the device
    uint64_t clipsVersion = 0;               ///< stream->version() that they were made of
    uint64_t clipPoolBytes = 0;              ///< SuppleAssetDesc
    std::optional<skinning::Reach> ownReach; ///< made for the first group of a view, if it was not prepared
    skinning::SkinExtras ownExtras;          ///< if they were not prepared
    skinning::UpdateFacts updates;           ///< made for the first group with update rates
    std::shared_ptr<const skinning::DriverTable> drivers; ///< made for the first group that asks on the CPU
    std::vector<std::shared_ptr<AssetPiece>> pieces;
    std::vector<std::shared_ptr<SchemeTables>> schemes;
    bool ownsPrepared = false;
    std::vector<std::string> builtLate; ///< what had to be built because it was not prepared, until somebody says so

    explicit Asset(std::shared_ptr<const Prepared> of);
    /// Prepares the character for itself.
    [[nodiscard]] static Result<std::shared_ptr<Asset>> create(const gpu::Device& device, cage::Character character);
    /// Takes what was prepared for anybody.
    [[nodiscard]] static Result<std::shared_ptr<Asset>> create(const gpu::Device& device,
                                                               std::shared_ptr<const Prepared> prepared);
    [[nodiscard]] std::shared_ptr<const skinning::ClipTable> wholeClips();
    /// For create().
    [[nodiscard]] Status makeSkin(const gpu::Device& device, const std::shared_ptr<const std::vector<uint32_t>>& words);
    // For makeSkin() and makeSkinning().
    [[nodiscard]] Status makeTable(const gpu::Device& device, skinning::SkinTableKind kind,
                                   const skinning::DeformTable& table,
                                   const std::shared_ptr<const std::vector<uint32_t>>& words);
    [[nodiscard]] Status findExtra(skinning::SkinExtra extra);
    /// It had to be built because it was not prepared.
    void noteLate(const char* what);
    /// Finds or makes the piece of some parts (rising).
    [[nodiscard]] Result<std::shared_ptr<AssetPiece>> pieceOf(const gpu::Device& device,
                                                              const std::vector<uint32_t>& parts);
    /// The cage of the piece, or the whole cage if it is null.
    [[nodiscard]] const cage::Cage& cageOf(const std::shared_ptr<AssetPiece>& piece) const {
        return prepared->cageOf(piece != nullptr ? piece->prepared.get() : nullptr);
    }
    /// Finds or builds the tables of a recipe for the piece, or for the whole cage if it is null; refuses what the
    /// scheme cannot take.
    [[nodiscard]] Result<std::shared_ptr<SchemeTables>>
    tablesFor(const gpu::Device& device, const surface::Recipe& recipe, const std::shared_ptr<AssetPiece>& piece);
    /// Of clips with coarse twins, the device keeps what is asked for, in so many bytes; 0: all. For new assets.
    void streamClips(uint64_t poolBytes);
    /// Sees to it that clipTable and clips are there.
    [[nodiscard]] Status makeClips(const gpu::Device& device);
    /// Sees to it that `jiggles` and `cloths` are there, if something is soft. Refuses what takes too much in a step.
    [[nodiscard]] Status makeSoft(const gpu::Device& device);
    [[nodiscard]] bool isSoft() const { return jiggles.count > 0 || cloths.count > 0; }
    /// Some morph target moves a vertex.
    [[nodiscard]] bool hasMorphs() const { return skins[0].firstInfluences != 0; }
    /// Some morph weights follow from joints, and move something.
    [[nodiscard]] bool hasDrivers() const { return hasMorphs() && !character.drivers.empty(); }
    /// A group that may read the clips has been created: from now on segments come with frames.
    void startStream();
    /// Sees to it that `drivers` is there, if hasDrivers().
    void makeDrivers();
    /// Sees to it that `updates` is there.
    void measureUpdates();
    /// Sees to it that what a way of skinning needs is there. Refuses cages that delta mush would take too long for.
    [[nodiscard]] Status makeSkinning(const gpu::Device& device, skinning::SkinningMode mode);
    /// The deform table that a way of skinning reads.
    [[nodiscard]] const SkinTables& skin(skinning::SkinningMode mode) const {
        return skins[static_cast<size_t>(skinning::skinningRow(mode).table)];
    }
    /// With what it needs, once some group has needed it.
    [[nodiscard]] skinning::Skinning skinning(skinning::SkinningMode mode) const;
    /// How far the character reaches in any pose of its clips.
    [[nodiscard]] const skinning::Reach& reach();
    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    /// The deform tables.
    template <class F>
    void forSkins(F&& visit) {
        for (SkinTables& skin : skins) {
            visit(skin.buffers);
        }
    }
    /// What all groups share, and the tables of those that there have been.
    template <class F>
    void forStatics(F&& visit) {
        forSkins(visit);
        visit(clips);
        visit(jiggles.table);
        visit(cloths.table);
        for (const std::shared_ptr<AssetPiece>& piece : pieces) {
            visit(piece->vertices);
        }
        for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
            visit(scheme->buffers);
        }
    }

private:
    [[nodiscard]] Status makeJiggles(const gpu::Device& device);
    [[nodiscard]] Status makeCloths(const gpu::Device& device);
    [[nodiscard]] Status makeSoft(const gpu::Device& device, const char* name, std::vector<uint32_t> words,
                                  uint32_t count, uint32_t stateElements, SoftOfAsset& soft) const;
};

} // namespace supple::runtime
