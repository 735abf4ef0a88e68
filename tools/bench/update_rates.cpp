#include "tools/bench/update_rates.h"

#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/common/statistics.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kWarmRateFrames = 9; ///< more than the longest interval
constexpr double kRatedFrameSeconds = 1.0 / 60.0;

/// What the character has besides: springs, morph targets, drivers of them, vertices that jiggle, a cloth; or springs
/// and what is soft together.
enum class Has : size_t { springs, targets, drivers, jiggles, cloth, allThatSwings };
constexpr size_t kCharacters = 6;
constexpr bool hasSprings(Has has) {
    return has == Has::springs || has == Has::allThatSwings;
}
constexpr bool hasJiggles(Has has) {
    return has == Has::jiggles || has == Has::allThatSwings;
}
constexpr bool hasCloth(Has has) {
    return has == Has::cloth || has == Has::allThatSwings;
}
constexpr bool hasTargets(Has has) {
    return has == Has::targets || has == Has::drivers;
}

/// 0: the group has no update rates. `swings`: joints or vertices do.
constexpr struct RatedKind {
    uint32_t interval;
    bool swings = false;
    Has has = Has::springs;
} kRatedKinds[] = {{0},
                   {1},
                   {2},
                   {4},
                   {8},
                   {0, true},
                   {0, false, Has::targets},
                   {0, false, Has::drivers},
                   {0, true, Has::jiggles},
                   {0, true, Has::cloth},
                   {0, true, Has::allThatSwings}};

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

/// A dozen drivers of two targets each, which look at a joint in eight poses.
constexpr uint32_t kDrivers = 12, kDriverPoses = 8, kDriverTargets = 2;
void addTargets(cage::Character& character) {
    const uint32_t vertices = character.cage.vertexCount();
    for (uint32_t t = 0; t < kDrivers * kDriverTargets; ++t) {
        cage::MorphTarget target;
        for (uint32_t v = t * vertices / (kDrivers * kDriverTargets + 1), end = v + vertices / 20; v < end; ++v) {
            target.vertices.push_back(v);
            target.deltas.emplace_back(0.0f, 0.01f, 0.0f);
        }
        character.morphs.targets.push_back(std::move(target));
        character.morphs.weights.push_back(0.0f);
    }
    character.parts[0].targetCount = kDrivers * kDriverTargets;
}
void addDrivers(cage::Character& character) {
    for (uint32_t d = 0; d < kDrivers; ++d) {
        cage::PoseDriver driver;
        driver.inputs.push_back({.node = character.skin.joints[(d + 1) * character.skin.joints.size() / (kDrivers + 1)],
                                 .part = cage::TurnPart::swing});
        driver.targets = {kDriverTargets * d, kDriverTargets * d + 1};
        for (uint32_t pose = 0; pose < kDriverPoses; ++pose) {
            const float way = 6.2831853f * static_cast<float>(pose) / static_cast<float>(kDriverPoses);
            driver.poses.emplace_back(0.6f * std::cos(way), 0.0f, 0.6f * std::sin(way), 0.8f);
            driver.values.insert(driver.values.end(), {pose % 2 == 0 ? 1.0f : 0.0f, pose % 4 == 1 ? 1.0f : 0.0f});
        }
        character.drivers.push_back(std::move(driver));
    }
}

/// So many vertices from one on, side by side as the cage has them.
constexpr uint32_t kJiggling = 300;
void addJiggles(cage::Character& character, uint32_t first) {
    character.jiggles.push_back({});
    character.weights.jiggles.resize(character.cage.vertexCount());
    for (uint32_t v = first; v < std::min(first + kJiggling, character.cage.vertexCount()); ++v) {
        character.weights.jiggles[v] = {0, 1.0f};
    }
}

