#include "tools/bench/heat.h"

#include "tools/bench/avx2_evaluation.h"
#include "tools/bench/plain_evaluation.h"
#include "tools/bench/replay.h"
#include "tools/bench/write_bandwidth.h"
#include "tools/common/schemes.h"
#include "tools/common/statistics.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kAvx2 = "AVX2 bi-3";
constexpr const char* kPlain = "plain C++ bi-3";
constexpr const char* kWrite24 = "write 24 B";
constexpr const char* kCpu = " CPU"; ///< behind a scheme: supple_cpu.h, one thread

/// What there is of a scheme: its plain form first, which the others' points are counted by.
struct Variant {
    const char* word = ""; ///< after the scheme
    const char* suffix = "";
    SuppleVertexFormat format = SUPPLE_VERTEX_16;
    uint32_t flags = 0;

    [[nodiscard]] std::string name(const std::string& scheme, const char* pass) const {
        return scheme + word + " " + pass + suffix;
    }
};
constexpr Variant kPlainVariant{};
constexpr Variant kVertex24Variant{"", " 24 B", SUPPLE_VERTEX_24, 0};
constexpr Variant kSharedVariant{" shared", "", SUPPLE_VERTEX_16, SUPPLE_GROUP_INDEXED_MESH};

class Heat {
public:
    Heat(host::Device& device, Workbench& workbench, const HeatDesc& desc)
        : device_(device), workbench_(workbench), desc_(desc) {}
    ~Heat() {
        replays_.clear();
        for (const SuppleGroup group : groups_) {
            workbench_.destroy(group);
        }
    }
    Heat(const Heat&) = delete;
    Heat& operator=(const Heat&) = delete;

    Status addSchemes();
    Status addPeers(const OpensubdivPeers& peers);
    void addYardsticks();
    Result<Json> run();

private:
    Status addSubject(SuppleAsset asset, SuppleScheme scheme, const Variant& variant);
    Status addReplay(const std::string& name, uint64_t points, const std::function<void(VkCommandBuffer)>& record);
    void addHost(const std::string& name, uint64_t points, std::function<void(uint32_t turn)> work);
    void addRatios(Json& row, std::span<const Series> series) const;

    host::Device& device_;
    Workbench& workbench_;
    const HeatDesc& desc_;
    std::vector<SuppleGroup> groups_;
    std::vector<std::unique_ptr<Replay>> replays_;
    std::vector<Peer> peers_;
    std::set<std::string> wallAlone_; ///< of these: run on the device, which does not time them
    std::vector<float> plainOut_, avx2Out_, writeOut_;
    BicubicWeights weights_{};
    std::vector<std::string> schemes_; ///< that took the cage
    uint64_t points_ = 0;              ///< of the newest scheme, every patch with all its samples
    std::vector<Contestant> contestants_;
    Json refused_ = Json::array();
};

Status Heat::addSchemes() {
    Result<SuppleAsset> asset = workbench_.createAsset(desc_.cage->character);
    if (!asset) {
        return asset.error();
    }
    Status status = success();
    for (const SuppleScheme scheme : desc_.cage->schemes) {
        status = addSubject(*asset, scheme, kPlainVariant);
        if (status && scheme == SUPPLE_SCHEME_PREP && desc_.cage->bothFormats) {
            status = addSubject(*asset, scheme, kVertex24Variant);
        }
        if (status && sharesSamples(scheme)) {
            status = addSubject(*asset, scheme, kSharedVariant);
        }
        if (!status && (status.error().code == ErrorCode::asset || status.error().code == ErrorCode::limit)) {
            refused_.push_back({{"scheme", tools::schemeName(scheme)}, {"reason", status.error().message}});
            status = success();
        }
        if (!status) {
            break;
        }
    }
    workbench_.destroy(*asset);
    return status;
}

