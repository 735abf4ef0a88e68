#include "tools/bench/classical.h"

#include "tools/bench/dense_mesh.h"
#include "tools/bench/playing_group.h"
#include "tools/common/schemes.h"
#include "tools/common/statistics.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr SuppleScheme kSurface = SUPPLE_SCHEME_PREP; ///< whose triangles are the dense mesh
constexpr const char* kDense = "polygons";
constexpr const char* kDenseSkin = "polygons, skin alone";
constexpr double kBindBound = 1e-5;
/// A character's joints bend it; interpolated weights bend it a little otherwise than its cage does.
constexpr double kPosedBound = 0.05;

/// One way to draw the crowd.
struct Way {
    std::string name;
    SuppleAsset asset{};
    SuppleScheme scheme = SUPPLE_SCHEME_POLYGONS;
    uint32_t flags = 0;
    uint64_t fileBytes = 0;
    std::unique_ptr<PlayingGroup> group;
};

SuppleGroupDesc groupOf(const Way& way, uint32_t rate, uint32_t characters) {
    SuppleGroupDesc desc{};
    desc.asset = way.asset;
    desc.scheme = way.scheme;
    desc.rate = rate;
    desc.flags = way.flags;
    desc.capacity = characters;
    return desc;
}

/// Without clips and images, which are the same in both.
Result<uint64_t> cageFileBytes(cage::Character character) {
    character.clips.clear();
    character.images.clear();
    character.materials.clear();
    character.cage.faceMaterials.clear();
    const Result<cage::GlbFile> file = cage::writeGlb(character);
    if (!file) {
        return file.error();
    }
    return uint64_t{file->bytes.size()};
}

/// A character at a rate, in all ways that there are to draw it.
class Race {
public:
    Race(host::Device& device, Workbench& workbench, const ClassicalDesc& desc, uint32_t rate)
        : device_(device), workbench_(workbench), desc_(desc), rate_(rate) {}
    ~Race() {
        replays_.clear();
        ways_.clear();
        workbench_.destroy(cage_);
        workbench_.destroy(dense_);
    }
    Race(const Race&) = delete;
    Race& operator=(const Race&) = delete;

    Status load();
    Result<Json> run();

private:
    Status makeGroups(uint32_t characters);
    [[nodiscard]] uint32_t charactersThatFit() const;
    Status addContestant(const std::string& name, const PlayingGroup& group, Passes passes);
    [[nodiscard]] const std::vector<double>& cost(const Series& series) const {
        return device_.isCpu() || series.gpu.empty() ? series.cpu : series.gpu;
    }
    [[nodiscard]] Json ratio(size_t of, size_t over, const std::vector<Series>& series) const;
    [[nodiscard]] Json describe(const Way& way, const Series& series) const;

    host::Device& device_;
    Workbench& workbench_;
    const ClassicalDesc& desc_;
    uint32_t rate_;
    SuppleAsset cage_{}, dense_{};
    std::vector<Way> ways_; ///< the dense mesh first
    uint64_t triangles_ = 0;
    std::vector<Contestant> contestants_; ///< the dense mesh, its skin, then the other ways
    std::vector<std::unique_ptr<Replay>> replays_;
    Json refused_ = Json::array();
};

Status Race::load() {
    const cage::Character& character = desc_.cage->character;
    Result<DenseMesh> dense = makeDenseMesh(device_, workbench_, character, kSurface, rate_);
    const Result<uint64_t> fileBytes = cageFileBytes(character);
    if (!dense || !fileBytes) {
        return dense ? fileBytes.error() : dense.error();
    }
    triangles_ = dense->character.cage.faceCount();
    Way& first = ways_.emplace_back();
    first.name = kDense;
    first.fileBytes = dense->fileBytes();
    Result<SuppleAsset> cageAsset = workbench_.createAsset(character);
    Result<SuppleAsset> denseAsset = workbench_.createAsset(std::move(dense->character));
    cage_ = cageAsset ? *cageAsset : SuppleAsset{};
    dense_ = denseAsset ? *denseAsset : SuppleAsset{};
    if (!cageAsset || !denseAsset) {
        return cageAsset ? denseAsset.error() : cageAsset.error();
    }
    first.asset = dense_;
    for (const SuppleScheme scheme : desc_.cage->schemes) {
        const std::string name = tools::schemeName(scheme);
        ways_.push_back({name, cage_, scheme, 0, *fileBytes, nullptr});
        if (sharesSamples(scheme)) {
            ways_.push_back({name + " shared", cage_, scheme, SUPPLE_GROUP_INDEXED_MESH, *fileBytes, nullptr});
        }
    }
    Status status = makeGroups(1);
    return status ? makeGroups(charactersThatFit()) : status;
}

