#include "runtime/group.h"

#include "surface/grid.h"

#include <algorithm>
#include <array>
#include <bit>

namespace supple::runtime {

namespace {

using namespace supple::shared;

enum BufferIndex : size_t {
    kPoses,
    kDeformedCage,
    kPool,
    kSurface,
    kPatchCoefficients,
    kAttributes,
    kUvs1,
    kFaceUvs,
    kScratch,
    kBufferCount
};
enum StaticIndex : size_t { kGridIndices, kIndirect };

constexpr VkDeviceSize kVec4Bytes = 16;

// supple.h repeats for C what the shaders and the schemes share.
static_assert(SUPPLE_MAX_RATE == surface::kMaxRate);
static_assert(SUPPLE_MAX_SIDES == surface::kMaxSides);
static_assert(SUPPLE_PATCH_STRIDE == kPatchStride);
static_assert(SUPPLE_DOMAIN_QUAD == kQuadDomain && SUPPLE_DOMAIN_POLAR == kPolarDomain &&
              SUPPLE_DOMAIN_TRIANGLE == kTriangleDomain && SUPPLE_DOMAIN_PENTAGON == kPentagonDomain);
static_assert(SUPPLE_PATCH_REGULAR == kRegularPatch && SUPPLE_PATCH_PERTURBED == kPerturbedPatch &&
              SUPPLE_PATCH_POLAR == kPolarPatch && SUPPLE_PATCH_P3 == kP3Patch && SUPPLE_PATCH_P4 == kP4Patch &&
              SUPPLE_PATCH_P5 == kP5Patch && SUPPLE_PATCH_CATMULL_CLARK == kCatmullClarkPatch &&
              SUPPLE_PATCH_LOOP == kLoopPatch && SUPPLE_PATCH_BLEND == kBlendPatch &&
              SUPPLE_PATCH_BLEND_SHARP == kBlendSharpPatch);

// Descriptor offsets need at most 256-byte alignment (VkPhysicalDeviceLimits): instances of the pool, the deformed cage
// and the surface vertices (16 or 24 bytes each) start on such multiples.
constexpr uint32_t kCagePadding = 16;
constexpr uint32_t kVertexPadding = 32;
// Poses are packed: sixteen of them end on a multiple of 256 bytes whatever the joint count.
constexpr uint32_t kDeformWindowMultiple = 16;

uint32_t roundUp(uint32_t value, uint32_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

VkDescriptorBufferInfo range(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    return {buffer, offset, size};
}

} // namespace

Result<std::shared_ptr<Group>> Group::create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                             const SuppleGroupDesc& desc) {
    auto group = std::make_shared<Group>();
    group->shared_ = shared;
    const uint32_t rate = desc.rate == 0 ? 8 : desc.rate;
    surface::Recipe recipe;
    if (desc.scheme != SUPPLE_SCHEME_AUTO && desc.scheme != SUPPLE_SCHEME_CAGE) {
        recipe.scheme = static_cast<surface::SchemeId>(desc.scheme);
    }
    if (surface::subdivides(recipe.scheme)) {
        recipe.rate = std::bit_ceil(rate);
    } else if (recipe.scheme == surface::SchemeId::blend) {
        recipe.rate = rate;
        recipe.blend.creases = desc.creaseMode == SUPPLE_CREASES_CURVE ? surface::blend::CreaseMode::curve
                                                                       : surface::blend::CreaseMode::cut;
        recipe.blend.sharpThreshold = desc.sharpThreshold > 0.0f ? desc.sharpThreshold : 1.0f;
    }
    if (recipe.scheme == surface::SchemeId::prep) {
        recipe.prep.tangentMode = desc.tangentMode == SUPPLE_TANGENTS_PRINTED ? surface::prep::TangentMode::printed
                                                                              : surface::prep::TangentMode::standard;
        recipe.prep.cornerRule = desc.cornerRule == SUPPLE_CORNERS_SMOOTH ? surface::prep::CornerRule::smooth
                                                                          : surface::prep::CornerRule::sharp;
    }
    if (desc.scheme == SUPPLE_SCHEME_CAGE) {
        group->scheme_ = std::make_shared<SchemeTables>(); // no patches: every surface pass is empty
    } else {
        Result<std::shared_ptr<SchemeTables>> scheme = asset->tablesFor(*shared.device, recipe);
        if (!scheme) {
            return scheme.error();
        }
        group->scheme_ = *scheme;
    }
    group->asset_ = std::move(asset);
    group->instanceCount_ = desc.instanceCount;

    const surface::Tables& tables = group->scheme_->tables;
    group->evaluation_.rate = rate;
    if (surface::hasRate(recipe.scheme)) {
        if ((desc.flags & SUPPLE_GROUP_PATCHES) != 0) {
            return Error{ErrorCode::argument, group->asset_->character.name + ": " +
                                                  surface::schemeName(recipe.scheme) + " has no patch coefficients"};
        }
        group->evaluation_.rate = tables.rate;
        const uint32_t taken = tables.rate << tables.isolationSteps;
        if (taken != rate) {
            group->notes_.push_back("rate " + std::to_string(rate) + ": " + surface::schemeName(recipe.scheme) +
                                    (surface::subdivides(recipe.scheme) ? " has 2, 4, 8.." : " has an even number of") +
                                    " segments an edge of the cage, here " + std::to_string(taken));
        }
    }
    group->evaluation_.vertex24 = desc.vertexFormat == SUPPLE_VERTEX_24;
    const uint64_t vertices = group->evaluation_.layOut(group->scheme_->tables);
    // Vertex indices are 32 bits on the device.
    if ((vertices + kVertexPadding) * desc.instanceCount > 0xFFFFFFFFull) {
        return Error{ErrorCode::limit, group->asset_->character.name + ": " + std::to_string(desc.instanceCount) +
                                           " instances at rate " + std::to_string(rate) +
                                           " need more than 2^32 surface vertices"};
    }
    group->vertexCount_ = static_cast<uint32_t>(vertices);
    group->evaluation_.verticesPerInstance = roundUp(group->vertexCount_, kVertexPadding);
    group->evaluation_.cageStride = roundUp(group->asset_->character.cage.vertexCount(), kCagePadding);

    group->poses_ =
        InstancePoses(*group->asset_, desc.instanceCount,
                      desc.skinning == SUPPLE_SKINNING_DUAL_QUATERNION ? skinning::SkinningMode::dualQuaternion
                                                                       : skinning::SkinningMode::linear);

    Status status = group->createBuffers(desc);
    if (status) {
        status = group->createSets();
    }
    if (!status) {
        return Error{status.error().code, group->asset_->character.name + ": " + status.error().message};
    }
    group->fillOutput(desc);
    return group;
}

Status Group::createBuffers(const SuppleGroupDesc& desc) {
    const gpu::Device& device = *shared_.device;
    const surface::Tables& tables = scheme_->tables;
    const VkDeviceSize n = instanceCount_;
    const VkDeviceSize vertexBytes = evaluation_.vertex24 ? 24 : 16;
    const VkDeviceSize patches = tables.patches.size();
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    constexpr VkBufferUsageFlags kOutput = kStorage | kTexels | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

    std::vector<gpu::BufferRequest> requests(kBufferCount);
    requests[kPoses] = {"supple poses", n * poses_.instanceBytes(),
                        kStorage | kTexels | VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    requests[kDeformedCage] = {"supple deformed cage", n * evaluation_.cageStride * kVec4Bytes,
                               kOutput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    requests[kPool] = {"supple coefficient pool", n * tables.poolStride * kVec4Bytes,
                       kStorage | kTexels | VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    requests[kSurface] = {"supple surface vertices", n * evaluation_.verticesPerInstance * vertexBytes,
                          kOutput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    requests[kPatchCoefficients] = {
        "supple patch coefficients",
        (desc.flags & SUPPLE_GROUP_PATCHES) != 0 ? n * patches * kPatchStride * kVec4Bytes : 0, kOutput};
    requests[kAttributes] = {"supple surface attributes",
                             (desc.flags & SUPPLE_GROUP_ATTRIBUTES) != 0 ? VkDeviceSize{vertexCount_} * 16 : 0,
                             kOutput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    requests[kUvs1] = {"supple second UV set", tables.uvSets == 2 ? requests[kAttributes].size / 2 : 0,
                       kOutput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    requests[kFaceUvs] = {"supple face UVs", tables.faceUvs ? requests[kAttributes].size / 2 : 0,
                          kOutput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    requests[kScratch] = {"supple fragments", n * shared_.surface->scratchStride(tables) * kVec4Bytes,
                          kStorage | kTexels};
    attributesPending_ = requests[kAttributes].size > 0;
    if (requests[kAttributes].size > device.limits.maxStorageBufferRange) {
        return Error{ErrorCode::limit, "surface attributes exceed the device's storage-buffer range"};
    }
    Result<gpu::BufferSet> buffers = gpu::BufferSet::create(device, requests, gpu::MemoryKind::deviceLocal);
    if (!buffers) {
        return buffers.error();
    }
    buffers_ = std::move(*buffers);

    const gpu::BufferRequest staging{"supple pose staging", requests[kPoses].size * shared_.framesInFlight,
                                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    Result<gpu::BufferSet> stagingSet = gpu::BufferSet::create(device, {&staging, 1}, gpu::MemoryKind::upload);
    if (!stagingSet) {
        return stagingSet.error();
    }
    staging_ = std::move(*stagingSet);

    // The indices of every domain in use, one after the other, and the draw ranges over them.
    std::vector<uint16_t> indices;
    std::array<SuppleDrawRange, surface::kDomainCount> domains{};
    std::vector<VkDrawIndexedIndirectCommand> indirect;
    for (const surface::DrawRange& drawRange : tables.drawRanges) {
        SuppleDrawRange& grid = domains[static_cast<size_t>(drawRange.domain)];
        if (grid.indexCount == 0) {
            const std::vector<uint16_t> own = surface::gridIndices(drawRange.domain, evaluation_.rate);
            grid.firstIndex = static_cast<uint32_t>(indices.size());
            grid.indexCount = static_cast<uint32_t>(own.size());
            grid.samplesPerPatch = surface::sampleCount(drawRange.domain, evaluation_.rate);
            indices.insert(indices.end(), own.begin(), own.end());
        }
        SuppleDrawRange range = grid;
        range.domain = static_cast<SuppleDomain>(drawRange.domain);
        range.firstPatch = drawRange.firstPatch;
        range.patchCount = drawRange.patchCount;
        range.material = drawRange.material;
        if (!drawRanges_.empty()) {
            const SuppleDrawRange& last = drawRanges_.back();
            range.firstVertex = last.firstVertex + last.patchCount * last.samplesPerPatch;
        }
        drawRanges_.push_back(range);
        indirect.push_back({range.indexCount, range.patchCount * instanceCount_, range.firstIndex, 0, 0});
    }
    const gpu::StaticRequest staticRequests[] = {
        {"supple grid indices", kOutput | VK_BUFFER_USAGE_INDEX_BUFFER_BIT, std::as_bytes(std::span(indices))},
        {"supple indirect arguments", kOutput | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
         std::as_bytes(std::span(indirect))}};
    Result<gpu::StaticBuffers> statics = gpu::StaticBuffers::create(device, staticRequests);
    if (!statics) {
        return statics.error();
    }
    static_ = std::move(*statics);
    return success();
}

Status Group::createSets() {
    const gpu::Device& device = *shared_.device;
    const surface::Tables& tables = scheme_->tables;
    const VkDeviceSize vertexBytes = evaluation_.vertex24 ? 24 : 16;
    const VkDeviceSize poseBytes = poses_.instanceBytes();
    const VkDeviceSize cageBytes = evaluation_.cageStride * kVec4Bytes;
    const VkDeviceSize poolBytes = tables.poolStride * kVec4Bytes;
    const VkDeviceSize surfaceBytes = evaluation_.verticesPerInstance * vertexBytes;
    const VkDeviceSize patchBytes =
        buffers_.size(kPatchCoefficients) > 0 ? tables.patches.size() * kPatchStride * kVec4Bytes : 0;

    // As many instances a window as every bound range can hold.
    const VkDeviceSize texelLimit = device.bufferWindow(16), storageLimit = device.limits.maxStorageBufferRange;
    VkDeviceSize deformFit = texelLimit / std::max(poseBytes, cageBytes);
    if (deformFit < instanceCount_) {
        deformFit = deformFit / kDeformWindowMultiple * kDeformWindowMultiple;
    }
    VkDeviceSize surfaceFit = instanceCount_;
    const VkDeviceSize scratchBytes = shared_.surface->scratchStride(tables) * kVec4Bytes;
    for (const VkDeviceSize bytes : {surfaceBytes, patchBytes}) {
        surfaceFit = bytes > 0 ? std::min(surfaceFit, storageLimit / bytes) : surfaceFit;
    }
    surfaceFit = std::min(surfaceFit, texelLimit / std::max({cageBytes, poolBytes, scratchBytes}));
    if (deformFit == 0 || surfaceFit == 0) {
        return Error{ErrorCode::limit,
                     std::string(surfaceFit == 0 ? "one instance's surface" : "sixteen instances' cages") +
                         " exceed the device's storage-buffer range of " + std::to_string(storageLimit) + " bytes"};
    }
    const auto deformWindow = static_cast<uint32_t>(std::min<VkDeviceSize>(deformFit, instanceCount_));
    const auto surfaceWindow = static_cast<uint32_t>(std::min<VkDeviceSize>(surfaceFit, instanceCount_));
    const uint32_t deformCount = (instanceCount_ + deformWindow - 1) / deformWindow;
    const uint32_t surfaceCount = (instanceCount_ + surfaceWindow - 1) / surfaceWindow;

    Status status = success();
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size,
                          const char* name) -> VkBufferView {
        Result<gpu::BufferViewHandle> result = gpu::createTexelView(device, buffer, format, offset, size, name);
        if (!result) {
            status = result.error();
            return VK_NULL_HANDLE;
        }
        views_.push_back(std::move(*result));
        return views_.back().get();
    };
    constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT, kUint4 = VK_FORMAT_R32G32B32A32_UINT;

    Result<gpu::DescriptorPoolHandle> pool =
        gpu::createDescriptorPool(device, shared_.deform->layout(), deformCount, "supple deform");
    if (!pool) {
        return pool.error();
    }
    deformPool_ = std::move(*pool);
    const VkBuffer deformTable = asset_->buffers.buffer(0);
    const VkDeviceSize deformTableBytes = asset_->buffers.size(0);
    const VkBufferView deformTableView = view(deformTable, kUint4, 0, deformTableBytes, "supple deform table");
    for (uint32_t w = 0; w < deformCount && status.ok(); ++w) {
        const uint32_t first = w * deformWindow, count = std::min(deformWindow, instanceCount_ - first);
        Result<VkDescriptorSet> set =
            gpu::allocateSet(device, shared_.deform->layout(), deformPool_.get(), "supple deform");
        if (!set) {
            return set.error();
        }
        const VkBuffer poses = buffers_.buffer(kPoses), deformed = buffers_.buffer(kDeformedCage);
        const gpu::BoundResource resources[] = {
            {kDeformTableBinding, range(deformTable, 0, deformTableBytes), VK_NULL_HANDLE},
            {kDeformTableTexelBinding, {}, deformTableView},
            {kPoseBinding, range(poses, first * poseBytes, count * poseBytes), VK_NULL_HANDLE},
            {kPoseTexelBinding, {}, view(poses, kFloat4, first * poseBytes, count * poseBytes, "supple poses")},
            {kDeformedCageBinding, range(deformed, first * cageBytes, count * cageBytes), VK_NULL_HANDLE},
        };
        if (!status) {
            return status;
        }
        gpu::writeSet(device, *set, resources);
        deformWindows_.push_back({*set, count});
    }

    if (tables.patches.empty()) {
        return status;
    }
    pool = gpu::createDescriptorPool(device, shared_.surface->layout(), surfaceCount, "supple surface");
    if (!pool) {
        return pool.error();
    }
    surfacePool_ = std::move(*pool);
    const VkBuffer table = scheme_->buffers.buffer(0);
    const VkDeviceSize tableBytes = scheme_->buffers.size(0);
    const VkBufferView table4 = view(table, kUint4, 0, tableBytes, "supple surface tables");
    const VkBufferView table1 = view(table, VK_FORMAT_R32_UINT, 0, tableBytes, "supple surface table words");
    for (uint32_t w = 0; w < surfaceCount && status.ok(); ++w) {
        const uint32_t first = w * surfaceWindow, count = std::min(surfaceWindow, instanceCount_ - first);
        Result<VkDescriptorSet> set =
            gpu::allocateSet(device, shared_.surface->layout(), surfacePool_.get(), "supple surface");
        if (!set) {
            return set.error();
        }
        const VkBuffer cage = buffers_.buffer(kDeformedCage), coefficients = buffers_.buffer(kPool);
        // Bindings a group does without point at the pool: every binding of the layout must be valid.
        const VkDescriptorBufferInfo unused = range(coefficients, first * poolBytes, kVec4Bytes);
        const bool patches = patchBytes > 0, attributes = buffers_.size(kAttributes) > 0;
        const VkBufferView poolView = view(coefficients, kFloat4, first * poolBytes, count * poolBytes, "supple pool");
        const VkBuffer scratch = buffers_.buffer(kScratch);
        const gpu::BoundResource resources[] = {
            {kTableBinding, range(table, 0, tableBytes), VK_NULL_HANDLE},
            {kTable4TexelBinding, {}, table4},
            {kTable1TexelBinding, {}, table1},
            {kCageBinding, range(cage, first * cageBytes, count * cageBytes), VK_NULL_HANDLE},
            {kCageTexelBinding, {}, view(cage, kFloat4, first * cageBytes, count * cageBytes, "supple deformed cage")},
            {kPoolBinding, range(coefficients, first * poolBytes, count * poolBytes), VK_NULL_HANDLE},
            {kPoolTexelBinding, {}, poolView},
            {kSurfaceBinding, range(buffers_.buffer(kSurface), first * surfaceBytes, count * surfaceBytes),
             VK_NULL_HANDLE},
            {kPatchCoefficientBinding,
             patches ? range(buffers_.buffer(kPatchCoefficients), first * patchBytes, count * patchBytes) : unused,
             VK_NULL_HANDLE},
            {kAttributeBinding, attributes ? range(buffers_.buffer(kAttributes), 0, VK_WHOLE_SIZE) : unused,
             VK_NULL_HANDLE},
            {kUv1Binding, buffers_.size(kUvs1) > 0 ? range(buffers_.buffer(kUvs1), 0, VK_WHOLE_SIZE) : unused,
             VK_NULL_HANDLE},
            {kFaceUvBinding, buffers_.size(kFaceUvs) > 0 ? range(buffers_.buffer(kFaceUvs), 0, VK_WHOLE_SIZE) : unused,
             VK_NULL_HANDLE},
            {kPairBinding, range(shared_.pairs, 0, shared_.pairBytes), VK_NULL_HANDLE},
            {kScratchBinding, scratchBytes > 0 ? range(scratch, first * scratchBytes, count * scratchBytes) : unused,
             VK_NULL_HANDLE},
            {kScratchTexelBinding,
             {},
             scratchBytes > 0 ? view(scratch, kFloat4, first * scratchBytes, count * scratchBytes, "supple fragments")
                              : poolView},
        };
        if (!status) {
            return status;
        }
        gpu::writeSet(device, *set, resources);
        surfaceWindows_.push_back({*set, count});
    }
    return status;
}

void Group::fillOutput(const SuppleGroupDesc& desc) {
    const auto whole = [&](BufferIndex index, uint32_t stride) {
        return SuppleBufferView{buffers_.buffer(index), 0, buffers_.size(index), stride};
    };
    SuppleGroupOutput& o = output_;
    o.structSize = sizeof(o);
    o.instanceCount = instanceCount_;
    o.rate = evaluation_.rate;
    o.vertexFormat = desc.vertexFormat;
    o.patchCount = static_cast<uint32_t>(scheme_->tables.patches.size());
    o.vertexCount = vertexCount_;
    o.verticesPerInstance = evaluation_.verticesPerInstance;
    o.cageVertexCount = asset_->character.cage.vertexCount();
    o.cageVerticesPerInstance = evaluation_.cageStride;
    o.surfaceVertices = whole(kSurface, evaluation_.vertex24 ? 24 : 16);
    o.attributes = whole(kAttributes, 16);
    o.uvs1 = whole(kUvs1, 8);
    o.faceUvs = whole(kFaceUvs, 8);
    o.deformedCage = whole(kDeformedCage, 16);
    o.patchCoefficients = whole(kPatchCoefficients, 16);
    o.gridIndices = {static_.buffer(kGridIndices), 0, static_.size(kGridIndices), 2};
    o.indirect = {static_.buffer(kIndirect), 0, static_.size(kIndirect), sizeof(VkDrawIndexedIndirectCommand)};
    o.drawRanges = drawRanges_.data();
    o.drawRangeCount = static_cast<uint32_t>(drawRanges_.size());
    o.deviceBytes = buffers_.allocatedBytes() + static_.deviceBytes();
}

Result<Group::PassCost> Group::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    const gpu::Device& device = *shared_.device;
    lastRecordedFrame_ = frame;
    PassCost cost;
    cost.bytes += asset_->buffers.recordUpload(commandBuffer, frame);
    cost.bytes += scheme_->buffers.recordUpload(commandBuffer, frame);
    cost.bytes += static_.recordUpload(commandBuffer, frame);
    if (!cleared_ && buffers_.size(kPool) > 0) {
        // The zero coefficient and the slots no stage writes.
        device.vk.CmdFillBuffer(commandBuffer, buffers_.buffer(kPool), 0, VK_WHOLE_SIZE, 0);
        cleared_ = true;
    }
    const VkDeviceSize bytes = buffers_.size(kPoses);
    const VkDeviceSize offset = frame % shared_.framesInFlight * bytes;
    poses_.write(staging_.mapped(0) + offset);
    const Status flushed = staging_.flush(0, offset, bytes);
    if (!flushed) {
        return flushed.error();
    }
    const VkBufferCopy copy{offset, 0, bytes};
    device.vk.CmdCopyBuffer(commandBuffer, staging_.buffer(0), buffers_.buffer(kPoses), 1, &copy);
    cost.points = uint64_t{poses_.layout().jointCount} * instanceCount_;
    cost.bytes += bytes;
    return cost;
}

Group::PassCost Group::recordAttributes(VkCommandBuffer commandBuffer) {
    if (!attributesPending_) {
        return {};
    }
    attributesPending_ = false;
    shared_.surface->recordAttributes(commandBuffer, scheme_->tables, surfaceWindows_.front(), evaluation_);
    return {vertexCount_, buffers_.size(kAttributes) + buffers_.size(kUvs1) + buffers_.size(kFaceUvs)};
}

Group::PassCost Group::recordDeform(VkCommandBuffer commandBuffer) const {
    const skinning::PoseLayout& layout = poses_.layout();
    for (const DeformWindow& window : deformWindows_) {
        shared_.deform->record(commandBuffer, window.set, layout.mode,
                               {output_.cageVertexCount, window.instanceCount, layout.stride, evaluation_.cageStride,
                                layout.morphWeights, asset_->firstInfluences});
    }
    const uint64_t points = uint64_t{output_.cageVertexCount} * instanceCount_;
    return {points, points * kVec4Bytes};
}

Group::PassCost Group::recordStage(VkCommandBuffer commandBuffer, surface::Stage stage) const {
    for (const surface::Window& window : surfaceWindows_) {
        shared_.surface->recordStage(commandBuffer, stage, scheme_->tables, window, evaluation_);
    }
    PassCost cost;
    for (const surface::Construction& c : scheme_->tables.constructions) {
        if (c.stage == stage) {
            cost.points += uint64_t{c.section.count} * instanceCount_;
            cost.bytes += uint64_t{c.coefficients} * instanceCount_ * kVec4Bytes;
        }
    }
    return cost;
}

Group::PassCost Group::recordPatch(VkCommandBuffer commandBuffer) const {
    for (const surface::Window& window : surfaceWindows_) {
        shared_.surface->recordPatch(commandBuffer, scheme_->tables, window, evaluation_);
    }
    const uint64_t points = uint64_t{output_.patchCount} * instanceCount_;
    return {points, points * kPatchStride * kVec4Bytes};
}

Group::PassCost Group::recordEvaluate(VkCommandBuffer commandBuffer) const {
    for (const surface::Window& window : surfaceWindows_) {
        shared_.surface->recordEvaluate(commandBuffer, scheme_->tables, window, evaluation_);
    }
    const uint64_t points = uint64_t{vertexCount_} * instanceCount_;
    return {points, points * output_.surfaceVertices.stride};
}

void Group::releaseStaging(uint64_t completedFrame) {
    asset_->buffers.releaseStaging(completedFrame);
    scheme_->buffers.releaseStaging(completedFrame);
    static_.releaseStaging(completedFrame);
}

} // namespace supple::runtime
