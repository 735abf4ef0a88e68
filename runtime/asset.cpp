#include "runtime/asset.h"

#include <span>
#include <string>

namespace supple::runtime {

namespace {

constexpr VkBufferUsageFlags kTableUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

/// Tables on the device, in a buffer that debuggers see as "supple <table>". `of` begins the messages.
Result<gpu::StaticBuffers> upload(const gpu::Device& device, const std::string& of, const std::string& table,
                                  std::span<const uint32_t> words) {
    // The narrow mapping also reads tables word by word through a texel view.
    const bool texelsFit = device.mapping.wide || words.size() <= device.limits.maxTexelBufferElements;
    if (words.size_bytes() > device.bufferWindow(16) || !texelsFit) {
        return Error{ErrorCode::limit, of + table + " of " + std::to_string(words.size_bytes()) +
                                           " bytes exceed the device's storage-buffer range or texel-buffer elements"};
    }
    const std::string name = "supple " + table;
    const gpu::StaticRequest request{name.c_str(), kTableUsage, std::as_bytes(words)};
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
    Result<std::shared_ptr<Asset>> asset = create(device, own);
    if (asset) {
        (*asset)->ownsPrepared = true;
        own->deform.words = {};
    }
    return asset;
}

Result<std::shared_ptr<Asset>> Asset::create(const gpu::Device& device, std::shared_ptr<const Prepared> prepared) {
    auto asset = std::make_shared<Asset>(std::move(prepared));
    const skinning::DeformTable& deform = asset->prepared->deform;
    Result<gpu::StaticBuffers> buffers = upload(device, asset->character.name + ": ", "skin tables", deform.words);
    if (!buffers) {
        return buffers.error();
    }
    asset->buffers = std::move(*buffers);
    asset->firstInfluences = deform.firstInfluences;
    return asset;
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
    Result<gpu::StaticBuffers> buffers = upload(device, character.name + ": ", "vertices of a piece", words);
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
    Result<gpu::StaticBuffers> buffers =
        upload(device, character.name + ": ", "surface tables", scheme->tables().words);
    if (!buffers) {
        return buffers.error();
    }
    scheme->buffers = std::move(*buffers);
    if (own != nullptr) {
        own->tables.words = {};
    }
    if (own != nullptr && !ownsPrepared) {
        builtLate.push_back(std::string("the tables of ") + surface::schemeOf(recipe.scheme).name +
                            (!surface::schemeOf(recipe.scheme).ofMapping ? ""
                             : recipe.wide                               ? " for the wide mapping"
                                                                         : " for the narrow mapping"));
    }
    schemes.push_back(scheme);
    return scheme;
}

Status Asset::makeClips(const gpu::Device& device) {
    if (!clips.empty()) {
        return success();
    }
    skinning::ClipTable table = prepared->clips ? *prepared->clips : skinning::buildClipTable(character);
    if (!prepared->clips && !ownsPrepared) {
        builtLate.emplace_back("the tables of the clips");
    }
    Result<gpu::StaticBuffers> buffers = upload(device, "", "clip tables", table.words);
    if (!buffers) {
        return buffers.error();
    }
    clips = std::move(*buffers);
    clipTable = std::move(table);
    clipTable.words = {};
    return success();
}

gpu::MemoryUse Asset::memoryUse() const {
    gpu::MemoryUse use = buffers.use();
    use += clips.use();
    for (const std::shared_ptr<AssetPiece>& piece : pieces) {
        use += piece->vertices.use();
    }
    for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
        use += scheme->buffers.use();
    }
    return use;
}

} // namespace supple::runtime