Status Heat::addSubject(SuppleAsset asset, SuppleScheme scheme, const Variant& variant) {
    SuppleGroupDesc groupDesc{};
    groupDesc.asset = asset;
    groupDesc.scheme = scheme;
    groupDesc.rate = desc_.rate;
    groupDesc.vertexFormat = variant.format;
    groupDesc.flags = variant.flags;
    Result<SuppleGroup> made = workbench_.createGroup(groupDesc);
    if (!made) {
        return made.error();
    }
    const SuppleGroup group = *made;
    groups_.push_back(group);
    Status recorded = success(); // tables and poses go up
    const Status submitted =
        device_.submitAndWait([&](VkCommandBuffer commands) { recorded = workbench_.recordFrame(group, commands); });
    if (!recorded || !submitted) {
        return recorded ? submitted : recorded;
    }
    const std::string name = tools::schemeName(scheme);
    if (&variant == &kPlainVariant) {
        schemes_.push_back(name);
        points_ = workbench_.output(group).grid.vertexCount;
        const auto grid = Workbench::cpuGrid(desc_.cage->character, scheme, workbench_.output(group).grid.rate);
        if (grid) {
            addHost(name + kCpu, points_, [evaluate = *grid](uint32_t) { evaluate(); });
        }
    }
    Status status = addReplay(variant.name(name, "evaluate"), points_,
                              [&](VkCommandBuffer commands) { workbench_.recordEvaluate(group, commands); });
    if (status) {
        status = addReplay(variant.name(name, "frame"), points_,
                           [&](VkCommandBuffer commands) { workbench_.recordCompute(group, commands); });
    }
    return status;
}

Status Heat::addReplay(const std::string& name, uint64_t points, const std::function<void(VkCommandBuffer)>& record) {
    Result<std::unique_ptr<Replay>> made = Replay::create(device_, record);
    if (!made) {
        return made.error();
    }
    contestants_.push_back((*made)->contestant(name, points));
    replays_.push_back(std::move(*made));
    return success();
}

Status Heat::addPeers(const OpensubdivPeers& peers) {
    for (const PeerRules rules : desc_.cage->peers) {
        Result<std::vector<Peer>> made = peers.make(desc_.cage->character.cage, rules, desc_.rate);
        if (made) {
            peers_.insert(peers_.end(), made->begin(), made->end());
        } else if (made.error().code == ErrorCode::asset || made.error().code == ErrorCode::limit) {
            refused_.push_back({{"scheme", peerName(rules)}, {"reason", made.error().message}});
        } else {
            return made.error();
        }
    }
    for (const Peer& peer : peers_) {
        Contestant contestant{peer.name, peer.points,
                              [run = peer.run](uint32_t times) {
                                  Status status = success();
                                  for (uint32_t i = 0; status && i < times; ++i) {
                                      status = run();
                                  }
                                  return status;
                              },
                              nullptr};
        if (peer.deviceSeconds && !device_.isCpu()) {
            const Result<double> seconds = peer.deviceSeconds(1);
            if (!seconds) {
                return seconds.error();
            }
            if (*seconds > 0.0) {
                contestant.deviceSeconds = peer.deviceSeconds;
            } else {
                wallAlone_.insert(peer.name);
            }
        }
        contestants_.push_back(std::move(contestant));
    }
    return success();
}

void Heat::addHost(const std::string& name, uint64_t points, std::function<void(uint32_t turn)> work) {
    contestants_.push_back({name, points,
                            [work = std::move(work)](uint32_t times) {
                                for (uint32_t i = 0; i < times; ++i) {
                                    work(i);
                                }
                                return success();
                            },
                            nullptr});
}

void Heat::addYardsticks() {
    const size_t patches = desc_.yardstick.size() / 64;
    const uint64_t points = uint64_t{patches} * (desc_.rate + 1) * (desc_.rate + 1);
    fillBicubicWeights(weights_, desc_.rate);
    plainOut_.resize(6 * points);
    writeOut_.resize(6 * points);
    addHost(kPlain, points, [this](uint32_t) { evaluatePlain(desc_.yardstick, desc_.rate, plainOut_); });
    if (hasAvx2Evaluation()) {
        avx2Out_.resize(6 * points);
        addHost(kAvx2, points, [this, patches](uint32_t) {
            evaluateAvx2(desc_.yardstick.data(), patches, desc_.rate, weights_, avx2Out_.data());
        });
    }
    addHost(kWrite24, points, [this](uint32_t turn) { writeAll(writeOut_, turn); });
}

