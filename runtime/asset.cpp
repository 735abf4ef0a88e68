#include "runtime/asset.h"

#include "cage/single_joint.h"
#include "cage/trim.h"
#include "skinning/deform_pass.h"

#include <algorithm>
#include <cmath>

namespace supple::runtime {

namespace {

constexpr VkBufferUsageFlags kTableUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

Status checkTableSize(const gpu::Device& device, const std::string& name, const char* table, VkDeviceSize bytes) {
    // The narrow mapping also reads tables word by word through a texel view.
    const bool texelsFit = device.mapping.wide || bytes / 4 <= device.limits.maxTexelBufferElements;
    if (bytes <= device.bufferWindow(16) && texelsFit) {
        return success();
    }
    return Error{ErrorCode::limit, name + ": " + table + " of " + std::to_string(bytes) +
                                       " bytes exceed the device's storage-buffer range or texel-buffer elements"};
}

} // namespace

Result<std::shared_ptr<Asset>> Asset::create(const gpu::Device& device, cage::Character character) {
    auto asset = std::make_shared<Asset>();
    const skinning::DeformTable table = skinning::buildDeformTable(character.cage, character.weights, character.morphs);
    const Status fits = checkTableSize(device, character.name, "skin tables", table.words.size() * 4);
    if (!fits) {
        return fits.error();
    }
    const gpu::StaticRequest request{"supple deform table", kTableUsage, std::as_bytes(std::span(table.words))};
    Result<gpu::StaticBuffers> buffers = gpu::StaticBuffers::create(device, {&request, 1});
    if (!buffers) {
        return buffers.error();
    }
    asset->buffers = std::move(*buffers);
    asset->firstInfluences = table.firstInfluences;
    asset->rig = skinning::makeRig(character);
    asset->character = std::move(character);
    return asset;
}

Result<std::shared_ptr<SchemeTables>> Asset::tablesFor(const gpu::Device& device, const surface::Recipe& recipe) {
    for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
        if (scheme->recipe == recipe) {
            return scheme;
        }
    }
    Result<surface::Tables> tables = surface::buildTables(recipe, character.cage);
    if (!tables) {
        return Error{tables.error().code, character.name + ": " + tables.error().message};
    }
    auto scheme = std::make_shared<SchemeTables>();
    scheme->recipe = recipe;
    scheme->tables = std::move(*tables);
    std::vector<uint32_t>& words = scheme->tables.words;
    const Status fits = checkTableSize(device, character.name, "surface tables", words.size() * 4);
    if (!fits) {
        return fits.error();
    }
    const gpu::StaticRequest request{"supple surface tables", kTableUsage, std::as_bytes(std::span(words))};
    Result<gpu::StaticBuffers> buffers = gpu::StaticBuffers::create(device, {&request, 1});
    if (!buffers) {
        return buffers.error();
    }
    scheme->buffers = std::move(*buffers);
    words = {};
    schemes.push_back(scheme);
    return scheme;
}

