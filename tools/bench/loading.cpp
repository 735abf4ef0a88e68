#include "tools/bench/loading.h"

#include "cage/gltf/reader.h"
#include "host/context.h"
#include "host/jobs.h"
#include "host/vk_struct.h"
#include "runtime/cooked/file.h"
#include "tools/bench/clocks.h"
#include "tools/bench/pipeline_watch.h"
#include "tools/common/schemes.h"
#include "tools/common/statistics.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <functional>

namespace supple::bench {

namespace {

constexpr uint32_t kLoadedRate = 8;
constexpr uint64_t kUploadBudget = 64 << 10; ///< of what is prepared
constexpr uint32_t kViewVertices = 1u << 20; ///< room for any of the cages

SuppleGroupDesc loadedGroup(const BenchCage& cage, SuppleScheme scheme, SuppleAsset asset) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.scheme = scheme;
    desc.rate = kLoadedRate;
    desc.flags = cage.character.cage.cornerUvs.empty() ? 0 : SUPPLE_GROUP_ATTRIBUTES;
    return desc;
}

struct FrameTimes {
    double record = 0.0, submit = 0.0; ///< milliseconds
};

/// Records, submits and waits.
Result<FrameTimes> timed(host::Device& device, const std::function<Status(VkCommandBuffer)>& record) {
    FrameTimes times;
    Status recorded = success();
    double end = 0.0;
    const Status submitted = device.submitAndWait([&](VkCommandBuffer commands) {
        const double begin = wallSeconds();
        recorded = record(commands);
        end = wallSeconds();
        times.record = 1e3 * (end - begin);
    });
    times.submit = 1e3 * (wallSeconds() - end);
    if (!recorded || !submitted) {
        return recorded ? submitted.error() : recorded.error();
    }
    return times;
}

Result<FrameTimes> frame(host::Device& device, Workbench& workbench, SuppleGroup group) {
    return timed(device, [&](VkCommandBuffer commands) { return workbench.recordFrame(group, commands); });
}

Result<FrameTimes> warmUp(host::Device& device, Workbench& workbench, SuppleGroup group) {
    return timed(device, [&](VkCommandBuffer commands) { return workbench.recordWarmUp(group, commands); });
}

/// What a context has before its first frame.
enum class Start { cold, warm, prepared };

struct OneLoad {
    LoadTimes times;
    SuppleGroup group{};
};

/// The caller destroys the group.
Result<OneLoad> load(host::Device& device, Workbench& workbench, const BenchCage& cage, SuppleScheme scheme) {
    OneLoad one;
    cage::Character character = cage.character;
    const double begin = wallSeconds();
    Result<SuppleAsset> asset = workbench.createAsset(std::move(character));
    const double made = wallSeconds();
    if (!asset) {
        return asset.error();
    }
    Result<SuppleGroup> group = workbench.createGroup(loadedGroup(cage, scheme, *asset));
    const double grouped = wallSeconds();
    workbench.destroy(*asset);
    if (!group) {
        return group.error();
    }
    const Result<FrameTimes> first = frame(device, workbench, *group);
    const Result<FrameTimes> second = first ? frame(device, workbench, *group) : first;
    if (!second) {
        workbench.destroy(*group);
        return second.error();
    }
    one.times.createAsset = 1e3 * (made - begin);
    one.times.createGroup = 1e3 * (grouped - made);
    one.times.record = first->record;
    one.times.submit = first->submit;
    one.times.secondSubmit = second->submit;
    one.group = *group;
    return one;
}

/// Fills in how long the same character takes from files.
Status readFiles(const runtime::Prepared& prepared, LoadTimes& times) {
    const Result<cage::GlbFile> glb = cage::writeGlb(prepared.character);
    if (!glb) {
        return glb.error();
    }
    const std::vector<std::byte> cooked = runtime::writeCooked(prepared, "");
    const double begin = wallSeconds();
    const Result<cage::Character> parsed = cage::readGltf(glb->bytes, "loaded.glb", "");
    const double read = wallSeconds();
    const auto loaded = runtime::readCooked(cooked, "loaded.supple");
    times.parse = 1e3 * (read - begin);
    times.cooked = 1e3 * (wallSeconds() - read);
    if (!parsed || !loaded) {
        // What was written here must be read. An asset that a scheme refuses is another thing, which the heats name.
        return Error{ErrorCode::io, parsed ? loaded.error().message : parsed.error().message};
    }
    return success();
}

/// Fills in how long frames take that upload the group's data, a budget each.
Status arrive(host::Device& device, Workbench& workbench, SuppleGroup group, LoadTimes& times) {
    for (bool there = false; !there;) {
        const Result<FrameTimes> one = frame(device, workbench, group);
        if (!one) {
            return one.error();
        }
        times.arrive = std::max(times.arrive, one->record);
        there = workbench.isThere(group);
    }
    return workbench.setUploadBudget(0);
}

/// Fills in what the thread of frames does of a character that was prepared elsewhere.
Status loadPrepared(host::Device& device, Workbench& workbench, const BenchCage& cage, SuppleScheme scheme,
                    LoadTimes& times) {
    SuppleGroupDesc desc = loadedGroup(cage, scheme, {});
    cage::Character character = cage.character;
    const double begin = wallSeconds();
    const std::shared_ptr<const runtime::Prepared> prepared = workbench.prepare(std::move(character), desc);
    times.prepare = 1e3 * (wallSeconds() - begin);
    if (prepared == nullptr) {
        return Error{ErrorCode::asset, cage.name + ": cannot be prepared"};
    }
    if (const Status bounded = workbench.setUploadBudget(kUploadBudget); !bounded) {
        return bounded;
    }
    const double made = wallSeconds();
    Result<SuppleAsset> asset = workbench.createAsset(prepared);
    if (!asset) {
        return asset.error();
    }
    desc.asset = *asset;
    const Result<SuppleGroup> group = workbench.createGroup(desc);
    times.hitch = 1e3 * (wallSeconds() - made);
    workbench.destroy(*asset);
    if (!group) {
        return group.error();
    }
    const Status arrived = arrive(device, workbench, *group, times);
    workbench.destroy(*group);
    return arrived ? readFiles(*prepared, times) : arrived;
}

} // namespace

