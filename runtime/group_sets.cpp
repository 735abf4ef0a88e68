// The descriptor sets of a group: for each window of instances one for the deform pass, and for the surface passes one
// a coefficient pool and kind of output.
#include "runtime/group.h"
#include "runtime/group_buffers.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkFormat kFloat4 = VK_FORMAT_R32G32B32A32_SFLOAT, kUint4 = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat kUint1 = VK_FORMAT_R32_UINT;

VkDescriptorBufferInfo range(VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    return {buffer, offset, size};
}

} // namespace

Status Group::createSets() {
    const gpu::Device& device = *shared_.device;
    const surface::Tables& tables = scheme_->tables;
    const VkDeviceSize poseBytes = poses_.instanceBytes();
    const VkDeviceSize cageBytes = evaluation_.cageStride * kVec4Bytes;
    const VkDeviceSize poolBytes = tables.poolStride * kVec4Bytes;
    const VkDeviceSize scratchBytes = scratchElements() * kVec4Bytes;
    const VkDeviceSize previousBytes = evaluation_.verticesPerInstance * kPreviousPositionBytes;
    const VkDeviceSize patchBytes =
        buffers_.size(kPatchCoefficients) > 0 ? tables.patches.size() * kPatchStride * kVec4Bytes : 0;

    Status status = success();
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const auto allocate = [&](const gpu::ComputeLayout& layout, const gpu::DescriptorPoolHandle& pool,
                              const char* name) {
        VkDescriptorSet allocated = VK_NULL_HANDLE;
        if (status) {
            const Result<VkDescriptorSet> set = gpu::allocateSet(device, layout, pool.get(), name);
            if (set) {
                allocated = *set;
            } else {
                status = set.error();
            }
        }
        return allocated;
    };
    const auto makePool = [&](const gpu::ComputeLayout& layout, size_t sets, const char* name) {
        Result<gpu::DescriptorPoolHandle> pool =
            gpu::createDescriptorPool(device, layout, static_cast<uint32_t>(sets), name);
        if (!pool) {
            status = pool.error();
            return gpu::DescriptorPoolHandle();
        }
        return std::move(*pool);
    };

    const VkBuffer instances = buffers_.buffer(kInstances);
    const VkDescriptorBufferInfo instanceRange = range(instances, 0, VK_WHOLE_SIZE);
    const VkBufferView instanceView = view(instances, kUint1, 0, buffers_.size(kInstances), "supple instances");
    const VkBuffer deformed = buffers_.buffer(kDeformedCage);
    // What surface passes work on may be fewer than what is deformed.
    const VkDescriptorBufferInfo seenRange = culls() ? range(culling_.list(), 0, VK_WHOLE_SIZE) : instanceRange;
    const VkBufferView seenView =
        culls() ? view(culling_.list(), kUint1, 0, culling_.listBytes(), "supple instances seen") : instanceView;

    if (deforms()) {
        deformPool_ = makePool(shared_.deform->layout(), windows_.size(), "supple deform");
        const VkBuffer deformTable = asset_->buffers.buffer(0), poses = buffers_.buffer(kPoses);
        const VkDeviceSize deformTableBytes = asset_->buffers.size(0);
        const VkBufferView deformTableView = view(deformTable, kUint4, 0, deformTableBytes, "supple deform table");
        for (uint32_t w = 0; w < windows_.size(); ++w) {
            const VkDeviceSize first = VkDeviceSize{w} * windowSize_;
            const VkDeviceSize count = std::min<VkDeviceSize>(windowSize_, capacity_ - first);
            windows_[w].deform = allocate(shared_.deform->layout(), deformPool_, "supple deform");
            const gpu::BoundResource resources[] = {
                {kDeformTableBinding, range(deformTable, 0, deformTableBytes), VK_NULL_HANDLE},
                {kDeformTableTexelBinding, {}, deformTableView},
                {kPoseBinding, range(poses, first * poseBytes, count * poseBytes), VK_NULL_HANDLE},
                {kPoseTexelBinding, {}, view(poses, kFloat4, first * poseBytes, count * poseBytes, "supple poses")},
                {kDeformedCageBinding, range(deformed, first * cageBytes, count * cageBytes), VK_NULL_HANDLE},
                {kInstanceBinding, instanceRange, VK_NULL_HANDLE},
                {kInstanceTexelBinding, {}, instanceView},
            };
            if (!status) {
                return status;
            }
            gpu::writeSet(device, windows_[w].deform, resources);
        }
    }

    if (tables.patches.empty()) {
        return status;
    }
    const bool motion = writesMotion();
    const auto ofView = [&](View::BufferIndex index) { return range(view_->buffer(index), 0, VK_WHOLE_SIZE); };
    const VkBufferView words =
        view_ != nullptr ? view(view_->buffer(View::kWords), kUint4, 0, view_->size(View::kWords), "supple view")
                         : VK_NULL_HANDLE;
    const size_t setsOfAll = windows_.size() * std::max<size_t>(rates_.size(), 1);
    surfacePool_ = makePool(shared_.surface->layout(), setsOfAll * (motion ? 4 : 1), "supple surface");
    VkBuffer table = VK_NULL_HANDLE; // of a rate, where there are several
    VkDeviceSize tableBytes = 0;
    VkBufferView table4 = VK_NULL_HANDLE, table1 = VK_NULL_HANDLE;
    for (size_t s = 0; s < setsOfAll; ++s) {
        const size_t w = s % windows_.size(), r = s / windows_.size();
        SurfaceSets sets;
        if (w == 0) {
            const SchemeTables& scheme = hasRates() ? *rates_[r].scheme : *scheme_;
            table = scheme.buffers.buffer(0);
            tableBytes = scheme.buffers.size(0);
            table4 = view(table, kUint4, 0, tableBytes, "supple surface tables");
            table1 = view(table, kUint1, 0, tableBytes, "supple surface table words");
        }
        const VkDeviceSize first = VkDeviceSize{w} * windowSize_;
        const VkDeviceSize count = std::min<VkDeviceSize>(windowSize_, capacity_ - first);
        const auto window = [&](BufferIndex index, VkDeviceSize bytes) {
            return range(buffers_.buffer(index), first * bytes, count * bytes);
        };
        const VkBufferView cageView =
            view(deformed, kFloat4, first * cageBytes, count * cageBytes, "supple deformed cage");
        for (uint32_t p = 0; p < (motion ? 2u : 1u); ++p) {
            const BufferIndex poolIndex = p == 0 ? kPool : kSecondPool;
            const VkBuffer pool = buffers_.buffer(poolIndex);
            const VkBufferView poolView = view(pool, kFloat4, first * poolBytes, count * poolBytes, "supple pool");
            // Bindings a group does without point at the pool: every binding of the layout must be valid.
            const VkDescriptorBufferInfo unused = range(pool, first * poolBytes, kVec4Bytes);
            const auto wholeOr = [&](BufferIndex index, View::BufferIndex shared) {
                if (hasLevels()) {
                    // Not the pool: attributes are evaluated in every frame, beside what reads it.
                    return view_->size(shared) > 0 ? ofView(shared) : ofView(View::kSurface);
                }
                return buffers_.size(index) > 0 ? range(buffers_.buffer(index), 0, VK_WHOLE_SIZE) : unused;
            };
            const VkBufferView scratchView = scratchBytes > 0
                                                 ? view(buffers_.buffer(kScratch), kFloat4, first * scratchBytes,
                                                        count * scratchBytes, "supple fragments")
                                                 : poolView;
            for (const bool previous : {false, true}) {
                if (previous && !motion) {
                    continue;
                }
                VkDescriptorSet& set = (previous ? sets.motion : sets.surface)[p];
                set = allocate(shared_.surface->layout(), surfacePool_, "supple surface");
                // Levels of detail, previous positions: today's coefficients in the place of the cage, which no
                // evaluation reads (shaders/evaluate/bicubic.comp, shaders/kernel/net.glsl).
                const bool today = previous && view_ != nullptr;
                const BufferIndex other = p == 0 ? kSecondPool : kPool;
                const VkBufferView otherView =
                    today ? view(buffers_.buffer(other), kFloat4, first * poolBytes, count * poolBytes, "supple pool")
                          : cageView;
                const VkDescriptorBufferInfo vertices =
                    hasLevels() ? ofView(previous ? View::kPreviousPositions : View::kSurface)
                    : previous  ? window(kPreviousPositions, previousBytes)
                                : window(kSurface, surfaceBytes());
                const gpu::BoundResource resources[] = {
                    {kTableBinding, range(table, 0, tableBytes), VK_NULL_HANDLE},
                    {kTable4TexelBinding, {}, table4},
                    {kTable1TexelBinding, {}, table1},
                    {kCageBinding, today ? window(other, poolBytes) : window(kDeformedCage, cageBytes), VK_NULL_HANDLE},
                    {kCageTexelBinding, {}, otherView},
                    {kPoolBinding, window(poolIndex, poolBytes), VK_NULL_HANDLE},
                    {kPoolTexelBinding, {}, poolView},
                    {kSurfaceBinding, vertices, VK_NULL_HANDLE},
                    {kPatchCoefficientBinding, patchBytes > 0 ? window(kPatchCoefficients, patchBytes) : unused,
                     VK_NULL_HANDLE},
                    {kAttributeBinding, wholeOr(kAttributes, View::kAttributes), VK_NULL_HANDLE},
                    {kUv1Binding, wholeOr(kUvs1, View::kUvs1), VK_NULL_HANDLE},
                    {kFaceUvBinding, wholeOr(kFaceUvs, View::kFaceUvs), VK_NULL_HANDLE},
                    {kPairBinding, range(shared_.pairs, 0, shared_.pairBytes), VK_NULL_HANDLE},
                    {kScratchBinding, scratchBytes > 0 ? window(kScratch, scratchBytes) : unused, VK_NULL_HANDLE},
                    {kScratchTexelBinding, {}, scratchView},
                    {kInstanceBinding, seenRange, VK_NULL_HANDLE},
                    {kInstanceTexelBinding, {}, seenView},
                    {kLodBinding, view_ != nullptr ? ofView(View::kWords) : range(table, 0, tableBytes),
                     VK_NULL_HANDLE},
                    {kLodTexelBinding, {}, view_ != nullptr ? words : table4},
                };
                if (!status) {
                    return status;
                }
                gpu::writeSet(device, set, resources);
            }
        }
        static_cast<SurfaceSets&>(windows_[w]) = sets; // rates: the finest's remain
        if (hasRates()) {
            rates_[r].windows.push_back(sets);
        }
    }
    return status;
}

} // namespace supple::runtime
