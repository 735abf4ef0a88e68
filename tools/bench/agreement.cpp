#include "tools/bench/agreement.h"

#include "host/camera.h"
#include "tools/bench/avx2_evaluation.h"
#include "tools/bench/plain_evaluation.h"
#include "tools/common/schemes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

namespace supple::bench {

namespace {

/// A power of two, at which Catmull-Clark's samples lie where OpenSubdiv's grid has its own.
constexpr uint32_t kAgreedRate = 8;
constexpr uint32_t kSide = kAgreedRate + 1;
constexpr double kArithmeticBound = 1e-5;
/// Unit normals of small patches, from a device that rounds as it likes.
constexpr double kDeviceBound = 1e-4;
/// OpenSubdiv ends its refinement with Gregory patches, which only come near the limit. Of the cage's extent.
constexpr double kLimitBound = 1e-3;

double largestDifference(std::span<const float> a, std::span<const float> b) {
    double largest = a.size() == b.size() ? 0.0 : INFINITY;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const double difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        largest = std::isfinite(difference) ? std::max(largest, difference) : INFINITY;
    }
    return largest;
}

/// A group of the cage after one frame, destroyed when this goes.
struct Evaluated {
    Workbench& workbench;
    SuppleGroup group;
    ~Evaluated() { workbench.destroy(group); }
};

Result<std::unique_ptr<Evaluated>> evaluated(host::Device& device, Workbench& workbench, const BenchCage& cage,
                                             SuppleScheme scheme, uint32_t flags) {
    Result<SuppleAsset> asset = workbench.createAsset(cage.character);
    if (!asset) {
        return asset.error();
    }
    SuppleGroupDesc desc{};
    desc.asset = *asset;
    desc.scheme = scheme;
    desc.rate = kAgreedRate;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    desc.flags = flags;
    Result<SuppleGroup> group = workbench.createGroup(desc);
    workbench.destroy(*asset);
    if (!group) {
        return group.error();
    }
    std::unique_ptr<Evaluated> result(new Evaluated{workbench, *group});
    Status recorded = success();
    const Status submitted =
        device.submitAndWait([&](VkCommandBuffer commands) { recorded = workbench.recordFrame(*group, commands); });
    if (!recorded || !submitted) {
        return recorded ? submitted.error() : recorded.error();
    }
    return result;
}

Result<std::vector<float>> readFloats(host::Device& device, const SuppleBufferRange& view) {
    Result<std::vector<std::byte>> bytes = device.readBuffer(view);
    if (!bytes) {
        return bytes.error();
    }
    std::vector<float> floats(bytes->size() / sizeof(float));
    std::memcpy(floats.data(), bytes->data(), floats.size() * sizeof(float));
    return floats;
}

double nearest(const glm::vec3& from, std::span<const glm::vec3> points) {
    double best = INFINITY;
    for (const glm::vec3& point : points) {
        best = std::min(best, static_cast<double>(glm::distance(from, point)));
    }
    return best;
}

using PointsByFace = std::vector<std::vector<glm::vec3>>;

Result<PointsByFace> pointsByFace(host::Device& device, Workbench& workbench, const BenchCage& cage,
                                  SuppleScheme scheme) {
    Result<std::unique_ptr<Evaluated>> frame = evaluated(device, workbench, cage, scheme, 0);
    if (!frame) {
        return frame.error();
    }
    const SuppleGroup group = (*frame)->group;
    const host::GroupOutput& output = workbench.output(group);
    const Result<std::vector<float>> surface = readFloats(device, output.streams.vertices);
    if (!surface) {
        return surface.error();
    }
    const std::vector<uint32_t> faces = workbench.patchFaces(group);
    PointsByFace points(cage.character.cage.faceCount());
    for (uint32_t r = 0; r < output.grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = output.grid.drawRanges[r];
        for (uint32_t p = 0; p < range.patchCount; ++p) {
            for (uint32_t s = 0; s < range.samplesPerPatch; ++s) {
                const float* v = &(*surface)[size_t{6} * (range.firstVertex + p * range.samplesPerPatch + s)];
                points[faces[range.firstPatch + p]].emplace_back(v[0], v[1], v[2]);
            }
        }
    }
    return points;
}

/// Orders differ, the places are the same: every sample of a face has one of the other's near it, both ways.
double largestGap(const PointsByFace& a, const PointsByFace& b) {
    double largest = 0.0;
    for (size_t f = 0; f < a.size(); ++f) {
        for (const glm::vec3& p : a[f]) {
            largest = std::max(largest, nearest(p, b[f]));
        }
        for (const glm::vec3& p : b[f]) {
            largest = std::max(largest, nearest(p, a[f]));
        }
    }
    return largest;
}

} // namespace

