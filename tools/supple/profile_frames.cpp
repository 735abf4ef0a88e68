#include "tools/supple/profile_frames.h"

#include "tools/supple/progress.h"
#include "tools/supple/view_hashes.h"

#include <array>
#include <optional>
#include <string_view>

namespace supple::tools {
namespace {

constexpr uint32_t kFramesInFlight = 2;
constexpr size_t kMaxTimings = 1024;      ///< passes of a frame, of all groups
constexpr uint32_t kWarmUpFrames = 3;     ///< drivers finish compiling, caches fill
constexpr uint32_t kFramesUntilFreed = 3; ///< behind those that groups keep unseen

} // namespace

/// Command buffers and fences of the frames in flight.
class ProfileRing {
public:
    explicit ProfileRing(host::Device& device) : device_(device) {}
    ProfileRing(const ProfileRing&) = delete;
    ProfileRing& operator=(const ProfileRing&) = delete;
    ~ProfileRing() {
        vkDeviceWaitIdle(device_.handle());
        for (const VkFence fence : fences_) {
            vkDestroyFence(device_.handle(), fence, nullptr);
        }
        if (commands_[0] != VK_NULL_HANDLE) {
            vkFreeCommandBuffers(device_.handle(), device_.commandPool(), kFramesInFlight, commands_.data());
        }
    }

    Status create() {
        VkCommandBufferAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        allocate.commandPool = device_.commandPool();
        allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        allocate.commandBufferCount = kFramesInFlight;
        VkResult result = vkAllocateCommandBuffers(device_.handle(), &allocate, commands_.data());
        if (result != VK_SUCCESS) {
            return host::vulkanError(result, "vkAllocateCommandBuffers");
        }
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        fence.flags = VK_FENCE_CREATE_SIGNALED_BIT; // the first wait of each slot passes at once
        for (VkFence& slot : fences_) {
            result = vkCreateFence(device_.handle(), &fence, nullptr, &slot);
            if (result != VK_SUCCESS) {
                return host::vulkanError(result, "vkCreateFence");
            }
        }
        return success();
    }

    /// Waits until the frame that used this one's slot before has finished.
    Status wait(uint64_t frame) {
        const VkResult result = vkWaitForFences(device_.handle(), 1, &fences_[slot(frame)], VK_TRUE, UINT64_MAX);
        return result == VK_SUCCESS ? success() : Status(host::vulkanError(result, "vkWaitForFences"));
    }

    Result<VkCommandBuffer> begin(uint64_t frame) {
        VkCommandBufferBeginInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        const VkResult result = vkBeginCommandBuffer(commands_[slot(frame)], &info);
        if (result != VK_SUCCESS) {
            return host::vulkanError(result, "vkBeginCommandBuffer");
        }
        return commands_[slot(frame)];
    }

    Status submit(uint64_t frame) {
        const uint32_t s = slot(frame);
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands_[s];
        VkResult result = vkEndCommandBuffer(commands_[s]);
        if (result == VK_SUCCESS) {
            result = vkResetFences(device_.handle(), 1, &fences_[s]);
        }
        if (result == VK_SUCCESS) {
            result = vkQueueSubmit(device_.queue(), 1, &info, fences_[s]);
        }
        return result == VK_SUCCESS ? success() : Status(host::vulkanError(result, "vkQueueSubmit"));
    }

private:
    static uint32_t slot(uint64_t frame) { return static_cast<uint32_t>(frame % kFramesInFlight); }

    host::Device& device_;
    std::array<VkCommandBuffer, kFramesInFlight> commands_{};
    std::array<VkFence, kFramesInFlight> fences_{};
};

Profiler::Profiler(Session& session, const ProfileOptions& options)
    : session_(session), options_(options), timings_(kMaxTimings) {}

double Profiler::now() const {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start_).count();
}

Result<ProfileRun> Profiler::run(std::span<const host::CharacterFile> files, const std::string& scheme) {
    ProfileRun result;
    for (const host::CharacterFile& file : files) {
        result.file += (result.file.empty() ? "" : " + ") + file.path;
    }
    result.rate = options_.surface.rate;
    result.playback = options_.plays();
    ProfileStage stage(*session_.context, options_);
    Status status = stage.create(files, scheme, result);
    if (status) {
        status = frames(stage, result);
    }
    if (status) {
        result.memory.structSize = sizeof result.memory;
        status = check(suppleGetContextMemory(context(), &result.memory), "suppleGetContextMemory");
    }
    if (status && !options_.hashes.empty()) {
        Result<std::string> hashes = hashView(*session_.context, stage.groups());
        status = hashes ? success() : Status(hashes.error());
        result.hashes = hashes ? std::move(*hashes) : std::string();
    }
    status = status ? findHolders(stage, result) : status;
    const Status ended = stage.destroy();
    status = status ? ended : status;
    if (!status) {
        return status.error();
    }
    std::erase_if(result.frames, [](const FrameSample& f) { return f.passes.empty(); });
    if (result.frames.empty()) {
        return Error{ErrorCode::vulkan, result.file + ": the device reported no timings"};
    }
    return result;
}

