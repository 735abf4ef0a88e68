#include "runtime/asset.h"

#include "shaders/shared/pose.h"
#include "shaders/shared/soft.h"
#include "skinning/cloth_table.h"
#include "skinning/jiggle_table.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace supple::runtime {

namespace {

constexpr VkBufferUsageFlags kTableUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

using Words = std::shared_ptr<const std::vector<uint32_t>>;

/// Words that stay where they are as long as their owner.
template <class Owner>
Words wordsIn(const std::shared_ptr<Owner>& owner, const std::vector<uint32_t>& words) {
    return Words(owner, &words);
}
/// Words that nobody else needs: they go when they are uploaded.
Words takenFrom(std::vector<uint32_t>& words) {
    return std::make_shared<const std::vector<uint32_t>>(std::exchange(words, {}));
}

/// Tables on the device, in a buffer that debuggers see as "supple <table>". `of` begins the messages.
Result<gpu::StaticBuffers> upload(const gpu::Device& device, const std::string& of, const std::string& table,
                                  const Words& shared) {
    const std::span<const uint32_t> words = *shared;
    // The narrow mapping also reads tables word by word through a texel view.
    const bool texelsFit = device.mapping.wide || words.size() <= device.limits.maxTexelBufferElements;
    if (words.size_bytes() > device.bufferWindow(16) || !texelsFit) {
        return Error{ErrorCode::limit, of + table + " of " + std::to_string(words.size_bytes()) +
                                           " bytes exceed the device's storage-buffer range or texel-buffer elements"};
    }
    const std::string name = "supple " + table;
    const gpu::StaticRequest request{name.c_str(), kTableUsage, std::as_bytes(words), shared};
    Result<gpu::StaticBuffers> buffers = gpu::StaticBuffers::create(device, {&request, 1});
    if (!buffers) {
        return Error{buffers.error().code, of + buffers.error().message};
    }
    return buffers;
}

} // namespace

Asset::Asset(std::shared_ptr<const Prepared> of)
    : prepared(std::move(of)), character(prepared->character), parts(prepared->parts), choices(prepared->choices),
      rig(prepared->rig), jointFrames(prepared->jointFrames) {}

Result<std::shared_ptr<Asset>> Asset::create(const gpu::Device& device, cage::Character character) {
    const std::shared_ptr<Prepared> own = Prepared::of(std::move(character));
    auto asset = std::make_shared<Asset>(own);
    asset->ownsPrepared = true;
    const Status made = asset->makeSkin(device, takenFrom(own->deform.words));
    return made ? Result<std::shared_ptr<Asset>>(std::move(asset)) : made.error();
}

Result<std::shared_ptr<Asset>> Asset::create(const gpu::Device& device, std::shared_ptr<const Prepared> prepared) {
    auto asset = std::make_shared<Asset>(std::move(prepared));
    const Status made = asset->makeSkin(device, wordsIn(asset->prepared, asset->prepared->deform.words));
    return made ? Result<std::shared_ptr<Asset>>(std::move(asset)) : made.error();
}

Status Asset::makeSkin(const gpu::Device& device, const std::shared_ptr<const std::vector<uint32_t>>& words) {
    return makeTable(device, skinning::SkinTableKind::plain, prepared->deform, words);
}

Status Asset::makeTable(const gpu::Device& device, skinning::SkinTableKind kind, const skinning::DeformTable& table,
                        const std::shared_ptr<const std::vector<uint32_t>>& words) {
    constexpr const char* kNames[] = {"skin tables", "skin tables with centers", "skin tables of delta mush",
                                      "skin tables of light delta mush"};
    static_assert(std::size(kNames) == skinning::kSkinTables);
    Result<gpu::StaticBuffers> made = upload(device, character.name + ": ", kNames[static_cast<size_t>(kind)], words);
    if (!made) {
        return made.error();
    }
    skins[static_cast<size_t>(kind)] = {std::move(*made), table.firstInfluences, table.firstCenter};
    return success();
}

skinning::Skinning Asset::skinning(skinning::SkinningMode mode) const {
    const auto found = [](const auto& prepared, const auto& own) {
        return prepared ? &*prepared : own ? &*own : nullptr;
    };
    return {mode, found(prepared->extras.centers, ownExtras.centers), found(prepared->extras.mush, ownExtras.mush)};
}

