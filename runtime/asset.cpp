#include "runtime/asset.h"

#include "skinning/deform_pass.h"

#include <algorithm>
#include <span>
#include <string>

namespace supple::runtime {

namespace {

constexpr VkBufferUsageFlags kTableUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

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

PartSummary summaryOf(const cage::Character& character, size_t part) {
    const cage::Cage& cage = character.cage;
    const uint32_t begin = character.parts[part].firstFace, end = cage::endFace(character, part);
    PartSummary summary;
    for (uint32_t f = begin; f < end; ++f) {
        summary.materials.push_back(cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[f]);
    }
    std::sort(summary.materials.begin(), summary.materials.end());
    summary.materials.erase(std::unique(summary.materials.begin(), summary.materials.end()), summary.materials.end());
    summary.low = summary.high = cage.positions[cage.faceVertices[cage.faceStarts[begin]]];
    for (uint32_t c = cage.faceStarts[begin]; c < cage.faceStarts[end]; ++c) {
        summary.low = glm::min(summary.low, cage.positions[cage.faceVertices[c]]);
        summary.high = glm::max(summary.high, cage.positions[cage.faceVertices[c]]);
    }
    if (character.parts[part].rigid) {
        const uint32_t vertex = cage.faceVertices[cage.faceStarts[begin]];
        summary.joint = character.weights.influences[character.weights.starts[vertex]].joint;
    }
    return summary;
}

/// Faces and corners of a piece's patches become those of the whole cage.
void nameInWhole(const cage::CagePiece& piece, std::vector<surface::PatchInfo>& patches) {
    for (surface::PatchInfo& patch : patches) {
        patch.face = piece.faces[patch.face];
        for (uint32_t& corner : patch.corners) {
            corner = corner == cage::kNone ? corner : piece.vertices[corner];
        }
    }
}

} // namespace

Result<std::shared_ptr<Asset>> Asset::create(const gpu::Device& device, cage::Character character) {
    auto asset = std::make_shared<Asset>();
    const skinning::DeformTable table = skinning::buildDeformTable(character.cage, character.weights, character.morphs);
    Result<gpu::StaticBuffers> buffers = upload(device, character.name + ": ", "skin tables", table.words);
    if (!buffers) {
        return buffers.error();
    }
    asset->buffers = std::move(*buffers);
    asset->firstInfluences = table.firstInfluences;
    asset->rig = skinning::makeRig(character);
    for (size_t part = 0; part < character.parts.size(); ++part) {
        asset->parts.push_back(summaryOf(character, part));
    }
    asset->choices = surface::chooseSchemes(character);
    asset->jointFrames = skinning::jointFrames(character);
    asset->character = std::move(character);
    return asset;
}

Result<std::shared_ptr<AssetPiece>> Asset::pieceOf(const gpu::Device& device, const std::vector<uint32_t>& parts) {
    for (const std::shared_ptr<AssetPiece>& piece : pieces) {
        if (piece->parts == parts) {
            return piece;
        }
    }
    std::vector<uint32_t> faces;
    for (const uint32_t part : parts) {
        for (uint32_t f = character.parts[part].firstFace; f < cage::endFace(character, part); ++f) {
            faces.push_back(f);
        }
    }
    auto piece = std::make_shared<AssetPiece>();
    piece->parts = parts;
    piece->of = cage::takeFaces(character.cage, faces);
    std::vector<uint32_t> words = piece->of.vertices;
    words.resize((words.size() + 3) / 4 * 4);
    Result<gpu::StaticBuffers> buffers = upload(device, character.name + ": ", "vertices of a piece", words);
    if (!buffers) {
        return buffers.error();
    }
    piece->vertices = std::move(*buffers);
    pieces.push_back(piece);
    return piece;
}

const cage::Cage& Asset::cageOf(const std::shared_ptr<AssetPiece>& piece) const {
    if (piece != nullptr) {
        return piece->of.cage;
    }
    return character.cage;
}

Result<std::shared_ptr<SchemeTables>> Asset::tablesFor(const gpu::Device& device, const surface::Recipe& recipe,
                                                       const std::shared_ptr<AssetPiece>& piece) {
    for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
        if (scheme->recipe == recipe && scheme->piece == piece) {
            return scheme;
        }
    }
    Result<surface::Tables> tables = surface::buildTables(recipe, cageOf(piece));
    if (!tables) {
        return Error{tables.error().code, character.name + ": " + tables.error().message};
    }
    if (piece != nullptr) {
        nameInWhole(piece->of, tables->patches);
    }
    auto scheme = std::make_shared<SchemeTables>();
    scheme->recipe = recipe;
    scheme->piece = piece;
    scheme->tables = std::move(*tables);
    std::vector<uint32_t>& words = scheme->tables.words;
    Result<gpu::StaticBuffers> buffers = upload(device, character.name + ": ", "surface tables", words);
    if (!buffers) {
        return buffers.error();
    }
    scheme->buffers = std::move(*buffers);
    words = {};
    schemes.push_back(scheme);
    return scheme;
}

Status Asset::makeClips(const gpu::Device& device) {
    if (!clips.empty()) {
        return success();
    }
    skinning::ClipTable table = skinning::buildClipTable(character);
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
