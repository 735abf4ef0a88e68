#include "tools/bench/queries.h"

#include "tools/bench/clocks.h"
#include "tools/bench/crowd_character.h"
#include "tools/bench/pass_times.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace supple::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t kWarmQueryFrames = 2;
constexpr double kQueryFrameSeconds = 1.0 / 60.0;
constexpr uint32_t kRowLength = 10; ///< characters stand in rows

/// A crowd that rays are aimed at.
struct Targets {
    SuppleGroup group{};
    std::vector<glm::vec3> cage; ///< of a character in the bind pose
    double radius = 0.0;
    uint32_t characters = 0;

    [[nodiscard]] glm::dvec3 middleOf(uint32_t character) const {
        return 4.0 * radius * glm::dvec3(character % kRowLength, character / kRowLength, 0.0);
    }
};

/// Ray k begins outside of character k % characters, and goes through its middle or past it by less than its radius.
std::vector<SuppleRay> raysAt(const Targets& targets, uint32_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto inBall = [&] {
        glm::dvec3 p;
        do {
            p = {number(random), number(random), number(random)};
        } while (glm::dot(p, p) > 1.0 || glm::dot(p, p) < 0.01);
        return p;
    };
    std::vector<SuppleRay> rays;
    for (uint32_t k = 0; k < count; ++k) {
        const glm::dvec3 middle = targets.middleOf(k % targets.characters), from = glm::normalize(inBall());
        const glm::dvec3 origin = middle + 2.0 * targets.radius * from, d = middle + targets.radius * inBall() - origin;
        SuppleRay ray{};
        for (int i = 0; i < 3; ++i) {
            ray.origin[i] = static_cast<float>(origin[i]);
            ray.direction[i] = static_cast<float>(d[i]);
        }
        ray.tMax = std::numeric_limits<float>::infinity();
        rays.push_back(ray);
    }
    return rays;
}

/// Milliseconds of pass queries, by frame. A frame's times are known when the next one begins.
Result<std::vector<double>> timesOf(host::Device& device, Workbench& workbench, const Targets& targets,
                                    const std::vector<SuppleRay>& rays, uint32_t frames) {
    const Result<SuppleQueryPool> pool = workbench.createQueryPool(targets.group, static_cast<uint32_t>(rays.size()));
    if (!pool) {
        return pool.error();
    }
    std::vector<double> times;
    Status status = success();
    for (uint32_t frame = 0; frame <= kWarmQueryFrames + frames && status; ++frame) {
        workbench.setTime(targets.group, frame * kQueryFrameSeconds);
        Status recorded = success();
        status = device.submitAndWait([&](VkCommandBuffer commands) {
            recorded = workbench.recordFrame(targets.group, commands, SUPPLE_RECORD_TIMINGS);
            recorded = recorded ? workbench.recordQueries(*pool, commands, rays) : recorded;
        });
        status = recorded ? status : recorded;
        if (frame > kWarmQueryFrames) {
            times.push_back(PassTimes(workbench.timings()).of("queries"));
        }
    }
    workbench.destroy(*pool);
    return status ? Result<std::vector<double>>(std::move(times)) : status.error();
}

/// Milliseconds for the same rays on the CPU: a call for each character that any is aimed at.
Result<double> cpuTimeOf(const Workbench& workbench, const Targets& targets, const std::vector<SuppleRay>& rays) {
    std::vector<std::vector<float>> values(std::min<size_t>(targets.characters, rays.size()));
    for (size_t k = 0; k < rays.size(); ++k) {
        const size_t target = k % targets.characters;
        const glm::dvec3 middle = targets.middleOf(static_cast<uint32_t>(target));
        for (int i = 0; i < 3; ++i) {
            values[target].push_back(static_cast<float>(double{rays[k].origin[i]} - middle[i]));
        }
        values[target].insert(values[target].end(), rays[k].direction, rays[k].direction + 3);
    }
    // The first call makes the group's surfaces.
    if (const Status warm = workbench.findRays(targets.group, targets.cage, std::span(values[0]).first(6)); !warm) {
        return warm.error();
    }
    const double begin = wallSeconds();
    for (const std::vector<float>& own : values) {
        if (const Status found = workbench.findRays(targets.group, targets.cage, own); !found) {
            return found.error();
        }
    }
    return 1e3 * (wallSeconds() - begin);
}

Result<Json> rowsOf(host::Device& device, Workbench& workbench, const Targets& targets, const QueriesDesc& desc) {
    for (uint32_t k = 0; k < targets.characters; ++k) {
        workbench.moveTo(targets.group, k, targets.middleOf(k));
    }
    Json rows = Json::array();
    for (const uint32_t count : desc.rays) {
        if (desc.progress) {
            desc.progress(std::to_string(targets.characters) + ", " + std::to_string(count));
        }
        const std::vector<SuppleRay> rays = raysAt(targets, count);
        const Result<std::vector<double>> times = timesOf(device, workbench, targets, rays, desc.frames);
        if (!times) {
            return times.error();
        }
        const Result<double> onCpu = cpuTimeOf(workbench, targets, rays);
        if (!onCpu) {
            return onCpu.error();
        }
        const double queries = tools::summarize(*times).median;
        rows.push_back({{"characters", targets.characters},
                        {"rays", count},
                        {"queriesMs", queries},
                        {"raysASecond", 1e3 * count / queries},
                        {"cpuMs", *onCpu},
                        {"cpuOverQueries", *onCpu / queries}});
    }
    return rows;
}

} // namespace

Result<Json> measureQueries(host::Device& device, Workbench& workbench, const QueriesDesc& desc) {
    Result<BenchCage> character = makeCrowdCharacter();
    if (!character) {
        return character.error();
    }
    Targets targets;
    targets.cage = character->character.cage.positions;
    for (const glm::vec3& p : targets.cage) {
        targets.radius = std::max(targets.radius, glm::length(glm::dvec3(p)));
    }
    const Result<SuppleAsset> asset = workbench.createAsset(std::move(character->character));
    if (!asset) {
        return asset.error();
    }
    Json rows = Json::array();
    Status status = success();
    for (size_t i = 0; i < desc.characters.size() && status; ++i) {
        SuppleGroupDesc own{};
        own.asset = *asset;
        own.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
        own.rate = 1;
        own.capacity = targets.characters = desc.characters[i];
        own.poseSource = SUPPLE_POSES_PLAYBACK;
        const Result<SuppleGroup> group = workbench.createGroup(own);
        if (!group) {
            status = group.error();
            break;
        }
        targets.group = *group;
        const Result<Json> measured = rowsOf(device, workbench, targets, desc);
        if (measured) {
            rows.insert(rows.end(), measured->begin(), measured->end());
        } else if (measured.error().code != ErrorCode::disabled) {
            status = measured.error();
        }
        workbench.destroy(*group);
    }
    workbench.destroy(*asset);
    return status ? Result<Json>(std::move(rows)) : status.error();
}

} // namespace supple::bench