Status Asset::findExtra(skinning::SkinExtra extra) {
    if (prepared->extras.has(extra) || ownExtras.has(extra)) {
        return success();
    }
    Status found = ownExtras.find(character, extra);
    if (found) {
        noteLate(extra == skinning::SkinExtra::centers ? "the centers of rotation"
                                                       : "the smoothed weights of delta mush");
    }
    return found;
}

void Asset::noteLate(const char* what) {
    if (!ownsPrepared) {
        builtLate.emplace_back(what);
    }
}

Status Asset::makeSkinning(const gpu::Device& device, skinning::SkinningMode mode) {
    const skinning::SkinningRow& row = skinning::skinningRow(mode);
    if (!skin(mode).buffers.empty()) {
        return success();
    }
    if (Status found = findExtra(row.extra); !found) {
        return found;
    }
    skinning::DeformTable table = skinning::buildDeformTable(character, skinning(mode));
    return makeTable(device, row.table, table, takenFrom(table.words));
}

const skinning::Reach& Asset::reach() {
    if (!prepared->reach && !ownReach) {
        ownReach = skinning::reachOf(character);
    }
    return prepared->reach ? *prepared->reach : *ownReach;
}

Result<std::shared_ptr<AssetPiece>> Asset::pieceOf(const gpu::Device& device, const std::vector<uint32_t>& wanted) {
    for (const std::shared_ptr<AssetPiece>& piece : pieces) {
        if (piece->prepared->parts == wanted) {
            return piece;
        }
    }
    auto piece = std::make_shared<AssetPiece>();
    piece->prepared = prepared->pieceOf(wanted);
    std::vector<uint32_t> words = piece->prepared->of.vertices;
    words.resize((words.size() + 3) / 4 * 4);
    Result<gpu::StaticBuffers> buffers = upload(device, character.name + ": ", "vertices of a piece", takenFrom(words));
    if (!buffers) {
        return buffers.error();
    }
    piece->vertices = std::move(*buffers);
    pieces.push_back(piece);
    return piece;
}

Result<std::shared_ptr<SchemeTables>> Asset::tablesFor(const gpu::Device& device, const surface::Recipe& recipe,
                                                       const std::shared_ptr<AssetPiece>& piece) {
    for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
        if (scheme->recipe() == recipe && scheme->piece == piece) {
            return scheme;
        }
    }
    const std::shared_ptr<const PreparedPiece> of = piece != nullptr ? piece->prepared : nullptr;
    auto scheme = std::make_shared<SchemeTables>();
    scheme->piece = piece;
    scheme->prepared = prepared->findServing(recipe, of.get());
    for (const std::shared_ptr<SchemeTables>& known : schemes) {
        if (scheme->prepared != nullptr && known->prepared == scheme->prepared) {
            return known; // of another rate
        }
    }
    std::shared_ptr<PreparedTables> own; // what is built for this asset alone
    if (scheme->prepared == nullptr) {
        Result<std::shared_ptr<PreparedTables>> built = prepared->build(recipe, of);
        if (!built) {
            return built.error();
        }
        own = std::move(*built);
        scheme->prepared = own;
    }
    const Words words =
        own != nullptr ? takenFrom(own->tables.words) : wordsIn(scheme->prepared, scheme->prepared->tables.words);
    Result<gpu::StaticBuffers> buffers = upload(device, character.name + ": ", "surface tables", words);
    if (!buffers) {
        return buffers.error();
    }
    scheme->buffers = std::move(*buffers);
    if (own != nullptr && !ownsPrepared) {
        builtLate.push_back(std::string("the tables of ") + surface::schemeOf(recipe.scheme).name +
                            (!surface::schemeOf(recipe.scheme).ofMapping ? ""
                             : recipe.wide                               ? " for the wide mapping"
                                                                         : " for the narrow mapping"));
    }
    schemes.push_back(scheme);
    return scheme;
}

std::shared_ptr<const skinning::ClipTable> Asset::wholeClips() {
    if (prepared->clips) {
        return std::shared_ptr<const skinning::ClipTable>(prepared, &*prepared->clips);
    }
    if (!ownsPrepared) {
        builtLate.emplace_back("the tables of the clips");
    }
    return std::make_shared<const skinning::ClipTable>(skinning::buildClipTable(character));
}

