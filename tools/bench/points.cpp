#include "tools/bench/points.h"

#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/common/statistics.h"

#include <nlohmann/json.hpp>

namespace supple::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t kWarmPointFrames = 2;
constexpr double kPointFrameSeconds = 1.0 / 60.0;

struct PointTimes {
    std::vector<double> points, deform; ///< milliseconds, by frame
};

/// A frame's times are known when the next one begins.
Result<PointTimes> timesOf(host::Device& device, Workbench& workbench, SuppleGroup group, uint32_t frames) {
    PointTimes times;
    for (uint32_t frame = 0; frame <= kWarmPointFrames + frames; ++frame) {
        workbench.setTime(group, frame * kPointFrameSeconds);
        Status recorded = success();
        const Status submitted = device.submitAndWait([&](VkCommandBuffer commands) {
            recorded = workbench.recordFrame(group, commands, SUPPLE_RECORD_TIMINGS);
        });
        if (!recorded || !submitted) {
            return !recorded ? recorded.error() : submitted.error();
        }
        if (frame > kWarmPointFrames) {
            const PassTimes passes(workbench.timings());
            times.points.push_back(passes.of("points"));
            times.deform.push_back(passes.of("deform"));
        }
    }
    return times;
}

Result<Json> rowOf(host::Device& device, Workbench& workbench, SuppleGroup group, uint32_t characters,
                   const PointsDesc& desc) {
    const Result<PointTimes> times = timesOf(device, workbench, group, desc.frames);
    if (!times) {
        return times.error();
    }
    const double points = tools::summarize(times->points).median;
    return Json{{"characters", characters},
                {"points", desc.points},
                {"pointsMs", points},
                {"deformMs", tools::summarize(times->deform).median},
                {"nsAPoint", 1e6 * points / (static_cast<double>(characters) * desc.points)}};
}

} // namespace

Result<Json> measurePoints(host::Device& device, Workbench& workbench, const PointsDesc& desc) {
    Result<BenchCage> character = makeCrowdCharacter();
    if (!character) {
        return character.error();
    }
    const Result<SuppleAsset> asset = workbench.createAsset(std::move(character->character));
    if (!asset) {
        return asset.error();
    }
    Json rows = Json::array();
    Status status = success();
    for (size_t i = 0; i < desc.characters.size() && status; ++i) {
        if (desc.progress) {
            desc.progress(std::to_string(desc.characters[i]));
        }
        SuppleGroupDesc own{};
        own.asset = *asset;
        own.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
        own.rate = 1;
        own.capacity = desc.characters[i];
        own.poseSource = SUPPLE_POSES_PLAYBACK;
        const Result<SuppleGroup> group = workbench.createGroup(own);
        if (!group) {
            status = group.error();
            break;
        }
        const Status scattered = workbench.scatterPoints(*group, desc.points);
        if (scattered) {
            Result<Json> row = rowOf(device, workbench, *group, desc.characters[i], desc);
            status = row ? success() : Status(row.error());
            rows.push_back(row ? std::move(*row) : Json());
        } else if (scattered.error().code != ErrorCode::disabled) {
            status = scattered;
        }
        workbench.destroy(*group);
    }
    workbench.destroy(*asset);
    return status ? Result<Json>(std::move(rows)) : status.error();
}

} // namespace supple::bench