Status Profiler::findHolders(ProfileStage& stage, ProfileRun& run) {
    Result<std::vector<MemoryHolder>> holders = stage.holders();
    if (!holders) {
        return holders.error();
    }
    run.holders = std::move(*holders);
    run.keptUnseen = options_.keepUnseen;
    if (run.keptUnseen == 0) {
        return success();
    }
    Status status = stage.lookAway();
    for (uint32_t i = 0; status && i < run.keptUnseen + kFramesUntilFreed; ++i) {
        status = session_.context->evaluate(stage.groups());
    }
    holders = status ? stage.holders() : Result<std::vector<MemoryHolder>>(status.error());
    for (size_t i = 0; holders && i < holders->size(); ++i) {
        run.holders[i].use.givenBack = (*holders)[i].use.givenBack;
    }
    return holders ? success() : Status(holders.error());
}

void Profiler::readClocks(ProfileRun& run) const {
    const std::optional<host::ClockPair> read = session_.device->readClocks();
    uint64_t origin = 0;
    if (!read || suppleGetTimingOrigin(context(), &origin) != SUPPLE_OK) {
        return;
    }
    const auto start = std::chrono::duration_cast<std::chrono::nanoseconds>(start_.time_since_epoch()).count();
    run.clocks.push_back({static_cast<double>(static_cast<int64_t>(read->ticks - origin)) *
                              static_cast<double>(session_.device->properties().limits.timestampPeriod),
                          static_cast<double>(static_cast<int64_t>(read->host) - start),
                          static_cast<double>(read->deviation)});
}

Status Profiler::frames(ProfileStage& stage, ProfileRun& run) {
    ProfileRing ring(*session_.device);
    Status status = ring.create();
    constexpr uint32_t kFramesALine = 10; // of a terminal, which takes time itself
    const uint32_t count = kWarmUpFrames + options_.frames;
    for (uint32_t i = 0; status && i < count; ++i) {
        if (i % kFramesALine == 0) {
            showProgress("measuring frames of " + run.file, i + 1, count);
        }
        if (i == kWarmUpFrames) {
            readClocks(run);
        }
        status = frame(ring, i, stage, run);
    }
    endProgress();
    // The last frames' timings come in once the library is told that they have finished.
    for (uint32_t i = 0; status && i < kFramesInFlight; ++i) {
        status = ring.wait(frame_ = session_.context->nextFrame());
        if (status) {
            status = check(suppleBeginFrame(context(), frame_, frame_ - kFramesInFlight), "suppleBeginFrame");
        }
        if (status) {
            status = collect(stage, run);
        }
    }
    readClocks(run);
    return status;
}

Status Profiler::frame(ProfileRing& ring, uint32_t index, ProfileStage& stage, ProfileRun& run) {
    Status status = ring.wait(frame_ = session_.context->nextFrame());
    if (!status) {
        return status;
    }
    // Told one frame at a time what has finished, so that no frame's timings are skipped over.
    const uint64_t completed = frame_ > kFramesInFlight ? frame_ - kFramesInFlight : 0;
    FrameSample sample;
    sample.frame = frame_;
    status = check(suppleBeginFrame(context(), frame_, completed), "suppleBeginFrame");
    if (status) {
        status = collect(stage, run);
    }
    sample.poseBegin = now();
    if (status) {
        status = stage.setPoses(index);
    }
    sample.poseTime = now() - sample.poseBegin;
    if (!status) {
        return status;
    }
    const Result<VkCommandBuffer> commands = ring.begin(frame_);
    if (!commands) {
        return commands.error();
    }
    SuppleRecordDesc record{};
    record.structSize = sizeof record;
    record.flags = SUPPLE_RECORD_TIMINGS;
    record.groups = stage.groups().data();
    record.groupCount = static_cast<uint32_t>(stage.groups().size());
    // As a host that draws would ask.
    record.before = {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    record.after = {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
    sample.recordBegin = now();
    status = check(suppleRecord(context(), *commands, &record), "suppleRecord");
    sample.recordTime = now() - sample.recordBegin;
    if (status) {
        status = ring.submit(frame_);
    }
    sample.submitted = now();
    if (index >= kWarmUpFrames) {
        run.frames.push_back(std::move(sample));
    }
    return status;
}

Status Profiler::collect(const ProfileStage& stage, ProfileRun& run) {
    if (const std::optional<SuppleViewStatistics> drawn = stage.statistics()) {
        for (FrameSample& sample : run.frames) {
            if (sample.frame == drawn->frame) {
                sample.drawn = {drawn->vertexCount,        drawn->wantedVertexCount,    drawn->patchCount,
                                drawn->drawnInstanceCount, drawn->droppedInstanceCount, drawn->levelScales[0],
                                drawn->shortfall != 0};
            }
        }
    }
    uint32_t count = static_cast<uint32_t>(timings_.size());
    const SuppleResult result = suppleGetTimings(context(), sizeof(SuppleTiming), timings_.data(), &count);
    if (result == SUPPLE_NOT_READY) {
        return success();
    }
    if (Status status = check(result, "suppleGetTimings"); !status) {
        return status;
    }
    if (count == 0 || timings_[0].frame == collected_) {
        return success();
    }
    collected_ = timings_[0].frame;
    for (uint32_t i = 0; i < count; ++i) {
        const SuppleTiming& timing = timings_[i];
        if (timing.pass == SUPPLE_PASS_SHORTFALL) { // is no pass; the view's statistics have it
            continue;
        }
        for (auto sample = run.frames.rbegin(); sample != run.frames.rend(); ++sample) {
            if (sample->frame == timing.frame) {
                sample->passes.push_back({suppleGetPassName(timing.pass), timing.gpuBegin, timing.gpuEnd,
                                          timing.cpuRecord, timing.points, timing.bytes,
                                          stage.surfaceOf(timing.group, timing.surface)});
                break;
            }
        }
    }
    return success();
}

} // namespace supple::tools