/// As many vertices as a cape has, side by side; a collider.
constexpr uint32_t kClothVertices = 180;
void addCloth(cage::Character& character) {
    character.springBones.colliders.push_back({.node = character.skin.joints.front(), .radius = 0.1f});
    character.cloths.push_back({.colliders = {0}});
    character.weights.cloths.resize(character.cage.vertexCount());
    for (uint32_t v = 0; v < std::min(kClothVertices, character.cage.vertexCount()); ++v) {
        character.weights.cloths[v] = {0, 1.0f};
    }
}

void add(Has has, cage::Character& character) {
    switch (has) {
    case Has::springs:
        return addSprings(character);
    case Has::targets:
        return addTargets(character);
    case Has::drivers:
        addTargets(character);
        return addDrivers(character);
    case Has::jiggles:
        return addJiggles(character, 0);
    case Has::cloth:
        return addCloth(character);
    case Has::allThatSwings:
        addSprings(character);
        addCloth(character);
        return addJiggles(character, kClothVertices);
    }
}

struct RatedGroup {
    RatedKind kind;
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

    Status create(const std::array<SuppleAsset, kCharacters>& assets) {
        for (const RatedKind& kind : kRatedKinds) {
            SuppleGroupDesc desc{};
            desc.asset = assets[static_cast<size_t>(kind.has)];
            desc.scheme = SUPPLE_SCHEME_CAGE;
            desc.capacity = characters_;
            desc.poseSource = SUPPLE_POSES_PLAYBACK;
            if (kind.interval != 0) {
                desc.flags = SUPPLE_GROUP_UPDATE_RATES;
            } else if (kind.swings) {
                desc.flags = (hasSprings(kind.has) ? SUPPLE_GROUP_SPRINGS : 0) |
                             (hasJiggles(kind.has) || hasCloth(kind.has) ? SUPPLE_GROUP_SOFT : 0);
            }
            const Result<SuppleGroup> made = workbench_.createGroup(desc, kind.interval);
            if (!made) {
                return made.error();
            }
            groups_.push_back({kind, *made, {}, {}, {}, 0});
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
            rows.push_back(
                {{"characters", characters_},
                 {"interval", own.kind.interval},
                 {"springJoints", own.kind.swings && hasSprings(own.kind.has) ? kChains * kChainJoints : 0},
                 {"jiggling", hasJiggles(own.kind.has) ? kJiggling : 0},
                 {"cloth", hasCloth(own.kind.has) ? kClothVertices : 0},
                 {"morphTargets", hasTargets(own.kind.has) ? kDrivers * kDriverTargets : 0},
                 {"drivers", own.kind.has == Has::drivers ? kDrivers : 0},
                 {"posed", static_cast<double>(own.posed) / joints / frames},
                 {"poseMs", tools::summarize(own.pose).median},
                 {"deformMs", tools::summarize(own.deform).median},
                 {"recordUs", tools::summarize(own.record).median},
                 {"instanceKb", static_cast<double>(workbench_.deviceMemoryOf(own.group)) / 1000.0 / characters_},
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
    std::array<SuppleAsset, kCharacters> assets{};
    Status status = success();
    for (size_t has = 0; has < kCharacters && status; ++has) {
        Result<BenchCage> character = makeCrowdCharacter();
        if (!character) {
            return character.error();
        }
        add(static_cast<Has>(has), character->character);
        const Result<SuppleAsset> made = workbench.createAsset(std::move(character->character));
        status = made ? success() : Status(made.error());
        assets[has] = made ? *made : SuppleAsset{};
    }
    Json rows = Json::array();
    for (size_t i = 0; i < desc.characters.size() && status; ++i) {
        if (desc.progress) {
            desc.progress(std::to_string(desc.characters[i]));
        }
        RatedCrowd crowd(device, workbench, desc.characters[i]);
        status = crowd.create(assets);
        status = status ? crowd.measure(desc.frames) : status;
        for (Json& row : crowd.rows()) {
            rows.push_back(std::move(row));
        }
    }
    for (const SuppleAsset asset : assets) {
        workbench.destroy(asset);
    }
    return status ? Result<Json>(std::move(rows)) : status.error();
}

} // namespace supple::bench