Status Asset::makeClips(const gpu::Device& device) {
    if (clips.deviceBytes() > 0) {
        return success();
    }
    skinning::ClipTable table = skinning::buildClipTable(character);
    Status fits = checkTableSize(device, character.name, "clip tables", table.words.size() * 4);
    if (!fits) {
        return fits;
    }
    const gpu::StaticRequest request{"supple clips", kTableUsage, std::as_bytes(std::span(table.words))};
    Result<gpu::StaticBuffers> buffers = gpu::StaticBuffers::create(device, {&request, 1});
    if (!buffers) {
        return buffers.error();
    }
    clips = std::move(*buffers);
    clipTable = std::move(table);
    clipTable.words = {};
    return success();
}

Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name) {
    const auto refuse = [&](const std::string& reason) { return Error{ErrorCode::asset, name + ": " + reason}; };
    if (desc.positions == nullptr || desc.faceVertexCounts == nullptr || desc.faceVertexIndices == nullptr) {
        return Error{ErrorCode::nullPointer, name + ": positions, faceVertexCounts or faceVertexIndices is null"};
    }
    if (desc.vertexCount == 0 || desc.faceCount == 0) {
        return refuse("no vertices or no faces");
    }

    cage::Character character;
    character.name = name;
    character.polygonSource = cage::PolygonSource::arrays;
    cage::Cage& cage = character.cage;
    cage.positions.resize(desc.vertexCount);
    cage.sourceVertices.resize(desc.vertexCount);
    for (uint32_t v = 0; v < desc.vertexCount; ++v) {
        for (int axis = 0; axis < 3; ++axis) {
            const float x = desc.positions[3 * size_t{v} + static_cast<size_t>(axis)];
            if (!std::isfinite(x)) {
                return refuse("vertex " + std::to_string(v) + ": position is not finite");
            }
            cage.positions[v][axis] = x;
        }
        cage.sourceVertices[v] = v;
    }
    cage.faceStarts.push_back(0);
    uint64_t corners = 0;
    for (uint32_t f = 0; f < desc.faceCount; ++f) {
        if (desc.faceVertexCounts[f] < 3) {
            return refuse("face " + std::to_string(f) + ": " + std::to_string(desc.faceVertexCounts[f]) + " corners");
        }
        corners += desc.faceVertexCounts[f];
        if (corners > 0x7FFFFFFFu) {
            return refuse("face " + std::to_string(f) + ": more than 2^31 corners");
        }
        cage.faceStarts.push_back(static_cast<uint32_t>(corners));
    }
    cage.faceVertices.assign(desc.faceVertexIndices, desc.faceVertexIndices + corners);
    for (uint32_t f = 0; f < desc.faceCount; ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            if (cage.faceVertices[c] >= desc.vertexCount) {
                return refuse("face " + std::to_string(f) + ": vertex " + std::to_string(cage.faceVertices[c]) +
                              " of " + std::to_string(desc.vertexCount));
            }
        }
    }
    if (desc.cornerUvs != nullptr) {
        for (uint64_t c = 0; c < corners; ++c) {
            cage.cornerUvs.emplace_back(desc.cornerUvs[2 * c], desc.cornerUvs[2 * c + 1]);
        }
    }

    if (desc.cornerUvs1 != nullptr) {
        for (uint64_t c = 0; c < corners; ++c) {
            cage.cornerUvs1.emplace_back(desc.cornerUvs1[2 * c], desc.cornerUvs1[2 * c + 1]);
        }
    }
    for (uint32_t f = 0; f < desc.faceCount && desc.faceTrimTiles != nullptr; ++f) {
        const uint32_t tile = desc.faceTrimTiles[f];
        if (tile != SUPPLE_NO_TRIM_TILE && tile >= cage::kMaxTrimTiles) {
            return refuse("face " + std::to_string(f) + ": trim tile " + std::to_string(tile) + " of " +
                          std::to_string(cage::kMaxTrimTiles));
        }
        cage.faceTrimTiles.push_back(tile);
    }
    const auto present = [](uint32_t count, auto... arrays) { return count == 0 || (... && (arrays != nullptr)); };
    if (!present(desc.creaseCount, desc.creaseVertices, desc.creaseSharpnesses) ||
        !present(desc.cornerCount, desc.cornerVertices, desc.cornerSharpnesses) ||
        !present(desc.creaseScalarCount, desc.creaseScalars) || !present(desc.holeCount, desc.holes)) {
        return Error{ErrorCode::nullPointer, name + ": a count without its array"};
    }
    for (uint32_t i = 0; i < desc.creaseCount; ++i) {
        const uint32_t a = desc.creaseVertices[2 * size_t{i}], b = desc.creaseVertices[2 * size_t{i} + 1];
        if (a >= desc.vertexCount || b >= desc.vertexCount || !(desc.creaseSharpnesses[i] >= 0.0f)) {
            return refuse("crease " + std::to_string(i) + ": no such vertices, or no sharpness of 0 and more");
        }
        cage.creases.push_back(
            {desc.creaseVertices[2 * size_t{i}], desc.creaseVertices[2 * size_t{i} + 1], desc.creaseSharpnesses[i]});
    }
    for (uint32_t i = 0; i < desc.cornerCount; ++i) {
        if (desc.cornerVertices[i] >= desc.vertexCount || !(desc.cornerSharpnesses[i] >= 0.0f)) {
            return refuse("corner " + std::to_string(i) + ": no such vertex, or no sharpness of 0 and more");
        }
        cage.sharpVertices.push_back({desc.cornerVertices[i], desc.cornerSharpnesses[i]});
    }
    for (uint32_t i = 0; i < desc.creaseScalarCount; ++i) {
        const SuppleCreaseScalar& scalar = desc.creaseScalars[i];
        if (!(scalar.alpha > 0.0f && scalar.alpha <= 1.0f)) {
            return refuse("crease scalar " + std::to_string(i) + ": alpha is not in (0, 1]");
        }
        cage.creaseScalars.push_back({scalar.vertex, scalar.toward, scalar.alpha});
    }
    for (uint32_t i = 0; i < desc.holeCount; ++i) {
        if (desc.holes[i] >= desc.faceCount) {
            return refuse("hole " + std::to_string(i) + ": face " + std::to_string(desc.holes[i]) + " of " +
                          std::to_string(desc.faceCount));
        }
        cage.holes.push_back(desc.holes[i]);
    }
    std::sort(cage.holes.begin(), cage.holes.end());
    cage.holes.erase(std::unique(cage.holes.begin(), cage.holes.end()), cage.holes.end());

    cage::bindToOneJoint(character, name);
    character.sourceVertexCount = desc.vertexCount;
    return character;
}

} // namespace supple::runtime
