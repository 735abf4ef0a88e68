#include "runtime/context.h"

#include "surface/grid.h"

#include <algorithm>

namespace supple::runtime {

namespace {

Timings::Shortfall shortfallOf(const View& view, uint64_t frame) {
    const std::optional<SuppleViewStatistics> statistics = view.statisticsOf(frame);
    if (!statistics || statistics->shortfall == 0) {
        return {};
    }
    const uint32_t lacking =
        statistics->wantedVertexCount - std::min(statistics->wantedVertexCount, statistics->vertexCount);
    return {true, statistics->droppedInstanceCount, uint64_t{lacking} * vertexBytes(view.desc().vertexFormat)};
}

gpu::MemorySource memorySourceOf(const SuppleMemoryCallbacks& callbacks) {
    gpu::MemorySource source;
    source.allocate = [callbacks](const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred, const char* name, gpu::HostMemory& out) {
        SuppleMemory memory{};
        const VkResult result = callbacks.allocate(&requirements, required, preferred, name, &memory, callbacks.user);
        out = {memory.memory, memory.offset, memory.mapped, memory.allocation};
        return result;
    };
    source.free = [callbacks](const gpu::HostMemory& piece) {
        const SuppleMemory memory{piece.memory, piece.offset, piece.mapped, piece.allocation};
        callbacks.free(&memory, callbacks.user);
    };
    return source;
}

} // namespace

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
    deviceDesc.enabledFeatures = desc.enabledFeatures;
    if (desc.memory != nullptr) {
        deviceDesc.memorySource = memorySourceOf(*desc.memory);
    }
    context->asyncCompute_ = (desc.flags & SUPPLE_CONTEXT_ASYNC_COMPUTE) != 0;
    context->queueFamily_ = desc.queueFamily;
    context->drawQueueFamily_ = context->asyncCompute_ ? desc.drawQueueFamily : desc.queueFamily;
    deviceDesc.drawQueueFamily = context->drawQueueFamily_;
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
    context->pipelines_ = std::make_unique<gpu::Pipelines>(d);

    Result<skinning::DeformPass> deform = skinning::DeformPass::create(d, *context->pipelines_);
    if (!deform) {
        return deform.error();
    }
    context->deform_ = std::move(*deform);
    Result<surface::Passes> passes = surface::Passes::create(d, *context->pipelines_, shaders);
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

void Context::log(SuppleSeverity severity, SuppleMessage message, const std::string& text) const {
    if (log_ != nullptr) {
        log_(severity, message, text.c_str(), logUser_);
    }
}

Status Context::beginFrame(uint64_t frame, uint64_t completedFrame) {
    if (frame <= frame_) {
        return Error{ErrorCode::order, "suppleBeginFrame: frame " + std::to_string(frame) +
                                           " does not rise above frame " + std::to_string(frame_)};
    }
    if (completedFrame < completedFrame_) {
        return Error{ErrorCode::range, "suppleBeginFrame: completed frame " + std::to_string(completedFrame) +
                                           " after frame " + std::to_string(completedFrame_)};
    }
    if (completedFrame >= frame || frame - completedFrame > framesInFlight_) {
        return Error{ErrorCode::range, "suppleBeginFrame: frame " + std::to_string(frame) + " with completed frame " +
                                           std::to_string(completedFrame) + ": the context keeps " +
                                           std::to_string(framesInFlight_) + " frames in flight"};
    }
    // Before anything is freed: what was timed may be of views that go now.
    Status timed = timings.beginFrame(
        frame, completedFrame,
        [this](const View* timedView, uint64_t timedFrame) {
            Timings::Shortfall shortfall;
            forViews([&](View& view) {
                if (&view == timedView) {
                    shortfall = shortfallOf(view, timedFrame);
                }
            });
            return shortfall;
        },
        [this](const char* text) {
            if (log_ != nullptr) {
                log_(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_BUDGET, text, logUser_);
            }
        });
    if (!timed) {
        return timed;
    }
    frame_ = frame;
    completedFrame_ = completedFrame;
    frameOpen_ = true;
    retire(completedFrame);
    return success();
}

void Context::setMemoryBudget(VkDeviceSize bytes, std::function<bool(const gpu::MemoryRequest&)> allowsMore) {
    device_->ledger->budget = bytes;
    device_->ledger->allowsMore = std::move(allowsMore);
}

template <class F>
void Context::forViews(F&& visit) {
    views.forEach(visit);
    for (const std::shared_ptr<View>& view : retiredViews_) {
        visit(*view);
    }
}

Status Context::cancelFrame() {
    if (!frameOpen_) {
        return Error{ErrorCode::order, "suppleCancelFrame: no frame has begun, or it is cancelled"};
    }
    frameOpen_ = false;
    pairs_.cancelUpload(frame_);
    groups.forEach([this](Group& group) { group.cancelFrame(frame_); });
    forViews([this](View& view) { view.cancelFrame(frame_); });
    // What a group destroyed since then has uploaded may be its asset's, and serve groups to come.
    for (const std::shared_ptr<Group>& group : retired_) {
        group->cancelFrame(frame_);
    }
    timings.cancelFrame();
    return success();
}

void Context::retire(uint64_t completedFrame) {
    std::erase_if(retired_,
                  [&](const std::shared_ptr<Group>& group) { return group->lastRecordedFrame() <= completedFrame; });
    forViews([&](View& view) {
        view.beginFrame(completedFrame);
        view.releaseStaging(completedFrame);
    });
    // Those that groups still use stay, as groups may be recorded again.
    std::erase_if(retiredViews_, [&](const std::shared_ptr<View>& view) {
        return view.use_count() == 1 && view->lastRecordedFrame() <= completedFrame;
    });
    pairs_.releaseStaging(completedFrame);
    groups.forEach([&](Group& group) { group.releaseStaging(completedFrame); });
}

Result<uint64_t> Context::createAsset(cage::Character character) {
    for (const std::string& warning : character.warnings) {
        log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_ASSET_WARNING, character.name + ": " + warning);
    }
    Result<std::shared_ptr<Asset>> asset = Asset::create(*device_, std::move(character));
    if (!asset) {
        return asset.error();
    }
    return assets.insert(std::move(*asset));
}

