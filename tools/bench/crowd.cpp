#include "tools/bench/crowd.h"

#include "tools/bench/crowd_character.h"
#include "tools/bench/device_write.h"
#include "tools/bench/playing_group.h"
#include "tools/bench/replay.h"
#include "tools/common/schemes.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint32_t kVertexBytes = 16;
constexpr uint32_t kOneCharacterRate = 8;

/// The device's clock where there is one.
const std::vector<double>& clockOf(const Series& series) {
    return series.gpu.empty() ? series.wall : series.gpu;
}

double median(const std::vector<double>& values) {
    return tools::summarize(values).median;
}

/// How much of what memory takes evaluation wrote, round by round: against that way of writing which is the faster.
Json shareOf(const Series& evaluate, const Series& fill, const Series& store) {
    const std::vector<double>& fastest =
        median(clockOf(fill)) < median(clockOf(store)) ? clockOf(fill) : clockOf(store);
    std::vector<double> shares;
    for (size_t i = 0; i < fastest.size(); ++i) {
        shares.push_back(fastest[i] / clockOf(evaluate)[i]);
    }
    std::sort(shares.begin(), shares.end());
    return {{"median", tools::quantile(shares, 0.5)}, {"least", shares.front()}, {"largest", shares.back()}};
}

SuppleGroupDesc crowdGroup(SuppleAsset asset, SuppleScheme scheme, uint32_t rate, uint32_t characters) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.scheme = scheme;
    desc.rate = rate;
    desc.capacity = characters;
    return desc;
}

Result<Json> measureRow(host::Device& device, const CrowdDesc& desc, const PlayingGroup& crowd) {
    const bool one = crowd.output().info.capacity == 1;
    std::vector<std::unique_ptr<Replay>> replays;
    std::vector<Contestant> contestants;
    std::unique_ptr<DeviceWrite> write;
    const auto add = [&](const char* name, uint64_t points, Result<std::unique_ptr<Replay>> replay) -> Status {
        if (!replay) {
            return replay.error();
        }
        contestants.push_back((*replay)->contestant(name, points));
        replays.push_back(std::move(*replay));
        return success();
    };
    Status status = add("evaluate", crowd.vertices(), crowd.replay(Passes::evaluate));
    if (status) {
        status = add("frame", crowd.vertices(), crowd.replay(Passes::frame));
    }
    if (status && !one) {
        Result<std::unique_ptr<DeviceWrite>> made = DeviceWrite::create(device, crowd.vertices() * kVertexBytes);
        if (!made) {
            return made.error();
        }
        write = std::move(*made);
        const uint64_t elements = write->size() / kVertexBytes;
        status = add("fill", elements, Replay::create(device, [&](VkCommandBuffer c) { write->recordFill(c); }));
        if (status) {
            status = add("store", elements, Replay::create(device, [&](VkCommandBuffer c) { write->recordStore(c); }));
        }
    }
    if (!status) {
        return status.error();
    }
    const Result<std::vector<Series>> all = runRounds(contestants, desc.rounds);
    if (!all) {
        return all.error();
    }
    const auto milliseconds = [&](const Series& series) {
        return 1e-6 * median(clockOf(series)) * static_cast<double>(crowd.vertices());
    };
    const auto gigabytes = [&](const Series& series) { return kVertexBytes / median(clockOf(series)); };
    const Series &evaluate = (*all)[0], &frame = (*all)[1];
    Json row{{"characters", crowd.output().info.capacity},
             {"patches", crowd.output().surface.patchCount},
             {"vertices", crowd.vertices()},
             {"clock", evaluate.gpu.empty() ? "wall" : "device timestamps"},
             {"evaluateMs", milliseconds(evaluate)},
             {"frameMs", milliseconds(frame)}};
    if (!one) {
        const Series &fill = (*all)[2], &store = (*all)[3];
        row["evaluateGigabytesPerSecond"] = gigabytes(evaluate);
        row["fillGigabytesPerSecond"] = gigabytes(fill);
        row["storeGigabytesPerSecond"] = gigabytes(store);
        row["bandwidthShare"] = shareOf(evaluate, fill, store);
    }
    return row;
}

} // namespace

