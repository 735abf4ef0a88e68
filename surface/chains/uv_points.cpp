#include "surface/chains/uv_points.h"

#include "shaders/shared/chains.h"
#include "surface/chains/uv_chain.h"

#include <algorithm>
#include <bit>
#include <string>

namespace supple::surface::chains {
namespace {

using cage::kNone;
using subdivision::Fan;

/// A vertex sharpness that is a corner in every step to the part that the other vertex is.
float cornerSharpness(const RefinedMesh& mesh, uint32_t other) {
    const std::vector<float> spokes = spokeSharpness(mesh, other);
    constexpr uint32_t kMostSteps = 64;
    for (uint32_t step = 0; step < kMostSteps; ++step) {
        const double share = centreStep(softened(spokes, step), softened(mesh.vertexSharpness[other], step)).corner;
        if (share < 1.0) {
            return static_cast<float>(step + share);
        }
    }
    return kInfiniteSharpness;
}

void putPair(const glm::dvec2& value, TableWriter& writer) {
    const glm::vec2 rounded(value);
    writer.put({std::bit_cast<uint32_t>(rounded.x + 0.0f), std::bit_cast<uint32_t>(rounded.y + 0.0f)});
}

subdivision::Isolation isolated(ChannelLevel& level, Subdivision subdivision) {
    return subdivision::isolateLevel(std::move(level.mesh), subdivision);
}

} // namespace

Result<ChannelLevel> channelOf(const RefinedMesh& cage, const std::vector<glm::vec2>& uvs, Subdivision subdivision,
                               cage::UvMode mode, bool steps) {
    Result<cage::UvChannel> channel =
        cage::buildUvChannel(cage.cage, cage.topology, {cage.edgeSharpness, cage.vertexSharpness}, uvs, mode);
    if (!channel) {
        return channel.error();
    }
    ChannelLevel level = firstChannelLevel(cage, std::move(*channel));
    std::vector<float> corners(level.companions.size(), 0.0f);
    for (uint32_t v = 0; v < level.companions.size(); ++v) {
        if (level.companions[v] != kNone) {
            corners[v] = cornerSharpness(level.mesh, level.companions[v]);
        }
    }
    for (uint32_t v = 0; v < corners.size(); ++v) {
        level.mesh.vertexSharpness[v] = std::max(level.mesh.vertexSharpness[v], corners[v]);
    }
    level.companions.clear();
    if (steps) {
        if (const Status done = refineChannel(level, subdivision, mode); !done) {
            return done.error();
        }
    }
    return level;
}

UvPoints::UvPoints(Subdivision subdivision, ChannelLevel level, uint32_t lastLevel)
    : subdivision_(subdivision), isolation_(isolated(level, subdivision)),
      points_(refinedValues(isolation_.mesh.stencils.back(), level.values)),
      levelOne_(static_cast<uint32_t>(points_.size())), lastLevel_(lastLevel) {}

Fan UvPoints::fanOf(uint32_t vertex) const {
    const subdivision::Fragment& fragment = isolation_.mesh.fragments[vertex];
    return {subdivision_, fragment.sectors, fragment.open};
}

Arrangement UvPoints::arrangementOf(uint32_t vertex) const {
    const subdivision::Fragment& fragment = isolation_.mesh.fragments[vertex];
    const auto spokes = isolation_.mesh.spokeSharpness.begin() + fragment.firstSpoke;
    return {fanOf(vertex), {spokes, spokes + fragment.spokes()}, fragment.centreSharpness};
}

uint32_t UvPoints::netPoint(uint32_t vertex, uint32_t i) const {
    return isolation_.mesh.net[isolation_.mesh.fragments[vertex].firstNet + i];
}

glm::dvec2 UvPoints::limitAt(uint32_t vertex) {
    const Arrangement key = arrangementOf(vertex);
    const auto [known, isNew] = limits_.try_emplace(key);
    if (isNew) {
        known->second = limitOf(key).position;
    }
    const glm::dvec2 centre = points_[netPoint(vertex, 0)];
    glm::dvec2 limit = centre;
    for (uint32_t i = 1; i < known->second.size(); ++i) {
        limit += known->second[i] * (points_[netPoint(vertex, i)] - centre);
    }
    return limit;
}

void UvPoints::writeChain(uint32_t vertex, TableWriter& writer) const {
    const Fan fan = fanOf(vertex);
    const Arrangement arrangement = arrangementOf(vertex);
    const glm::dvec2 origin = points_[netPoint(vertex, 0)];
    Points level;
    for (uint32_t i = 0; i < pointCount(fan, 2); ++i) {
        level.push_back(points_[netPoint(vertex, i)] - origin);
    }
    putPair(origin, writer);
    for (uint32_t j = kFirstChainLevel; j <= lastLevel_; ++j) {
        level = nextChainLevel(fan, level, softened(arrangement.spokes, j - kFirstChainLevel),
                               softened(arrangement.vertex, j - kFirstChainLevel));
        for (const glm::dvec2& point : level) {
            putPair(point, writer);
        }
    }
}

void UvPoints::write(TableWriter& writer) {
    const uint32_t vertices = isolation_.parent.cage.vertexCount();
    firstLimit_ = 2 * writer.element();
    for (uint32_t v = 0; v < vertices; ++v) {
        putPair(limitAt(v), writer);
    }
    firstPoint_ = firstLimit_ + vertices;
    for (const uint32_t point : levelOne_.rows()) {
        putPair(points_[point], writer);
    }
    uint32_t next = firstPoint_ + levelOne_.count();
    chains_.assign(vertices, 0);
    for (uint32_t v = 0; v < vertices; ++v) {
        if (hasChain_[v] != 0) {
            writeChain(v, writer);
            chains_[v] = next + 1; // behind the point that it is relative to
            next += 1 + (lastLevel_ - kFirstChainLevel + 1) * pointCount(fanOf(v), 3);
        }
    }
    (void)writer.element();
}

Status UvPoints::checkSize() const {
    constexpr uint64_t kNames = uint64_t{1} << (32 - shared::kNetFirstShift);
    if (uint64_t{firstPoint_} + levelOne_.count() > kNames) {
        return Error{ErrorCode::limit, "smooth texture coordinates have points beyond number " +
                                           std::to_string(kNames) + ": more than records of patches can name"};
    }
    return success();
}

void UvPoints::addFans(FanTables& fans) const {
    for (uint32_t v = 0; v < isolation_.parent.cage.vertexCount(); ++v) {
        if (hasChain_[v] != 0) {
            (void)fans.of(fanOf(v));
        }
    }
}

UvPoints::Corner UvPoints::cornerOf(uint32_t corner, FanTables& fans) const {
    const cage::Topology& topology = mesh().topology;
    const uint32_t v = mesh().cage.faceVertices[corner];
    if (hasChain_[v] == 0) {
        return {};
    }
    const Fan fan = fanOf(v);
    const uint32_t sector = topology.cornerSpokes[corner] - topology.spokeStarts[v];
    return {chains_[v], fans.of(fan).netLists + FanTables::netListElements(subdivision_) * sector};
}

} // namespace supple::surface::chains
