#include "tools/bench/update_rates.h"

#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/common/statistics.h"

#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kWarmRateFrames = 9; ///< more than the longest interval
constexpr double kRatedFrameSeconds = 1.0 / 60.0;

/// 0: the group has no update rates. `springs`: joints swing.
constexpr struct {
    uint32_t interval;
    bool springs;
} kRatedKinds[] = {{0, false}, {1, false}, {2, false}, {4, false}, {8, false}, {0, true}};

/// Four chains of three joints that swing, and a collider.
constexpr uint32_t kChains = 4, kChainJoints = 3;
void addSprings(cage::Character& character) {
    const std::vector<cage::Node>& nodes = character.skeleton.nodes;
    std::vector<uint32_t> children(nodes.size(), 0);
    for (const cage::Node& node : nodes) {
        if (node.parent != cage::kNone) {
            ++children[node.parent];
        }
    }
    std::vector<uint8_t> taken(nodes.size(), 0);
    cage::SpringBones& bones = character.springBones;
    bones.colliders.push_back({.node = character.skin.joints.front(), .radius = 0.1f});
    bones.colliderGroups.push_back({0});
    for (uint32_t leaf = 0; leaf < nodes.size() && bones.springs.size() < kChains; ++leaf) {
        std::vector<cage::SpringJoint> joints;
        for (uint32_t node = leaf;
             children[leaf] == 0 && node != cage::kNone && taken[node] == 0 && joints.size() <= kChainJoints;
             node = nodes[node].parent) {
            joints.insert(joints.begin(), {.node = node, .gravityPower = 0.2f});
        }
        if (joints.size() == kChainJoints + 1) {
            for (const cage::SpringJoint& joint : joints) {
                taken[joint.node] = 1;
            }
            bones.springs.push_back({.joints = std::move(joints), .colliderGroups = {0}});
        }
    }
}

struct RatedGroup {
    uint32_t interval = 0;
    bool springs = false;
    SuppleGroup group{};
    std::vector<double> pose, deform, record; ///< by frame
    uint64_t posed = 0;                       ///< joints
};

class RatedCrowd {
public:
    RatedCrowd(host::Device& device, Workbench& workbench, uint32_t characters)
        : device_(device), workbench_(workbench), characters_(characters) {}
    ~RatedCrowd() {
        for (const RatedGroup& own : groups_) {
            workbench_.destroy(own.group);
        }
    }
    RatedCrowd(const RatedCrowd&) = delete;
    RatedCrowd& operator=(const RatedCrowd&) = delete;

    Status create(SuppleAsset asset) {
        for (const auto& [interval, springs] : kRatedKinds) {
            SuppleGroupDesc desc{};
            desc.asset = asset;
            desc.scheme = SUPPLE_SCHEME_CAGE;
            desc.capacity = characters_;
            desc.poseSource = SUPPLE_POSES_PLAYBACK;
            desc.flags = interval != 0 ? SUPPLE_GROUP_UPDATE_RATES : springs ? SUPPLE_GROUP_SPRINGS : 0;
            const Result<SuppleGroup> made = workbench_.createGroup(desc, interval);
            if (!made) {
                return made.error();
            }
            groups_.push_back({interval, springs, *made, {}, {}, {}, 0});
        }
        return success();
    }

    Status measure(uint32_t frames) {
        for (uint32_t frame = 0; frame < kWarmRateFrames + frames; ++frame) {
            for (RatedGroup& own : groups_) {
                const Status status = step(own, frame);
                if (!status) {
                    return status;
                }
            }
        }
        return success();
    }

    [[nodiscard]] Json rows() const {
        Json rows = Json::array();
        for (const RatedGroup& own : groups_) {
            const auto frames = static_cast<double>(own.pose.size());
            const double joints = kCrowdJoints;
            rows.push_back({{"characters", characters_},
                            {"interval", own.interval},
                            {"springJoints", own.springs ? kChains * kChainJoints : 0},
                            {"posed", static_cast<double>(own.posed) / joints / frames},
                            {"poseMs", tools::summarize(own.pose).median},
                            {"deformMs", tools::summarize(own.deform).median},
                            {"recordUs", tools::summarize(own.record).median},
                            {"poseRatio", ratio(own, &RatedGroup::pose)},
                            {"deformRatio", ratio(own, &RatedGroup::deform)}});
        }
        return rows;
    }

private:
    /// A frame of one group; its times are known when the next frame begins.
    Status step(RatedGroup& own, uint32_t frame) {
        workbench_.setTime(own.group, frame * kRatedFrameSeconds);
        Status recorded = success();
        Status submitted = device_.submitAndWait([&](VkCommandBuffer commands) {
            recorded = workbench_.recordFrame(own.group, commands, SUPPLE_RECORD_TIMINGS);
        });
        if (last_ != nullptr && lastFrame_ >= kWarmRateFrames) {
            note(*last_);
        }
        last_ = &own;
        lastFrame_ = frame;
        return recorded ? submitted : recorded;
    }

    void note(RatedGroup& own) const {
        const PassTimes times(workbench_.timings());
        own.pose.push_back(times.of("pose"));
        own.deform.push_back(times.of("deform"));
        double record = 0.0;
        for (const SuppleTiming& timing : workbench_.timings()) {
            record += 1e-3 * timing.cpuRecord;
            own.posed += timing.pass == SUPPLE_PASS_POSE ? timing.points : 0;
        }
        own.record.push_back(record);
    }

    [[nodiscard]] double ratio(const RatedGroup& own, std::vector<double> RatedGroup::*times) const {
        std::vector<double> ratios;
        const std::vector<double>&a = own.*times, &all = groups_.front().*times;
        for (size_t i = 0; i < std::min(a.size(), all.size()); ++i) {
            ratios.push_back(a[i] / all[i]);
        }
        return tools::summarize(ratios).median;
    }

    host::Device& device_;
    Workbench& workbench_;
    uint32_t characters_;
    std::vector<RatedGroup> groups_;
    RatedGroup* last_ = nullptr;
    uint32_t lastFrame_ = 0;
};

} // namespace

Result<Json> measureUpdateRates(host::Device& device, Workbench& workbench, const UpdateRatesDesc& desc) {
    Result<BenchCage> character = makeCrowdCharacter();
    if (!character) {
        return character.error();
    }
    addSprings(character->character);
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
        RatedCrowd crowd(device, workbench, desc.characters[i]);
        status = crowd.create(*asset);
        status = status ? crowd.measure(desc.frames) : status;
        for (Json& row : crowd.rows()) {
            rows.push_back(std::move(row));
        }
    }
    workbench.destroy(*asset);
    return status ? Result<Json>(std::move(rows)) : status.error();
}

} // namespace supple::bench
