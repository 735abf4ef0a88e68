#include "runtime/asset.h"

#include "skinning/deform_pass.h"

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
    asset->topology = cage::buildTopology(character.cage);

    const std::vector<uint32_t> table = skinning::buildDeformTable(character.cage, character.weights);
    const Status fits = checkTableSize(device, character.name, "skin tables", table.size() * 4);
    if (!fits) {
        return fits.error();
    }
    const gpu::StaticRequest request{"supple deform table", kTableUsage, std::as_bytes(std::span(table))};
    Result<gpu::StaticBuffers> buffers = gpu::StaticBuffers::create(device, {&request, 1});
    if (!buffers) {
        return buffers.error();
    }
    asset->buffers = std::move(*buffers);
    asset->character = std::move(character);
    return asset;
}

Result<std::shared_ptr<SchemeTables>> Asset::tablesFor(const gpu::Device& device,
                                                       const surface::prep::Options& options) {
    for (const std::shared_ptr<SchemeTables>& scheme : schemes) {
        if (scheme->options.tangentMode == options.tangentMode && scheme->options.cornerRule == options.cornerRule) {
            return scheme;
        }
    }
    if (!topology) {
        return Error{ErrorCode::asset, character.name + ": " + topology.error().message};
    }
    const Status accepted = surface::prep::accepts(character.cage, *topology);
    if (!accepted) {
        return Error{accepted.error().code, character.name + ": " + accepted.error().message};
    }

    auto scheme = std::make_shared<SchemeTables>();
    scheme->options = options;
    scheme->tables = surface::prep::buildTables(character.cage, *topology, options);
    std::vector<uint32_t>& words = scheme->tables.words;
    const Status fits = checkTableSize(device, character.name, "p-rep tables", words.size() * 4);
    if (!fits) {
        return fits.error();
    }
    const gpu::StaticRequest request{"supple p-rep tables", kTableUsage, std::as_bytes(std::span(words))};
    Result<gpu::StaticBuffers> buffers = gpu::StaticBuffers::create(device, {&request, 1});
    if (!buffers) {
        return buffers.error();
    }
    scheme->buffers = std::move(*buffers);
    words = {};
    schemes.push_back(scheme);
    return scheme;
}

Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name) {
    const auto refuse = [&](const std::string& reason) { return Error{ErrorCode::asset, name + ": " + reason}; };
    if (desc.positions == nullptr || desc.faceVertexCounts == nullptr || desc.faceVertexIndices == nullptr) {
        return Error{ErrorCode::argument, name + ": positions, faceVertexCounts or faceVertexIndices is null"};
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
        corners += desc.faceVertexCounts[f];
        if (corners > 0x7FFFFFFFu) {
            return refuse("face " + std::to_string(f) + ": more than 2^31 corners");
        }
        cage.faceStarts.push_back(static_cast<uint32_t>(corners));
    }
    cage.faceVertices.assign(desc.faceVertexIndices, desc.faceVertexIndices + corners);
    if (desc.cornerUvs != nullptr) {
        for (uint64_t c = 0; c < corners; ++c) {
            cage.cornerUvs.emplace_back(desc.cornerUvs[2 * c], desc.cornerUvs[2 * c + 1]);
        }
    }

    character.skeleton.nodes.emplace_back();
    character.skeleton.nodes[0].name = name;
    character.skeleton.parentsFirst = {0};
    character.skin.joints = {0};
    character.skin.inverseBinds = {glm::mat4(1.0f)};
    character.weights.starts.resize(size_t{desc.vertexCount} + 1);
    character.weights.influences.resize(desc.vertexCount, {0, 1.0f});
    for (uint32_t v = 0; v <= desc.vertexCount; ++v) {
        character.weights.starts[v] = v;
    }
    character.sourceVertexCount = desc.vertexCount;
    return character;
}

} // namespace supple::runtime