/// Ways whose scheme refuses the cage are left out.
Status Race::makeGroups(uint32_t characters) {
    for (size_t w = 0; w < ways_.size();) {
        Way& way = ways_[w];
        way.group = std::make_unique<PlayingGroup>(device_, workbench_);
        Status status = way.group->create(groupOf(way, rate_, characters));
        if (!status && way.scheme != SUPPLE_SCHEME_POLYGONS && status.error().code == ErrorCode::asset) {
            refused_.push_back({{"scheme", way.name}, {"reason", status.error().message}});
            ways_.erase(ways_.begin() + static_cast<ptrdiff_t>(w));
            continue;
        }
        if (!status) {
            return status;
        }
        ++w;
    }
    return success();
}

/// From the groups of one.
uint32_t Race::charactersThatFit() const {
    VkDeviceSize bytes = 0, largest = 0;
    for (const Way& way : ways_) {
        const VkDeviceSize own = way.group->staticBytes().group; // a buffer of it is not larger
        bytes += own;
        largest = std::max(largest, own);
    }
    return bench::charactersThatFit(device_, bytes, largest, desc_.characters);
}

Status Race::addContestant(const std::string& name, const PlayingGroup& group, Passes passes) {
    Result<std::unique_ptr<Replay>> replay = group.replay(passes);
    if (!replay) {
        return replay.error();
    }
    contestants_.push_back((*replay)->contestant(name, 1)); // so series are nanoseconds a frame
    replays_.push_back(std::move(*replay));
    return success();
}

Json Race::ratio(size_t of, size_t over, const std::vector<Series>& series) const {
    std::vector<double> ratios;
    for (size_t i = 0; i < series[of].cpu.size(); ++i) {
        ratios.push_back(cost(series[of])[i] / cost(series[over])[i]);
    }
    std::sort(ratios.begin(), ratios.end());
    return {{"name", contestants_[of].name + " / " + contestants_[over].name},
            {"median", tools::quantile(ratios, 0.5)},
            {"least", ratios.front()},
            {"largest", ratios.back()}};
}

Json Race::describe(const Way& way, const Series& series) const {
    const auto milliseconds = [](const std::vector<double>& nanoseconds) {
        return nanoseconds.empty() ? Json() : Json(1e-6 * tools::summarize(nanoseconds).median);
    };
    const Workbench::StaticBytes bytes = way.group->staticBytes();
    const SuppleGroupInfo info = way.group->output().info;
    return {{"name", way.name},
            {"frameMs", milliseconds(series.gpu.empty() ? series.wall : series.gpu)},
            {"frameCpuMs", milliseconds(series.cpu)},
            {"vertices", way.group->output().grid.vertexCount},
            {"skinnedVertices", info.cageVertexCount},
            {"loadedBytes", bytes.deform + bytes.tables},
            {"characterBytes", bytes.group / info.capacity},
            {"poseBytes", info.poses.stride},
            {"fileBytes", way.fileBytes}};
}

Result<Json> Race::run() {
    Status status = addContestant(kDense, *ways_.front().group, Passes::frame);
    if (status) {
        status = addContestant(kDenseSkin, *ways_.front().group, Passes::skin);
    }
    for (size_t w = 1; status && w < ways_.size(); ++w) {
        status = addContestant(ways_[w].name, *ways_[w].group, Passes::frame);
    }
    if (!status) {
        return status.error();
    }
    const Result<std::vector<Series>> series = runRounds(contestants_, desc_.rounds);
    if (!series) {
        return series.error();
    }
    Json row{{"cage", desc_.cage->name},
             {"faces", desc_.cage->character.cage.faceCount()},
             {"joints", desc_.cage->character.skin.joints.size()},
             {"rate", rate_},
             {"characters", ways_.front().group->output().info.capacity},
             {"triangles", triangles_}};
    for (size_t w = 0; w < ways_.size(); ++w) {
        row["contestants"].push_back(describe(ways_[w], (*series)[w == 0 ? 0 : w + 1]));
    }
    Json skin = describe(ways_.front(), (*series)[1]);
    row["skinAloneMs"] = skin["frameMs"];
    row["skinAloneCpuMs"] = skin["frameCpuMs"];
    for (size_t c = 2; c < contestants_.size(); ++c) {
        row["ratios"].push_back(ratio(c, 0, *series));
        row["ratios"].push_back(ratio(c, 1, *series));
    }
    row["refused"] = refused_;
    return row;
}

