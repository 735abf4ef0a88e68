#include "runtime/tessellation/own_vertices.h"

#include "gpu/ray_tracing.h"
#include "surface/grid.h"
#include "surface/indexed_mesh.h"

#include <algorithm>
#include <utility>

namespace supple::runtime {

using namespace supple::shared;

Status OwnVertices::setVertexCount(uint64_t vertices) {
    if (Status fits = checkVertices(vertices); built_.outputs.streams.has(Stream::vertices) && !fits) {
        return fits;
    }
    constexpr uint32_t kAttributeBytes = kStreams[static_cast<size_t>(Stream::attributes)].bytes;
    if (built_.outputs.streams.has(Stream::attributes) &&
        vertices * kAttributeBytes > desc_.device->limits.maxStorageBufferRange) {
        return Error{ErrorCode::limit,
                     desc_.asset->character.name + ": surface attributes exceed the device's storage-buffer range"};
    }
    vertexCount_ = static_cast<uint32_t>(vertices);
    evaluation_.verticesPerInstance = (vertexCount_ + kVertexPadding - 1) / kVertexPadding * kVertexPadding;
    return success();
}

BoundBytes OwnVertices::boundBytes() const {
    BoundBytes bytes = Tessellation::boundBytes();
    const SuppleVertexFormat format = static_cast<SuppleVertexFormat>(programOptions().vertexFormat);
    bytes.storage = std::max(bytes.storage, VkDeviceSize{evaluation_.verticesPerInstance} * vertexBytes(format));
    return bytes;
}

Status OwnVertices::cutDraws(InstanceWindows& windows, bool byWindows) {
    const Status status = Tessellation::cutDraws(windows, byWindows);
    const SuppleVertexFormat format = static_cast<SuppleVertexFormat>(programOptions().vertexFormat);
    const VkDeviceSize bytes = VkDeviceSize{evaluation_.verticesPerInstance} * vertexBytes(format);
    return status ? checkBinding(windows, bytes, "surface vertices") : status;
}

void OwnVertices::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) {
    Tessellation::plan(device, staging);
    streams_.plan(device, built_.outputs.streams, static_cast<SuppleVertexFormat>(programOptions().vertexFormat),
                  vertexCount_, evaluation_.verticesPerInstance, desc_.group.capacity,
                  isTraced() ? gpu::kBuildInputUsage : 0);
    attributes_.renew(built_.outputs.streams.has(Stream::attributes));
}

Result<IndexBytes> OwnVertices::layOutMesh(const surface::Evaluation& evaluation, uint32_t vertices) {
    const uint32_t mostIndex = desc_.device->limits.maxDrawIndexedIndexValue;
    if (vertices > mostIndex) {
        return Error{ErrorCode::limit, desc_.asset->character.name + ": " + std::to_string(vertices) +
                                           " vertices of a mesh; an index of this device is at most " +
                                           std::to_string(mostIndex)};
    }
    indexBytes_ = sizeof(uint32_t);
    surface::IndexedMesh mesh = surface::indexedMesh(tables(), evaluation);
    for (const surface::IndexedMesh::Range& from : mesh.ranges) {
        draws_.push_back(
            {0, 1, from.material, SUPPLE_DOMAIN_MESH, vertices, 0, from.firstIndex, from.indexCount, from.part});
    }
    if (const Status fits = checkRayIndices(mesh.indices.size()); !fits) {
        return fits.error();
    }
    if (isTraced()) {
        setRayRanges(mesh);
    }
    return IndexBytes(std::move(mesh.indices));
}

Status OwnVertices::checkRayIndices(uint64_t count) const {
    constexpr uint64_t kMost = UINT32_MAX / sizeof(uint32_t);
    if (isTraced() && count > kMost) {
        return Error{ErrorCode::limit, desc_.asset->character.name + ": " + std::to_string(count / 3) +
                                           " triangles to trace; acceleration structures find at most " +
                                           std::to_string(kMost / 3)};
    }
    return success();
}