Result<Loading> measureLoading(host::Device& device, Workbench& workbench, const BenchCage& cage, SuppleScheme scheme,
                               uint32_t loads) {
    Loading loading;
    loading.cage = cage.name;
    loading.scheme = tools::schemeName(scheme);
    loading.faces = cage.character.cage.faceCount();
    std::vector<LoadTimes> all;
    for (uint32_t i = 0; i < loads + 1; ++i) { // the first one makes the pipelines
        Result<OneLoad> one = load(device, workbench, cage, scheme);
        if (!one) {
            return one.error();
        }
        if (const Status hitch = loadPrepared(device, workbench, cage, scheme, one->times); !hitch) {
            return hitch.error();
        }
        loading.patches = workbench.output(one->group).surface.patchCount;
        loading.bytes = workbench.staticBytes(one->group);
        workbench.destroy(one->group);
        if (i > 0) {
            all.push_back(one->times);
        }
    }
    for (double LoadTimes::*step : {&LoadTimes::createAsset, &LoadTimes::createGroup, &LoadTimes::record,
                                    &LoadTimes::submit, &LoadTimes::secondSubmit, &LoadTimes::prepare,
                                    &LoadTimes::hitch, &LoadTimes::arrive, &LoadTimes::parse, &LoadTimes::cooked}) {
        std::vector<double> values;
        for (const LoadTimes& times : all) {
            values.push_back(times.*step);
        }
        loading.times.*step = tools::summarize(values).median;
    }
    return loading;
}