/// Largest distance of the dense mesh's vertices from those of the surface, of the surface's extent.
double distance(const DenseMesh& mesh, const std::vector<std::byte>& cage, const std::vector<std::byte>& surface,
                size_t surfaceStride) {
    double largest = 0.0;
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (size_t v = 0; v < mesh.surfaceVertices.size(); ++v) {
        glm::vec3 dense, smooth;
        std::memcpy(&dense, &cage[v * sizeof(glm::vec4)], sizeof dense);
        std::memcpy(&smooth, &surface[mesh.surfaceVertices[v] * surfaceStride], sizeof smooth);
        largest = std::max(largest, static_cast<double>(glm::distance(dense, smooth)));
        low = glm::min(low, smooth);
        high = glm::max(high, smooth);
    }
    return largest / static_cast<double>(glm::distance(low, high));
}

} // namespace

bool hasClassicalPath(const BenchCage& cage) {
    const cage::Cage& mesh = cage.character.cage;
    bool quads = mesh.holes.empty() && !cage.character.clips.empty() && !cage.schemes.empty();
    for (uint32_t face = 0; quads && face < mesh.faceCount(); ++face) {
        quads = mesh.sides(face) == 4;
    }
    return quads;
}

Result<Json> measureClassical(host::Device& device, Workbench& workbench, const ClassicalDesc& desc) {
    Json rows = Json::array();
    for (const uint32_t rate : desc.rates) {
        if (desc.progress) {
            desc.progress(desc.cage->name + ", rate " + std::to_string(rate));
        }
        Race race(device, workbench, desc, rate);
        const Status status = race.load();
        Result<Json> row = status ? race.run() : Result<Json>(status.error());
        if (!row && row.error().code == ErrorCode::limit) {
            desc.leaveOut(desc.cage->name + " as a dense mesh, rate " + std::to_string(rate), row.error().message);
            continue;
        }
        if (!row) {
            return row.error();
        }
        rows.push_back(std::move(*row));
    }
    return rows;
}

Result<std::vector<Agreement>> compareClassical(host::Device& device, Workbench& workbench, const BenchCage& cage) {
    constexpr uint32_t kRate = 4;
    std::vector<Agreement> result;
    for (const bool posed : {false, true}) {
        cage::Character character = cage.character;
        if (!posed) {
            character.clips.clear(); // stands as its nodes say
        }
        Result<DenseMesh> dense = makeDenseMesh(device, workbench, character, kSurface, kRate);
        if (!dense) {
            return dense.error();
        }
        const Result<SuppleAsset> cageAsset = workbench.createAsset(std::move(character));
        const Result<SuppleAsset> denseAsset = workbench.createAsset(dense->character);
        if (!cageAsset || !denseAsset) {
            return cageAsset ? denseAsset.error() : cageAsset.error();
        }
        PlayingGroup surface(device, workbench), mesh(device, workbench);
        Status status = surface.create(groupOf({"", *cageAsset, kSurface, 0, 0, nullptr}, kRate, 2));
        if (status) {
            status = mesh.create(groupOf({"", *denseAsset, SUPPLE_SCHEME_POLYGONS, 0, 0, nullptr}, kRate, 2));
        }
        workbench.destroy(*cageAsset);
        workbench.destroy(*denseAsset);
        if (!status) {
            return status.error();
        }
        const Result<std::vector<std::byte>> smooth = surface.verticesOf(1), vertices = mesh.deformedCageOf(1);
        if (!smooth || !vertices) {
            return smooth ? vertices.error() : smooth.error();
        }
        const size_t stride = surface.output().streams.vertices.stride;
        result.push_back({cage.name + ": dense mesh against its surface, " + (posed ? "in a clip" : "at rest"),
                          distance(*dense, *vertices, *smooth, stride), posed ? kPosedBound : kBindBound});
    }
    return result;
}

} // namespace supple::bench
