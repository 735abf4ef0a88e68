#include "runtime/context.h"

#include "surface/grid.h"

#include <algorithm>

namespace supple::runtime {

Result<std::unique_ptr<Context>> Context::create(const SuppleContextDesc& desc, const surface::Shaders& shaders) {
    auto context = std::make_unique<Context>();
    context->log_ = desc.log;
    context->logUser_ = desc.logUser;
    context->framesInFlight_ = desc.framesInFlight == 0 ? 2 : desc.framesInFlight;

    gpu::DeviceDesc deviceDesc;
    deviceDesc.instance = desc.instance;
    deviceDesc.physicalDevice = desc.physicalDevice;
    deviceDesc.device = desc.device;
    deviceDesc.queueFamily = desc.queueFamily;
    deviceDesc.getInstanceProcAddr = desc.getInstanceProcAddr;
    deviceDesc.pipelineCache = desc.pipelineCache;
    deviceDesc.allocator = desc.allocator;
    deviceDesc.debugUtils = (desc.flags & SUPPLE_CONTEXT_DEBUG_UTILS) != 0;
    deviceDesc.mapping = desc.mapping == SUPPLE_MAPPING_NARROW ? gpu::MappingChoice::narrow
                         : desc.mapping == SUPPLE_MAPPING_WIDE ? gpu::MappingChoice::wide
                                                               : gpu::MappingChoice::automatic;
    Result<gpu::Device> device = gpu::Device::create(deviceDesc);
    if (!device) {
        return device.error();
    }
    context->device_ = std::make_unique<gpu::Device>(std::move(*device));
    const gpu::Device& d = *context->device_;

    Result<skinning::DeformPass> deform = skinning::DeformPass::create(d);
    if (!deform) {
        return deform.error();
    }
    context->deform_ = std::move(*deform);
    Result<surface::Passes> passes = surface::Passes::create(d, shaders);
    if (!passes) {
        return passes.error();
    }
    context->surface_ = std::move(*passes);

    const std::vector<float> pairs = surface::parameterPairs();
    const gpu::StaticRequest request{"supple parameter pairs", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                     std::as_bytes(std::span(pairs))};
    Result<gpu::StaticBuffers> pairBuffers = gpu::StaticBuffers::create(d, {&request, 1});
    if (!pairBuffers) {
        return pairBuffers.error();
    }
    context->pairs_ = std::move(*pairBuffers);

    const Status timings = context->timings.create(d, context->framesInFlight_);
    if (!timings) {
        return timings.error();
    }
    return context;
}

void Context::log(SuppleSeverity severity, const std::string& text) const {
    if (log_ != nullptr) {
        log_(severity, text.c_str(), logUser_);
    }
}

Status Context::beginFrame(uint64_t frame, uint64_t completedFrame) {
    if (frame <= frame_) {
        return Error{ErrorCode::argument,
                     "frame " + std::to_string(frame) + " does not rise above frame " + std::to_string(frame_)};
    }
    if (completedFrame >= frame || frame - completedFrame > framesInFlight_) {
        return Error{ErrorCode::argument, "frame " + std::to_string(frame) + " with completed frame " +
                                              std::to_string(completedFrame) + ": the context keeps " +
                                              std::to_string(framesInFlight_) + " frames in flight"};
    }
    frame_ = frame;
    retire(completedFrame);
    timings.beginFrame(frame, completedFrame);
    return success();
}

void Context::retire(uint64_t completedFrame) {
    std::erase_if(retired_,
                  [&](const std::shared_ptr<Group>& group) { return group->lastRecordedFrame() <= completedFrame; });
    pairs_.releaseStaging(completedFrame);
    groups.forEach([&](Group& group) { group.releaseStaging(completedFrame); });
}

Result<uint64_t> Context::createAsset(cage::Character character) {
    for (const std::string& warning : character.warnings) {
        log(SUPPLE_SEVERITY_WARNING, character.name + ": " + warning);
    }
    Result<std::shared_ptr<Asset>> asset = Asset::create(*device_, std::move(character));
    if (!asset) {
        return asset.error();
    }
    return assets.insert(std::move(*asset));
}

Result<uint64_t> Context::createGroup(const SuppleGroupDesc& desc) {
    const std::shared_ptr<Asset>& asset = assets.find(desc.asset.id);
    if (asset == nullptr) {
        return Error{ErrorCode::argument, "suppleCreateGroup: stale or foreign asset handle"};
    }
    const GroupShared shared{device_.get(), &deform_, &surface_, pairs_.buffer(0), pairs_.size(0), framesInFlight_};
    Result<std::shared_ptr<Group>> group = Group::create(shared, asset, desc);
    if (!group) {
        return group.error();
    }
    for (const std::vector<std::string>& notes : {(*group)->tables().notes, (*group)->notes()}) {
        for (const std::string& note : notes) {
            log(SUPPLE_SEVERITY_INFO, asset->character.name + ": " + note);
        }
    }
    return groups.insert(std::move(*group));
}

bool Context::destroyGroup(uint64_t id) {
    std::shared_ptr<Group> group = groups.remove(id);
    if (group == nullptr) {
        return false;
    }
    retired_.push_back(std::move(group)); // freed by the next beginFrame that may
    return true;
}

} // namespace supple::runtime