Result<uint64_t> Context::createGroup(const SuppleGroupDesc& desc) {
    const std::shared_ptr<Asset> asset = assets.find(desc.asset.id);
    if (asset == nullptr) {
        return Error{ErrorCode::staleHandle, "suppleCreateGroup: stale or foreign asset handle"};
    }
    if (desc.poseSource == SUPPLE_POSES_PLAYBACK && pose_ == nullptr) {
        Result<skinning::PosePass> pose = skinning::PosePass::create(*device_, *pipelines_);
        if (!pose) {
            return pose.error();
        }
        pose_ = std::make_unique<skinning::PosePass>(std::move(*pose));
    }
    // Instances of one group must not fit another that takes its place: groups' ids differ, and so do generations.
    nextGeneration_ = nextGeneration_ * 1664525u + 1013904223u;
    std::shared_ptr<View> view;
    if (desc.view.id != 0 && (view = views.find(desc.view.id)) == nullptr) {
        return Error{ErrorCode::staleHandle, "suppleCreateGroup: stale or foreign view handle"};
    }
    GroupShared shared;
    shared.device = device_.get();
    shared.deform = &deform_;
    shared.pose = pose_.get();
    shared.surface = &surface_;
    shared.pairs = &pairs_;
    shared.bounds = bounds_.get();
    shared.occlusion = occlusion_.get();
    shared.view = std::move(view);
    shared.framesInFlight = framesInFlight_;
    shared.firstGeneration = nextGeneration_ | 1u;
    shared.handsOver = asyncCompute_;
    Result<std::shared_ptr<Group>> group = Group::create(shared, asset, desc);
    if (!group) {
        return group.error();
    }
    for (const auto& surface : (*group)->surfaces()) {
        for (const std::string& note : surface->tables().notes) {
            log(SUPPLE_SEVERITY_INFO, SUPPLE_MESSAGE_SCHEME_NOTE, asset->character.name + ": " + note);
        }
        if (!surface->rateNote().empty()) {
            log(SUPPLE_SEVERITY_INFO, SUPPLE_MESSAGE_RATE_CHANGED, asset->character.name + ": " + surface->rateNote());
        }
    }
    return groups.insert(std::move(*group));
}

Result<uint64_t> Context::createView(const SuppleViewDesc& desc) {
    if (bounds_ == nullptr) {
        Result<BoundsPass> bounds = BoundsPass::create(*device_, *pipelines_);
        if (!bounds) {
            return bounds.error();
        }
        bounds_ = std::make_unique<BoundsPass>(std::move(*bounds));
    }
    if ((desc.flags & SUPPLE_VIEW_OCCLUSION) != 0 && occlusion_ == nullptr) {
        Result<OcclusionPass> occlusion = OcclusionPass::create(*device_, *pipelines_);
        if (!occlusion) {
            return occlusion.error();
        }
        occlusion_ = std::make_unique<OcclusionPass>(std::move(*occlusion));
    }
    Result<std::shared_ptr<View>> view = View::create(*device_, surface_, framesInFlight_, desc);
    if (!view) {
        return view.error();
    }
    return views.insert(std::move(*view));
}

bool Context::destroyView(uint64_t id) {
    std::shared_ptr<View> view = views.remove(id);
    if (view == nullptr) {
        return false;
    }
    view->setDepthPyramid(std::nullopt); // nobody can take the host's image away any more
    retiredViews_.push_back(std::move(view));
    return true;
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