Result<std::vector<float>> bicubicCoefficients(host::Device& device, Workbench& workbench, const BenchCage& quads) {
    Result<std::unique_ptr<Evaluated>> frame =
        evaluated(device, workbench, quads, SUPPLE_SCHEME_PREP, SUPPLE_GROUP_PATCHES);
    if (!frame) {
        return frame.error();
    }
    const host::GroupOutput& output = workbench.output((*frame)->group);
    Result<std::vector<float>> all = readFloats(device, output.surface.patchCoefficients);
    if (!all) {
        return all.error();
    }
    std::vector<float> bicubic;
    for (uint32_t p = 0; p < output.surface.patchCount; ++p) {
        const auto first = all->begin() + ptrdiff_t{4} * SUPPLE_PATCH_STRIDE * p;
        bicubic.insert(bicubic.end(), first, first + 64);
    }
    return bicubic;
}

Result<std::vector<Agreement>> compareEvaluations(host::Device& device, Workbench& workbench, const BenchCage& sphere,
                                                  std::span<const float> coefficients) {
    std::vector<Agreement> result;
    const size_t patches = coefficients.size() / 64;
    std::vector<float> plain(patches * kSide * kSide * 6);
    evaluatePlain(coefficients, kAgreedRate, plain);
    if (hasAvx2Evaluation()) {
        BicubicWeights weights;
        fillBicubicWeights(weights, kAgreedRate);
        std::vector<float> avx2(plain.size());
        evaluateAvx2(coefficients.data(), patches, kAgreedRate, weights, avx2.data());
        result.push_back({"AVX2 against plain C++", largestDifference(avx2, plain), kArithmeticBound});
    }
    Result<std::unique_ptr<Evaluated>> frame = evaluated(device, workbench, sphere, SUPPLE_SCHEME_PREP, 0);
    if (!frame) {
        return frame.error();
    }
    const SuppleGroup group = (*frame)->group;
    const Result<std::vector<float>> surface = readFloats(device, workbench.output(group).streams.vertices);
    if (!surface) {
        return surface.error();
    }
    const size_t regular = size_t{6} * kSide * kSide * workbench.regularPatches(group);
    result.push_back({"device's p-rep, regular patches, against plain C++",
                      largestDifference(std::span(*surface).first(regular), std::span(plain).first(regular)),
                      kDeviceBound});
    return result;
}

Result<std::vector<Agreement>> comparePeers(host::Device& device, Workbench& workbench, const OpensubdivPeers& peers,
                                            const BenchCage& cage, PeerRules rules) {
    std::vector<Agreement> result;
    const Result<std::vector<Peer>> all = peers.make(cage.character.cage, rules, kAgreedRate);
    if (!all) { // what OpenSubdiv refuses is named in the rows
        const bool refused = all.error().code == ErrorCode::asset || all.error().code == ErrorCode::limit;
        return refused ? Result<std::vector<Agreement>>(std::move(result)) : all.error();
    }
    const double extent = 2.0 * host::boundsOf(cage.character.cage.positions).radius();
    std::vector<float> reference;
    for (const Peer& peer : *all) {
        const Status status = peer.run();
        if (!status) {
            return status.error();
        }
        const std::vector<float> positions = peer.positions();
        if (reference.empty()) {
            reference = positions;
        } else {
            result.push_back({cage.name + ": " + peer.name + " against " + all->front().name,
                              largestDifference(positions, reference) / extent, kArithmeticBound});
        }
    }
    if (reference.empty()) {
        return result;
    }
    std::vector<std::vector<glm::vec3>> theirs(cage.character.cage.faceCount());
    for (size_t i = 0; i < all->front().points; ++i) {
        theirs[(*all->front().faces)[i]].emplace_back(reference[3 * i], reference[3 * i + 1], reference[3 * i + 2]);
    }
    const SuppleScheme scheme = rules == PeerRules::loop ? SUPPLE_SCHEME_LOOP : SUPPLE_SCHEME_FRAGMENTS;
    const Result<PointsByFace> ours = pointsByFace(device, workbench, cage, scheme);
    if (!ours) {
        return ours.error();
    }
    result.push_back({cage.name + ": device's " + tools::schemeName(scheme) + " against " + all->front().name,
                      largestGap(*ours, theirs) / extent, kLimitBound});
    return result;
}

} // namespace supple::bench