void OwnVertices::setRayRanges(const surface::IndexedMesh& mesh) {
    rayRanges_.clear();
    for (const surface::IndexedMesh::Range& range : mesh.ranges) {
        rayRanges_.push_back({range.firstIndex, range.indexCount / 3, range.material, range.part});
    }
}

Status OwnVertices::createIndices(IndexBytes indices, IndexBytes whole) {
    const Tessellation* const before = std::exchange(desc_.before, nullptr);
    const SharedIndices* const known = before != nullptr ? before->indices() : nullptr;
    if (known != nullptr && &before->scheme() == built_.scheme.get() &&
        known->buffers->size(0) == indices.bytes.size()) {
        indices_ = *known;
        return success();
    }
    const VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                                     (isTraced() ? gpu::kBuildInputUsage : 0);
    std::vector<gpu::StaticRequest> requests{{"supple grid indices", usage, indices.bytes, std::move(indices.keeper)}};
    if (isTraced() && wholeList() != 0) {
        requests.push_back({"supple ray indices", usage, whole.bytes, std::move(whole.keeper)});
    }
    Result<gpu::StaticBuffers> statics = gpu::StaticBuffers::create(*desc_.device, requests);
    if (!statics) {
        return statics.error();
    }
    indices_.buffers = std::make_shared<gpu::StaticBuffers>(std::move(*statics));
    return success();
}

void OwnVertices::bindOutput(const SurfaceSets::Which& which, SetContents& contents) const {
    const Stream target = which.previous ? Stream::previousPositions : Stream::vertices;
    const auto bindSlots = [&](uint32_t binding, Stream stream) {
        const VkDeviceSize bytes = VkDeviceSize{evaluation_.verticesPerInstance} * streams_.bytes(stream);
        contents.buffer(binding, streams_.buffer(stream), windows().firstSlot(which.window) * bytes,
                        windows().slots(which.window) * bytes);
    };
    bindSlots(kSurfaceBinding, target);
    // Without a stream, or where only positions are written, the kernels still name it, but do not touch it.
    bindSlots(kTangentBinding, streams_.has(Stream::tangents) && !which.previous ? Stream::tangents : target);
    const bool directed = streams_.size(Stream::directions) > 0;
    contents.buffer(kDirectionBinding,
                    directed ? streams_.buffer(Stream::directions) : memory_.pool(which.pool).buffer(), 0,
                    VK_WHOLE_SIZE);
    bindStatics(which, contents);
}

void OwnVertices::bindStatics(const SurfaceSets::Which& which, SetContents& contents) const {
    for (const StreamRow& row : kStreams) {
        if (row.written == Written::static_) {
            const auto stream = static_cast<Stream>(&row - kStreams);
            const bool there = streams_.size(stream) > 0;
            contents.buffer(row.binding, there ? streams_.buffer(stream) : memory_.pool(which.pool).buffer(), 0,
                            there ? VK_WHOLE_SIZE : VkDeviceSize{16});
        }
    }
}

void OwnVertices::fillGrid(SuppleGridOutput& output) const {
    output.rate = evaluation_.rate;
    output.vertexCount = vertexCount_;
    output.verticesPerInstance = evaluation_.verticesPerInstance;
    output.indices = {indices_.buffers->buffer(0), 0, indices_.buffers->size(0), indexBytes_};
    output.drawRanges = draws_.data();
    output.drawRangeCount = static_cast<uint32_t>(draws_.size());
    output.rates = rates_.data();
    output.rateCount = static_cast<uint32_t>(rates_.size());
}