void Heat::addRatios(Json& row, std::span<const Series> series) const {
    const auto seriesOf = [&](const std::string& name) -> const Series* {
        for (size_t c = 0; c < contestants_.size(); ++c) {
            if (contestants_[c].name == name) {
                return &series[c];
            }
        }
        return nullptr;
    };
    const auto cost = [&](const Series& s, bool wall) -> const std::vector<double>& {
        return device_.isCpu() ? s.cpu : s.gpu.empty() || wall ? s.wall : s.gpu;
    };
    row["ratios"] = Json::array();
    const auto add = [&](const std::string& of, const std::string& over, bool yardstick) {
        const Series *above = seriesOf(of), *below = seriesOf(over);
        if (above == nullptr || below == nullptr) {
            return;
        }
        const bool wall = wallAlone_.contains(of) || wallAlone_.contains(over);
        std::vector<double> ratios;
        for (size_t i = 0; i < above->cpu.size(); ++i) {
            ratios.push_back(cost(*above, wall)[i] / cost(*below, wall)[i]);
        }
        std::sort(ratios.begin(), ratios.end());
        row["ratios"].push_back({{"name", of + " / " + over},
                                 {"of", of},
                                 {"over", over},
                                 {"yardstick", yardstick},
                                 {"median", tools::quantile(ratios, 0.5)},
                                 {"least", ratios.front()},
                                 {"largest", ratios.back()}});
    };
    for (const std::string& scheme : schemes_) {
        for (const Variant* variant : {&kPlainVariant, &kVertex24Variant, &kSharedVariant}) {
            const std::string evaluate = variant->name(scheme, "evaluate"), frame = variant->name(scheme, "frame");
            add(frame, evaluate, false);
            for (const std::string& ours : {evaluate, frame}) {
                add(ours, kAvx2, true);
                add(ours, kPlain, true);
            }
        }
        add(scheme + kCpu, kPlainVariant.name(scheme, "evaluate"), false);
        add(scheme + kCpu, kAvx2, false);
        add(kSharedVariant.name(scheme, "evaluate"), kPlainVariant.name(scheme, "evaluate"), false);
        if (scheme != schemes_.front()) {
            add(scheme + " evaluate", schemes_.front() + " evaluate", false);
        }
        for (const Peer& peer : peers_) {
            if (scheme != "blend" && (scheme == "loop") == (peer.rules == PeerRules::loop)) {
                add(scheme + " evaluate", peer.name, true);
                add(scheme + kCpu, peer.name, false);
            }
        }
    }
    add(kPlain, kAvx2, false);
    add(kAvx2, kWrite24, false);
}

Result<Json> Heat::run() {
    const Result<std::vector<Series>> series = runRounds(contestants_, desc_.rounds);
    if (!series) {
        return series.error();
    }
    Json row{{"cage", desc_.cage->name}, {"faces", desc_.cage->character.cage.faceCount()}, {"rate", desc_.rate}};
    for (size_t c = 0; c < contestants_.size(); ++c) {
        const auto median = [](const std::vector<double>& values) {
            return values.empty() ? Json() : Json(tools::summarize(values).median);
        };
        row["contestants"].push_back({{"name", contestants_[c].name},
                                      {"points", contestants_[c].points},
                                      {"cpuNanosecondsPerPoint", median((*series)[c].cpu)},
                                      {"wallNanosecondsPerPoint", median((*series)[c].wall)},
                                      {"gpuNanosecondsPerPoint", median((*series)[c].gpu)}});
    }
    addRatios(row, *series);
    row["refused"] = refused_;
    return row;
}

} // namespace

Result<Json> runHeat(host::Device& device, Workbench& workbench, const OpensubdivPeers& peers, const HeatDesc& desc) {
    Heat heat(device, workbench, desc);
    Status status = heat.addSchemes();
    if (status) {
        status = heat.addPeers(peers);
    }
    if (!status) {
        return status.error();
    }
    heat.addYardsticks();
    return heat.run();
}

} // namespace supple::bench
