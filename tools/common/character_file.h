// A character file in memory, glTF or OBJ: read once, handed to Supple, looked into for what Supple does not tell.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "host/context.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/retarget_map.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace supple::host {

/// Names of SuppleRetargeting.
inline constexpr const char* kRetargetings[] = {"differing", "never", "all", "free-feet"};
[[nodiscard]] SuppleRetargeting retargetingOf(const std::string& name);

/// How a file is read.
struct ReadOptions {
    bool pairQuads = false;                ///< SUPPLE_ASSET_PAIR_QUADS
    bool keepTriangles = false;            ///< SUPPLE_ASSET_KEEP_TRIANGLES
    bool creasesFromNormals = false;       ///< SUPPLE_ASSET_CREASES_FROM_NORMALS
    bool smooth = false;                   ///< SUPPLE_ASSET_SMOOTH
    bool strict = false;                   ///< SUPPLE_ASSET_STRICT
    bool partsApart = false;               ///< SUPPLE_ASSET_PARTS_APART
    bool verticesApart = false;            ///< SUPPLE_ASSET_VERTICES_APART
    uint32_t memoryLimit = 0;              ///< SuppleAssetDesc.memoryLimit in MiB
    std::optional<uint32_t> scene;         ///< the file's own choice if it is not given
    std::string variant;                   ///< SuppleAssetDesc.materialVariant
    std::vector<std::string> clipFiles;    ///< paths of files whose clips the character takes
    std::string retargeting = "differing"; ///< of clipFiles: one of kRetargetings
    std::string retargetMap;               ///< path of a file of pairs of joints; empty: none
};

struct FileInMemory {
    std::string path;
    std::string directory; ///< where its external buffers and images lie
    std::vector<std::byte> bytes;
};

struct CharacterFile : FileInMemory {
    std::vector<FileInMemory> clipFiles;
    std::vector<JointPairSetting> jointPairs;
    ReadOptions flags;
    cage::Character character; ///< called as the path
};
[[nodiscard]] Result<CharacterFile> readCharacterFile(const std::string& path, const ReadOptions& flags = {});

/// The file as Supple takes it. Of a character that was made, which has no bytes, the cage alone.
class AssetDescription {
public:
    /// The file must outlive it.
    explicit AssetDescription(const CharacterFile& file);
    AssetDescription(const AssetDescription&) = delete;
    AssetDescription& operator=(const AssetDescription&) = delete;
    [[nodiscard]] const SuppleAssetDesc& desc() const { return desc_; }

private:
    SuppleAssetDesc desc_{};
    std::vector<SuppleClipFile> clipFiles_;
    std::vector<SuppleJointPair> jointPairs_;
    std::unique_ptr<const CageArrays> cage_;
};

[[nodiscard]] Result<SuppleAsset> createAsset(Context& context, const CharacterFile& file);

/// The clip of that name, else of that index; SUPPLE_BIND_POSE for an empty text. The error lists the clips there are.
[[nodiscard]] Result<uint32_t> findClip(const cage::Character& character, const std::string& nameOrIndex);
/// The first of that name, else of that index. `what` is what they are, and `owner` whose.
[[nodiscard]] Result<uint32_t> findNamed(const std::string& owner, const char* what,
                                         const std::vector<std::string>& names, const std::string& nameOrIndex);
/// Likewise among the clips of those names, of a character called `owner`.
[[nodiscard]] Result<uint32_t> findClip(const std::string& owner, const std::vector<std::string>& clips,
                                        const std::string& nameOrIndex);

} // namespace supple::host