void Asset::streamClips(uint64_t poolBytes) {
    clipPoolBytes = poolBytes;
    const bool hasTwins = std::any_of(character.clips.begin(), character.clips.end(),
                                      [](const cage::Clip& clip) { return !clip.packed.coarseWords.empty(); });
    if (poolBytes > 0 && hasTwins) {
        stream = std::make_shared<ClipStream>(wholeClips(), poolBytes);
    }
}

Status Asset::makeClips(const gpu::Device& device) {
    // As long as no group has been created, the table may become another one.
    const bool isCurrent = stream == nullptr || stream->isStarted() || clipsVersion == stream->version();
    if (!clips.empty() && isCurrent) {
        return success();
    }
    const std::shared_ptr<const skinning::ClipTable> table =
        stream != nullptr ? std::shared_ptr<const skinning::ClipTable>(stream, &stream->table()) : wholeClips();
    const Words words = stream != nullptr ? std::make_shared<const std::vector<uint32_t>>(stream->words())
                                          : wordsIn(table, table->words);
    Result<gpu::StaticBuffers> made = upload(device, "", "clip tables", words);
    if (!made) {
        return made.error();
    }
    clips = std::move(*made);
    clipTable = table;
    clipsVersion = stream != nullptr ? stream->version() : 0;
    return success();
}

Status Asset::makeJiggles(const gpu::Device& device) {
    if (jiggles.count > 0 || character.weights.jiggles.empty()) {
        return success();
    }
    skinning::JiggleTable table = skinning::buildJiggleTable(character);
    if (table.mostWork > shared::kMostStepWork) {
        return Error{ErrorCode::limit, "a vertex that jiggles takes " + std::to_string(table.mostWork) +
                                           " rounds of morph targets and joints in a step, of at most " +
                                           std::to_string(shared::kMostStepWork)};
    }
    const uint32_t elements = shared::kJiggleVertices + shared::kJiggleElements * table.vertexCount;
    return makeSoft(device, "jiggle table", std::move(table.words), table.vertexCount, elements, jiggles);
}

Status Asset::makeCloths(const gpu::Device& device) {
    if (cloths.count > 0 || character.cloths.empty()) {
        return success();
    }
    Result<skinning::ClothTable> table = skinning::buildClothTable(character);
    if (!table) {
        return table.error();
    }
    return makeSoft(device, "cloth table", std::move(table->words), table->clothCount, table->stateElements, cloths);
}

Status Asset::makeSoft(const gpu::Device& device, const char* name, std::vector<uint32_t> words, uint32_t count,
                       uint32_t stateElements, SoftOfAsset& soft) const {
    if (count == 0) {
        return success();
    }
    Result<gpu::StaticBuffers> made = upload(device, character.name + ": ", name, takenFrom(words));
    if (!made) {
        return made.error();
    }
    soft.table = std::move(*made);
    soft.count = count;
    soft.stateElements = stateElements;
    return success();
}

Status Asset::makeSoft(const gpu::Device& device) {
    const Status made = makeJiggles(device);
    return made ? makeCloths(device) : made;
}

void Asset::startStream() {
    if (stream != nullptr && !clips.empty()) {
        stream->start();
    }
}

void Asset::makeDrivers() {
    if (hasDrivers() && drivers == nullptr) {
        drivers = std::make_shared<const skinning::DriverTable>(skinning::buildDriverTable(character));
    }
}

void Asset::measureUpdates() {
    if (updates.ofClips.size() != character.clips.size()) {
        makeDrivers();
        updates = skinning::measureUpdates(character, drivers != nullptr ? *drivers : skinning::DriverTable());
    }
}

gpu::MemoryUse Asset::memoryUse() const {
    gpu::MemoryUse use = clips.use();
    for (const SkinTables& skin : skins) {
        use += skin.buffers.use();
    }
    use += jiggles.table.use();
    use += cloths.table.use();
    for (const std::shared_ptr<AssetPiece>& piece : pieces) {
        use += piece->vertices.use();
    }
    for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
        use += scheme->buffers.use();
    }
    return use;
}

} // namespace supple::runtime
