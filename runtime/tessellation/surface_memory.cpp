#include "runtime/tessellation/surface_memory.h"

#include <algorithm>
#include <vector>

namespace supple::runtime {

using namespace supple::shared;
using surface::SetKind;

namespace {

constexpr VkFormat kUint1 = VK_FORMAT_R32_UINT;

/// The kinds of sets that a program binds.
std::vector<SetKind> setKindsOf(const surface::Program& program) {
    std::vector<SetKind> kinds;
    for (const surface::Steps* steps : {&program.vertex, &program.assemble, &program.patch, &program.attributes,
                                        &program.edgeLevels, &program.patchLevels, &program.depths, &program.places,
                                        &program.deepen, &program.evaluate, &program.motion}) {
        for (const surface::Step& step : *steps) {
            if (std::find(kinds.begin(), kinds.end(), step.sets) == kinds.end()) {
                kinds.push_back(step.sets);
            }
        }
    }
    return kinds;
}

} // namespace

void SurfaceMemory::plan(const Desc& desc, gpu::BufferPlan& device) {
    desc_ = desc;
    constexpr VkBufferUsageFlags kScratch =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    constexpr VkBufferUsageFlags kPool =
        kScratch | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT; // hosts may read it
    constexpr gpu::MemoryPurpose kCoefficients = gpu::MemoryPurpose::coefficients;
    const VkDeviceSize n = desc.capacity;
    const VkDeviceSize poolBytes = n * desc.poolStride * gpu::kVec4Bytes;
    pools_ = desc.leader != nullptr ? desc.leader->pools_ : desc.pools;
    if (ownsPools()) {
        pools_[0] = device.add({"supple coefficient pool", poolBytes, kPool, kCoefficients});
        pools_[1] = device.add({"supple second coefficient pool", desc.motion ? poolBytes : 0, kPool, kCoefficients});
    }
    patches_ = device.add({"supple patch coefficients",
                           desc.patches ? n * desc.patchCount * kPatchStride * gpu::kVec4Bytes : 0,
                           kScratch | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kCoefficients});
    const VkBufferUsageFlags sizes = desc.sizesInScratch ? VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT : 0;
    scratch_ = device.add(
        {"supple scratch", n * desc.scratchStride * gpu::kVec4Bytes, kScratch | sizes, gpu::MemoryPurpose::scratch});
}

void SurfaceMemory::attach(const SurfaceInput& input, const InstanceListing& listing, const InstanceList& list) {
    input_ = input;
    listing_ = &listing;
    list_ = list;
    attach();
}

void SurfaceMemory::attach() {
    for (const gpu::PlannedBuffer& pool : pools_) {
        if (ownsPools()) {
            clear_.add(*desc_.device, pool);
        }
    }
}

Status SurfaceMemory::makeSets(SurfaceSets& target, const gpu::StaticBuffers& tables, const surface::Program& program,
                               const BindOutput& bindOutput) const {
    const std::vector<SetKind> kinds = setKindsOf(program);
    return target.create({desc_.device, desc_.programs, kinds, listing_->windows().count(), hasMotion()},
                         [&](const SurfaceSets::Which& which, SetContents& contents) {
                             bindInput(which, tables, contents);
                             bindOutput(which, contents);
                         });
}

void SurfaceMemory::bindInput(const SurfaceSets::Which& which, const gpu::StaticBuffers& tables,
                              SetContents& contents) const {
    const InstanceWindows& windows = listing_->windows();
    const VkDeviceSize first = windows.firstSlot(which.window), count = windows.slots(which.window);
    const auto bind = [&](uint32_t binding, uint32_t texels, const gpu::PlannedBuffer& buffer, uint32_t stride,
                          const char* name) {
        const VkDeviceSize bytes = stride * gpu::kVec4Bytes;
        contents.buffer(binding, buffer.buffer(), first * bytes, count * bytes);
        contents.texels(texels, gpu::kFloat4, buffer.buffer(), first * bytes, count * bytes, name);
    };
    const VkBuffer table = tables.buffer(0);
    const VkDeviceSize tableBytes = tables.size(0);
    contents.buffer(kTableHeaderBinding, table, 0, sizeof(TableHeader));
    contents.buffer(kTableBinding, table, 0, tableBytes);
    contents.texels(kTable4TexelBinding, gpu::kUint4, table, 0, tableBytes, "supple surface tables");
    contents.texels(kTable1TexelBinding, kUint1, table, 0, tableBytes, "supple surface table words");
    const auto bindPool = [&](uint32_t binding, uint32_t texels, const gpu::PlannedBuffer& pool) {
        const VkDeviceSize bytes = sharesPools() ? 0 : desc_.poolStride * gpu::kVec4Bytes;
        const VkDeviceSize size = sharesPools() ? pool.size() : count * bytes;
        contents.buffer(binding, pool.buffer(), first * bytes, size);
        contents.texels(texels, gpu::kFloat4, pool.buffer(), first * bytes, size, "supple pool");
    };
    bindPool(kPoolBinding, kPoolTexelBinding, pools_[which.pool]);
    // Without previous positions in a view kernels name it, but do not read it.
    const bool today = which.previous && desc_.inView;
    bindPool(kTodaysPoolBinding, kTodaysPoolTexelBinding, pools_[today ? 1 - which.pool : which.pool]);
    bind(kCageBinding, kCageTexelBinding, input_.cages, desc_.cageStride, "supple deformed cage");
    if (input_.creaseAlphas.size() > 0) {
        bind(kAlphaBinding, kAlphaTexelBinding, input_.creaseAlphas, kCreaseSetElements, "supple crease alphas");
    } else { // some kernels name it but never read it
        bind(kAlphaBinding, kAlphaTexelBinding, input_.cages, desc_.cageStride, "supple deformed cage");
    }
    if (scratch_.size() > 0) {
        bind(kScratchBinding, kScratchTexelBinding, scratch_, desc_.scratchStride, "supple scratch");
    } else { // some kernels name it but never read it
        bindPool(kScratchBinding, kScratchTexelBinding, pools_[which.pool]);
    }
    if (patches_.size() > 0) {
        const VkDeviceSize bytes = VkDeviceSize{desc_.patchCount} * kPatchStride * gpu::kVec4Bytes;
        contents.buffer(kPatchCoefficientBinding, patches_.buffer(), first * bytes, count * bytes);
    }
    contents.buffer(kPairBinding, desc_.pairs->buffer(0), 0, desc_.pairs->size(0));
    contents.buffer(kInstanceBinding, list_.buffer, 0, VK_WHOLE_SIZE);
    contents.texels(kInstanceTexelBinding, kUint1, list_.buffer, 0, list_.bytes, "supple instances seen");
}

} // namespace supple::runtime
