#include "tools/bench/skinning.h"

#include "tools/bench/replay.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

struct WayOfSkinning {
    const char* name;
    SuppleSkinning skinning;
};
constexpr WayOfSkinning kWays[] = {{"linear", SUPPLE_SKINNING_LINEAR},
                                   {"dual-quaternion", SUPPLE_SKINNING_DUAL_QUATERNION},
                                   {"centers", SUPPLE_SKINNING_CENTERS_OF_ROTATION},
                                   {"mush", SUPPLE_SKINNING_DELTA_MUSH},
                                   {"mush-light", SUPPLE_SKINNING_DELTA_MUSH_LIGHT}};
constexpr size_t kOver = 1;

class SkinningRace {
public:
    SkinningRace(host::Device& device, Workbench& workbench, const SkinningDesc& desc)
        : device_(device), workbench_(workbench), desc_(desc) {}
    ~SkinningRace() {
        replays_.clear();
        for (const SuppleGroup group : groups_) {
            workbench_.destroy(group);
        }
        workbench_.destroy(asset_);
    }
    SkinningRace(const SkinningRace&) = delete;
    SkinningRace& operator=(const SkinningRace&) = delete;

    Result<Json> run();

private:
    Status add(const WayOfSkinning& way, SuppleAsset asset);

    host::Device& device_;
    Workbench& workbench_;
    const SkinningDesc& desc_;
    SuppleAsset asset_{};
    std::vector<SuppleGroup> groups_;
    std::vector<Contestant> contestants_;
    std::vector<std::unique_ptr<Replay>> replays_;
};

Status SkinningRace::add(const WayOfSkinning& way, SuppleAsset asset) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.capacity = desc_.characters;
    desc.skinning = way.skinning;
    const Result<SuppleGroup> group = workbench_.createGroup(desc);
    if (!group) {
        return group.error();
    }
    groups_.push_back(*group);
    Status recorded = success();
    const Status submitted =
        device_.submitAndWait([&](VkCommandBuffer commands) { recorded = workbench_.recordFrame(*group, commands); });
    if (!recorded || !submitted) {
        return recorded ? submitted : recorded;
    }
    Result<std::unique_ptr<Replay>> replay =
        Replay::create(device_, [&](VkCommandBuffer commands) { workbench_.recordSkin(*group, commands); });
    if (!replay) {
        return replay.error();
    }
    const uint64_t vertices = uint64_t{desc_.cage->character.cage.vertexCount()} * desc_.characters;
    contestants_.push_back((*replay)->contestant(way.name, vertices));
    replays_.push_back(std::move(*replay));
    return success();
}

Result<Json> SkinningRace::run() {
    const cage::Character& character = desc_.cage->character;
    Result<SuppleAsset> asset = workbench_.createAsset(character);
    if (!asset) {
        return asset.error();
    }
    asset_ = *asset;
    for (const WayOfSkinning& way : kWays) {
        if (const Status added = add(way, asset_); !added) {
            return added.error();
        }
    }
    const Result<std::vector<Series>> series = runRounds(contestants_, desc_.rounds);
    if (!series) {
        return series.error();
    }
    Json row{{"cage", desc_.cage->name},
             {"vertices", character.cage.vertexCount()},
             {"joints", character.skin.joints.size()},
             {"influences", static_cast<double>(character.weights.influences.size()) / character.cage.vertexCount()},
             {"characters", desc_.characters}};
    const auto cost = [&](size_t way) -> const std::vector<double>& {
        const Series& own = (*series)[way];
        return device_.isCpu() || own.gpu.empty() ? own.cpu : own.gpu;
    };
    for (size_t way = 0; way < std::size(kWays); ++way) {
        std::vector<double> ratios;
        for (size_t round = 0; round < cost(way).size(); ++round) {
            ratios.push_back(cost(way)[round] / cost(kOver)[round]);
        }
        std::sort(ratios.begin(), ratios.end());
        row["ways"].push_back({{"skinning", kWays[way].name},
                               {"nanosecondsPerVertex", tools::summarize(cost(way)).median},
                               {"overDualQuaternions", tools::quantile(ratios, 0.5)},
                               {"least", ratios.front()},
                               {"largest", ratios.back()}});
    }
    return row;
}

} // namespace

Result<Json> measureSkinning(host::Device& device, Workbench& workbench, const SkinningDesc& desc) {
    return SkinningRace(device, workbench, desc).run();
}

} // namespace supple::bench
