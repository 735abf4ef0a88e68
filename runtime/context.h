// The context: the borrowed device, the pipelines, the handles, and what is in flight.
#pragma once

#include "gpu/device.h"
#include "gpu/static_buffers.h"
#include "runtime/asset.h"
#include "runtime/group.h"
#include "runtime/slot_map.h"
#include "runtime/timings.h"
#include "skinning/deform_pass.h"
#include "supple/supple.h"
#include "surface/passes.h"

#include <memory>
#include <string>
#include <vector>

namespace supple::runtime {

class Context {
    std::unique_ptr<gpu::Device> device_; ///< first, so that it goes last: everything below holds its address

public:
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    /// `shaders`: tests put mutated code in.
    [[nodiscard]] static Result<std::unique_ptr<Context>>
    create(const SuppleContextDesc& desc, const surface::Shaders& shaders = surface::Shaders::embedded());

    void log(SuppleSeverity severity, const std::string& text) const;

    [[nodiscard]] Status beginFrame(uint64_t frame, uint64_t completedFrame);
    /// The frame's passes in order; see frame.cpp.
    [[nodiscard]] Status record(VkCommandBuffer commandBuffer, const SuppleRecordDesc& desc);

    [[nodiscard]] Result<uint64_t> createAsset(cage::Character character);
    [[nodiscard]] Result<uint64_t> createGroup(const SuppleGroupDesc& desc);
    bool destroyGroup(uint64_t id);

    Timings timings;
    SlotMap<Asset> assets;
    SlotMap<Group> groups;

private:
    void retire(uint64_t completedFrame);

    SuppleLogFunction log_ = nullptr;
    void* logUser_ = nullptr;
    uint32_t framesInFlight_ = 2;
    uint64_t frame_ = 0; ///< 0: no frame begun
    skinning::DeformPass deform_;
    surface::Passes surface_;
    gpu::StaticBuffers pairs_;
    std::vector<std::shared_ptr<Group>> retired_; ///< destroyed by the host, perhaps still in flight
};

} // namespace supple::runtime