Result<Json> measureCrowd(host::Device& device, Workbench& workbench, const CrowdDesc& desc) {
    Result<BenchCage> character = makeCrowdCharacter();
    if (!character) {
        return character.error();
    }
    Json result{{"character", character->name},
                {"faces", character->character.cage.faceCount()},
                {"joints", kCrowdJoints},
                {"influences", kCrowdInfluences},
                {"rows", Json::array()}};
    Result<SuppleAsset> asset = workbench.createAsset(std::move(character->character));
    if (!asset) {
        return asset.error();
    }
    const auto measure = [&](SuppleScheme scheme, uint32_t rate, uint32_t wanted) -> Status {
        uint32_t characters = wanted;
        if (wanted > 1) { // what one takes tells how many there is room for
            PlayingGroup one(device, workbench);
            Status status = one.create(crowdGroup(*asset, scheme, rate, 1));
            if (!status) {
                return status;
            }
            const VkDeviceSize bytes = VkDeviceSize{one.output().grid.verticesPerInstance} * kVertexBytes;
            characters = std::max(charactersThatFit(device, bytes, bytes, wanted), 2u);
        }
        if (desc.progress) {
            desc.progress(std::string(tools::schemeName(scheme)) + ", rate " + std::to_string(rate) + ", " +
                          std::to_string(characters));
        }
        PlayingGroup crowd(device, workbench);
        const Status status = crowd.create(crowdGroup(*asset, scheme, rate, characters));
        Result<Json> row = status ? measureRow(device, desc, crowd) : Result<Json>(status.error());
        if (!row) {
            return row.error();
        }
        Json named{{"scheme", tools::schemeName(scheme)}, {"rate", rate}};
        named.update(*row);
        result["rows"].push_back(std::move(named));
        return success();
    };
    Status status = success();
    for (const SuppleScheme scheme : desc.schemes) {
        for (const uint32_t rate : desc.rates) {
            status = status && desc.characters > 1 ? measure(scheme, rate, desc.characters) : status;
        }
        status = status ? measure(scheme, kOneCharacterRate, 1) : status;
    }
    workbench.destroy(*asset);
    if (!status) {
        return status.error();
    }
    return result;
}

Result<std::vector<Agreement>> compareCrowd(host::Device& device, Workbench& workbench, SuppleScheme scheme) {
    constexpr uint32_t kRate = 4, kSmallCrowd = 3;
    Result<BenchCage> character = makeCrowdCharacter();
    Result<SuppleAsset> asset =
        character ? workbench.createAsset(std::move(character->character)) : Result<SuppleAsset>(character.error());
    if (!asset) {
        return asset.error();
    }
    PlayingGroup alone(device, workbench), crowd(device, workbench);
    Status status = alone.create(crowdGroup(*asset, scheme, kRate, 1));
    if (status) {
        status = crowd.create(crowdGroup(*asset, scheme, kRate, kSmallCrowd));
    }
    workbench.destroy(*asset);
    std::vector<std::vector<std::byte>> all;
    for (const auto& [from, instance] : {std::pair(&alone, 0u), std::pair(&crowd, 0u), std::pair(&crowd, 2u)}) {
        Result<std::vector<std::byte>> read =
            status ? from->verticesOf(instance) : Result<std::vector<std::byte>>(status.error());
        if (!read) {
            return read.error();
        }
        all.push_back(std::move(*read));
    }
    const auto vertices = [&](size_t a, size_t b, bool equal) {
        double count = 0.0;
        for (size_t at = 0; at < all[a].size(); at += kVertexBytes) {
            count += (std::memcmp(&all[a][at], &all[b][at], kVertexBytes) == 0) == equal ? 1.0 : 0.0;
        }
        return count;
    };
    const std::string name = std::string("crowd of ") + tools::schemeName(scheme);
    return std::vector<Agreement>{
        {name + ": vertices of its first character unlike those of one alone", vertices(0, 1, false), 0.0},
        {name + ": vertices that two characters have in common", vertices(1, 2, true), 0.0}};
}

} // namespace supple::bench