void OwnVertices::fillRays(SuppleRayGeometry& output) const {
    const size_t list = wholeList();
    const VkBuffer indices = indices_.buffers->buffer(list);
    output.format = VK_FORMAT_R32G32B32_SFLOAT;
    output.vertices = gpu::addressOf(*desc_.device, streams_.buffer(Stream::vertices));
    output.vertexStride = streams_.bytes(Stream::vertices);
    output.instanceStride = evaluation_.verticesPerInstance * output.vertexStride;
    output.indices = gpu::addressOf(*desc_.device, indices);
    output.indexBuffer = {indices, 0, indices_.buffers->size(list), sizeof(uint32_t)};
    output.maxVertex = std::max(vertexCount_, 1u) - 1;
    output.triangleCount = static_cast<uint32_t>(indices_.buffers->size(list) / (3 * sizeof(uint32_t)));
    output.rangeCount = static_cast<uint32_t>(rayRanges_.size());
    output.ranges = rayRanges_.data();
}

void OwnVertices::addTransfers(Transfers& transfers, uint64_t frame) const {
    streams_.addTransfers(transfers, attributes_.recordedIn(frame));
    if (indices_.release.recordedIn(frame)) {
        transfers.add(indices_.buffers->buffer(0));
        if (isTraced() && wholeList() != 0) {
            transfers.add(indices_.buffers->buffer(wholeList()));
        }
    }
}

Status OwnVertices::createSets(const SurfaceInput& input, const InstanceListing& listing,
                               const Visibility& visibility) {
    addMember(*indices_.buffers);
    addMember(indices_.release);
    addMember(attributes_);
    return Tessellation::createSets(input, listing, visibility);
}

void OwnVertices::freeSets() {
    attributes_.renew(built_.outputs.streams.has(Stream::attributes));
    Tessellation::freeSets();
}

VkDeviceSize OwnVertices::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) {
    if (indices_.release.due()) { // the indices are on the device by now
        indices_.release.record(frame);
    }
    return Tessellation::recordUpload(commandBuffer, frame, changed);
}

surface::Window OwnVertices::oneInstance(const surface::Sets& sets) const {
    surface::Window window;
    window.sets = sets;
    window.push.instanceCount = 1;
    return window;
}

void OwnVertices::recordAttributeSteps(gpu::Dispatches& dispatches) const {
    surface::record(dispatches, program_.attributes, oneInstance(sets(0)));
}

PassCost OwnVertices::recordAttributes(gpu::Dispatches& dispatches, uint64_t frame) {
    if (!attributesDue()) {
        return {};
    }
    attributes_.record(frame);
    recordAttributeSteps(dispatches);
    return {vertexCount_, streams_.staticBytes()};
}

void GridDraws::addRate(const surface::Tables& tables, uint32_t rate) {
    Rate& own = rates_.emplace_back();
    own.rate = rate;
    for (const surface::DrawRange& range : tables.drawRanges) {
        Grid& grid = own.grids[static_cast<size_t>(range.domain)];
        if (grid.indexCount == 0) {
            const std::vector<uint16_t> indices = surface::gridIndices(range.domain, rate);
            grid = {static_cast<uint32_t>(indices_.size()), static_cast<uint32_t>(indices.size())};
            indices_.insert(indices_.end(), indices.begin(), indices.end());
        }
    }
}

void GridDraws::append(const surface::Tables& tables, size_t index, uint32_t& firstVertex,
                       std::vector<SuppleDrawRange>& draws) const {
    const Rate& own = rates_[index];
    for (const surface::DrawRange& from : tables.drawRanges) {
        const Grid& grid = own.grids[static_cast<size_t>(from.domain)];
        SuppleDrawRange range{};
        range.domain = static_cast<SuppleDomain>(from.domain);
        range.firstPatch = from.firstPatch;
        range.patchCount = from.patchCount;
        range.material = from.material;
        range.part = from.part;
        range.samplesPerPatch = surface::sampleCount(from.domain, own.rate);
        range.firstVertex = firstVertex;
        range.firstIndex = grid.firstIndex;
        range.indexCount = grid.indexCount;
        firstVertex += range.patchCount * range.samplesPerPatch;
        draws.push_back(range);
    }
}

} // namespace supple::runtime