namespace {

Result<SuppleGroup> groupFor(Workbench& workbench, const BenchCage& cage, SuppleScheme scheme, PipelineUse use) {
    Result<SuppleAsset> asset = workbench.createAsset(cage.character);
    if (!asset) {
        return asset.error();
    }
    SuppleGroupDesc desc = loadedGroup(cage, scheme, *asset);
    if (use == PipelineUse::inView) {
        SuppleViewDesc view{};
        view.flags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
        view.maxVertices = kViewVertices;
        Result<SuppleView> made = workbench.createView(view);
        if (!made) {
            return made.error();
        }
        desc.view = *made;
        desc.flags = 0; // the view's
        desc.poseSource = SUPPLE_POSES_PLAYBACK;
    }
    return workbench.createGroup(desc);
}

/// Milliseconds to make the pipelines of a group without a cache, on all threads of the machine.
Result<double> measureSideBySide(host::Device& device, SuppleMapping mapping, const BenchCage& cage,
                                 SuppleScheme scheme, PipelineUse use) {
    double milliseconds = 0.0;
    SuppleContextDesc desc = host::contextDesc(device);
    desc.mapping = mapping;
    desc.jobsUser = &milliseconds;
    desc.runJobs = [](uint32_t count, void (*job)(void*, uint32_t), void* jobData, void* user) {
        const double begin = wallSeconds();
        host::runJobs(count, job, jobData, nullptr);
        *static_cast<double*>(user) += 1e3 * (wallSeconds() - begin);
    };
    Result<std::unique_ptr<Workbench>> workbench = Workbench::create(desc);
    if (!workbench) {
        return workbench.error();
    }
    const Result<SuppleGroup> group = groupFor(**workbench, cage, scheme, use);
    return group ? Result<double>(milliseconds) : group.error();
}

} // namespace

Result<Pipelines> measurePipelines(host::Device& device, SuppleMapping mapping, const BenchCage& cage,
                                   SuppleScheme scheme, PipelineUse use) {
    Pipelines result;
    result.cage = cage.name;
    result.scheme = tools::schemeName(scheme);
    const auto cacheInfo = host::vkStruct<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    VkPipelineCache cache = VK_NULL_HANDLE;
    const VkResult created = vkCreatePipelineCache(device.handle(), &cacheInfo, nullptr, &cache);
    if (created != VK_SUCCESS) {
        return host::vulkanError(created, "vkCreatePipelineCache");
    }
    Status status = success();
    for (const Start start : {Start::cold, Start::warm, Start::prepared}) {
        const bool warm = start == Start::warm;
        PipelineWatch watch;
        SuppleContextDesc desc = host::contextDesc(device);
        desc.mapping = mapping;
        desc.pipelineCache = cache;
        desc.getInstanceProcAddr = PipelineWatch::getInstanceProcAddr();
        Result<std::unique_ptr<Workbench>> workbench = Workbench::create(desc);
        if (!workbench) {
            status = workbench.error();
            break;
        }
        Result<SuppleGroup> group = groupFor(**workbench, cage, scheme, use);
        const size_t made = watch.pipelines().size();
        Result<FrameTimes> prepared = group && start == Start::prepared ? warmUp(device, **workbench, *group)
                                      : group                           ? Result<FrameTimes>(FrameTimes{})
                                                                        : Result<FrameTimes>(group.error());
        Result<FrameTimes> first = prepared ? frame(device, **workbench, *group) : prepared;
        Result<FrameTimes> second = first ? frame(device, **workbench, *group) : first;
        if (!second) {
            status = second.error();
            break;
        }
        if (start == Start::prepared) {
            result.warmUp = prepared->record + prepared->submit;
            result.preparedFirstFrame = first->submit;
            result.preparedSecondFrame = second->submit;
            result.createdWhileRecording += static_cast<uint32_t>(watch.pipelines().size() - made);
            continue;
        }
        (warm ? result.warmFirstFrame : result.coldFirstFrame) = first->submit;
        (warm ? result.warmSecondFrame : result.coldSecondFrame) = second->submit;
        result.createdWhileRecording += static_cast<uint32_t>(watch.pipelines().size() - made);
        for (size_t i = 0; i < watch.pipelines().size(); ++i) {
            const WatchedPipeline& seen = watch.pipelines()[i];
            const double milliseconds = 1e3 * (seen.seconds + seen.moduleSeconds);
            if (!warm) {
                result.pipelines.push_back({seen.name, seen.spirvBytes, milliseconds, 0.0});
            } else if (i < result.pipelines.size()) {
                result.pipelines[i].warm = milliseconds;
            }
            (warm ? result.warm : result.cold) += milliseconds;
            (warm ? result.warmCpu : result.coldCpu) += 1e3 * seen.cpuSeconds;
        }
    }
    vkDestroyPipelineCache(device.handle(), cache, nullptr);
    const Result<double> sideBySide =
        status ? measureSideBySide(device, mapping, cage, scheme, use) : Result<double>(status.error());
    if (!sideBySide) {
        return sideBySide.error();
    }
    result.sideBySide = *sideBySide;
    return result;
}

} // namespace supple::bench
