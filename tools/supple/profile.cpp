// supple profile: runs the frame loop of a host without a window and reports what every pass took.
#include "tools/common/character_file.h"
#include "tools/common/machine.h"
#include "tools/supple/command.h"
#include "tools/supple/profile_report.h"
#include "tools/supple/profile_stage.h"
#include "tools/supple/session.h"
#include "tools/supple/text_file.h"
#include "tools/supple/view_hashes.h"

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace supple::tools {
namespace {

constexpr uint32_t kFramesInFlight = 2;
constexpr size_t kMaxTimings = 1024;  ///< passes of a frame, of all groups
constexpr uint32_t kWarmUpFrames = 3; ///< drivers finish compiling, caches fill

/// Command buffers and fences of the frames in flight.
class FrameRing {
public:
    explicit FrameRing(host::Device& device) : device_(device) {}
    FrameRing(const FrameRing&) = delete;
    FrameRing& operator=(const FrameRing&) = delete;
    ~FrameRing() {
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

/// Runs files under a scheme. Frame numbers must rise over the life of the context, so runs share them.
class Profiler {
public:
    Profiler(Session& session, const ProfileOptions& options) : session_(session), options_(options) {}

    /// One file; in a view as many as there are.
    Result<ProfileRun> run(std::span<const host::CharacterFile> files, const std::string& scheme) {
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

private:
    [[nodiscard]] SuppleContext context() const { return session_.context->handle(); }
    Status check(SuppleResult result, const char* call) { return session_.context->check(result, call); }
    [[nodiscard]] double now() const {
        return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start_).count();
    }

    Status frames(ProfileStage& stage, ProfileRun& run) {
        FrameRing ring(*session_.device);
        Status status = ring.create();
        for (uint32_t i = 0; status && i < kWarmUpFrames + options_.frames; ++i) {
            status = frame(ring, i, stage, run);
        }
        // The last frames' timings come in once the library is told that they have finished.
        for (uint32_t i = 0; status && i < kFramesInFlight; ++i) {
            status = ring.wait(++frame_);
            if (status) {
                status = check(suppleBeginFrame(context(), frame_, frame_ - kFramesInFlight), "suppleBeginFrame");
            }
            if (status) {
                status = collect(stage, run);
            }
        }
        return status;
    }

    Status frame(FrameRing& ring, uint32_t index, ProfileStage& stage, ProfileRun& run) {
        Status status = ring.wait(++frame_);
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

    /// Adds the timings of the newest finished frame to its sample, if it is one of this run's measured frames, and
    /// what the view drew in it.
    Status collect(const ProfileStage& stage, ProfileRun& run) {
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
        const SuppleResult result = suppleGetTimings(context(), timings_.data(), &count);
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
        for (const SuppleTiming& timing : std::span(timings_).first(count)) {
            if (std::string_view(timing.pass) == "shortfall") { // is no pass; the view's statistics have it
                continue;
            }
            for (auto sample = run.frames.rbegin(); sample != run.frames.rend(); ++sample) {
                if (sample->frame == timing.frame) {
                    sample->passes.push_back(
                        {timing.pass, timing.gpuBegin, timing.gpuEnd, timing.cpuRecord, timing.points, timing.bytes});
                    break;
                }
            }
        }
        return success();
    }

    Session& session_;
    const ProfileOptions& options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    uint64_t frame_ = 0;
    uint64_t collected_ = 0; ///< whose timings came in last
    std::vector<SuppleTiming> timings_ = std::vector<SuppleTiming>(kMaxTimings);
};

std::string dump(const nlohmann::ordered_json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Status profile(Session& session, const ProfileOptions& options, const std::vector<host::CharacterFile>& files) {
    const Machine machine = describeMachine(*session.device, options.device.mapping);
    std::printf("%s (%s %s), %s mapping, CPU %s\n", machine.device.c_str(), machine.driver.c_str(),
                machine.driverInfo.c_str(), machine.mapping.c_str(), machine.cpu.c_str());
    const bool all = options.surface.scheme == "all";
    std::vector<std::string> names;
    for (const Scheme& scheme : kSchemes) {
        names.emplace_back(scheme.name);
    }
    if (!all) {
        names = {options.surface.scheme};
    }
    std::vector<ProfileRun> runs;
    Profiler profiler(session, options);
    const std::span<const host::CharacterFile> everything = files;
    const size_t together = options.view ? files.size() : 1;
    for (size_t first = 0; first < files.size(); first += together) {
        for (const std::string& scheme : names) {
            Result<ProfileRun> run = profiler.run(everything.subspan(first, together), scheme);
            const bool refused = !run && (run.error().code == ErrorCode::asset || run.error().code == ErrorCode::limit);
            if (refused && all) { // not every scheme takes every cage
                warn(run.error().message);
                continue;
            }
            if (!run) {
                return run.error();
            }
            std::printf("\n%s", toTable(*run, summarizeRun(*run)).c_str());
            std::fflush(stdout);
            runs.push_back(std::move(*run));
            if (!options.json.empty()) { // after every run: a later one's failure loses nothing
                Status kept = writeTextFile(options.json, dump(toJson(machine, runs), 2));
                if (!kept) {
                    return kept;
                }
            }
        }
    }
    if (runs.empty()) {
        return Error{ErrorCode::asset, "no scheme takes any of the files"};
    }
    Status status = success();
    if (status && !options.csv.empty()) {
        status = writeTextFile(options.csv, toCsv(runs));
    }
    if (status && !options.trace.empty()) {
        status = writeTextFile(options.trace, dump(toTrace(machine, runs), -1));
    }
    if (status && !options.hashes.empty()) {
        std::string text;
        for (const ProfileRun& run : runs) {
            text += "scheme " + run.scheme + "\n" + run.hashes;
        }
        status = writeTextFile(options.hashes, text);
    }
    return status;
}

int runProfile(const ProfileOptions& options) {
    std::vector<host::CharacterFile> files;
    for (const std::string& path : options.files) {
        Result<host::CharacterFile> file = host::readCharacterFile(path, options.surface.reading);
        if (!file) {
            return fail(kExitBadInput, file.error().message);
        }
        files.push_back(std::move(*file));
    }
    return withSession(options.device, [&](Session& session) { return profile(session, options, files); });
}

} // namespace

void bindProfile(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<ProfileOptions>();
    CLI::App* command = app.add_subcommand("profile", "What every pass of a frame takes, over many frames");
    command->add_option("FILE", options->files, "glTF, GLB or OBJ, one run each")->required();
    command->add_option("--instances", options->instances, "Instances evaluated together")
        ->check(CLI::Range(1u, 1000000u))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "Frames to measure, after a few to warm up")
        ->check(CLI::Range(1u, 1000000u))
        ->capture_default_str();
    command->add_option("--clip", options->clip, "Clip by name or index; without it the first")
        ->type_name("NAME|INDEX");
    bindMorphs(*command, options->morphs);
    command->add_flag("--motion", options->motion, "Previous positions as well, for motion vectors");
    command->add_flag("--tangent-frames", options->tangents,
                      "Tangents and texture coordinates as well, for normal maps");
    command->add_flag("--playback", options->playback, "Poses on the device, from the group's time alone");
    CLI::Option* view =
        command->add_flag("--view", options->view,
                          "All files together in one view: levels of detail under a budget, a crowd before a "
                          "camera, poses on the device");
    command->add_option("--budget", options->budget, "Surface vertices of the view's frame")
        ->needs(view)
        ->check(CLI::Range(1024u, SUPPLE_MAX_VIEW_VERTICES))
        ->capture_default_str();
    command->add_option("--hashes", options->hashes, "Write hashes of the patches that the view drew last")
        ->needs(view)
        ->type_name("OUT.txt");
    command->add_option("--json", options->json, "Write the figures as JSON, anew after every run")
        ->type_name("OUT.json");
    command->add_option("--csv", options->csv, "Write the figures as CSV, a row a pass")->type_name("OUT.csv");
    command->add_option("--trace", options->trace, "Write every frame as a Chrome trace, for Perfetto")
        ->type_name("OUT.json");
    bindSurface(*command, options->surface, {"all", "cage"});
    bindDevice(*command, options->device);
    command->callback([options, &exitCode] { exitCode = runProfile(*options); });
}

} // namespace supple::tools
