#include "surface/exact/smooth_uvs.h"

#include <algorithm>
#include <array>
#include <bit>

namespace supple::surface::exact {
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

/// A step of a chain: points up to radius 3, of those up to radius 2 on the level before. As shaders/exact/chain.comp.
class ChainStep {
public:
    ChainStep(const Fan& fan, const std::vector<glm::dvec2>& before) : fan_(fan), before_(before) {}

    std::vector<glm::dvec2> run(const std::vector<float>& spokes, float vertex) {
        next_.assign(pointCount(fan_, 3), glm::dvec2(0.0));
        for (uint32_t h = 0; h < spokes.size(); ++h) {
            makeSector(h, spokes[h]);
        }
        next_[0] = centre(centreStep(spokes, vertex));
        return std::move(next_);
    }

private:
    using Row = std::array<glm::dvec2, 3>;

    [[nodiscard]] glm::dvec2 at(uint32_t h, int32_t a, int32_t b) const {
        const uint32_t index = pointIndex(fan_, h % fan_.sectors, a, b);
        return index == subdivision::kNoPoint ? glm::dvec2(0.0) : before_[index]; // the spoke there is sharp
    }
    [[nodiscard]] static Row halved(const Row& p) {
        return {(p[0] + p[1]) * 0.5, (p[0] + p[2] + 6.0 * p[1]) * 0.125, (p[1] + p[2]) * 0.5};
    }

    void makeSector(uint32_t h, float sharpness) {
        const bool beyond = h == fan_.sectors; // the last spoke of an open fan: from the sector before
        std::array<Row, 4> rows;               // by j of -1..2
        for (int32_t j = 0; j < 4; ++j) {
            Row p{};
            for (int32_t i = 0; i < 3; ++i) {
                // The last spoke is sharp, so only its own points count.
                p[static_cast<size_t>(i)] = !beyond ? at(h, i, j - 1) : j == 1 ? at(h - 1, 0, i) : glm::dvec2(0.0);
            }
            rows[static_cast<size_t>(j)] = halved(p);
        }
        const double crease = std::min(static_cast<double>(sharpness), 1.0);
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec2 smooth = (rows[0][i] + rows[2][i] + 6.0 * rows[1][i]) * 0.125;
            const auto far = static_cast<int32_t>(i) + 1;
            if (beyond) {
                next_[pointIndex(fan_, h - 1, 0, far)] = rows[1][i];
                continue;
            }
            next_[pointIndex(fan_, h, far, 0)] = smooth + crease * (rows[1][i] - smooth);
            const Row inside = halved({rows[1][i], rows[2][i], rows[3][i]});
            for (int32_t j = 0; j < 3; ++j) {
                next_[pointIndex(fan_, h, far, j + 1)] = inside[static_cast<size_t>(j)];
            }
        }
    }

    [[nodiscard]] glm::dvec2 centre(const CentreStep& step) const {
        const CentreWeights weights = refineWeights(Subdivision::catmullClark, fan_.sectors);
        const glm::dvec2 c = before_[0];
        glm::dvec2 spokes(0.0), faces(0.0);
        for (uint32_t h = 0; h < fan_.sectors; ++h) {
            spokes += before_[1 + 2 * h] - c;
            faces += before_[2 + 2 * h] - c;
        }
        const glm::dvec2 ends = (before_[1 + 2 * step.first] - c) + (before_[1 + 2 * step.second] - c);
        return c +
               (step.smooth > 0.0 ? step.smooth * (weights.spoke * spokes + weights.face * faces) : glm::dvec2(0.0)) +
               (step.crease > 0.0 ? step.crease * 0.125 * ends : glm::dvec2(0.0));
    }

    const Fan& fan_;
    const std::vector<glm::dvec2>& before_;
    std::vector<glm::dvec2> next_;
};

subdivision::Isolation isolated(ChannelLevel& level) {
    return subdivision::isolateLevel(std::move(level.mesh), Subdivision::catmullClark);
}

} // namespace

Result<ChannelLevel> channelOfQuads(const RefinedMesh& cage, const std::vector<glm::vec2>& uvs, cage::UvMode mode,
                                    bool steps) {
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
        if (const Status done = refineChannel(level, Subdivision::catmullClark, mode); !done) {
            return done.error();
        }
    }
    return level;
}

UvQuads::UvQuads(ChannelLevel level, uint32_t lastLevel)
    : isolation_(isolated(level)), points_(refinedValues(isolation_.mesh.stencils.back(), level.values)),
      corners_(isolation_.parent), steps_(isolation_.parent), lastLevel_(lastLevel) {}

Fan UvQuads::fanOf(uint32_t vertex) const {
    const subdivision::Fragment& fragment = isolation_.mesh.fragments[vertex];
    return {Subdivision::catmullClark, fragment.sectors, fragment.open};
}

Arrangement UvQuads::arrangementOf(uint32_t vertex) const {
    const subdivision::Fragment& fragment = isolation_.mesh.fragments[vertex];
    const auto spokes = isolation_.mesh.spokeSharpness.begin() + fragment.firstSpoke;
    return {fanOf(vertex), {spokes, spokes + fragment.spokes()}, fragment.centreSharpness};
}

uint32_t UvQuads::netPoint(uint32_t vertex, uint32_t i) const {
    return isolation_.mesh.net[isolation_.mesh.fragments[vertex].firstNet + i];
}

glm::dvec2 UvQuads::limitAt(uint32_t vertex) {
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

void UvQuads::writeChain(uint32_t vertex, TableWriter& writer) const {
    const Fan fan = fanOf(vertex);
    const Arrangement arrangement = arrangementOf(vertex);
    const glm::dvec2 origin = points_[netPoint(vertex, 0)];
    Points level;
    for (uint32_t i = 0; i < pointCount(fan, 2); ++i) {
        level.push_back(points_[netPoint(vertex, i)] - origin);
    }
    putPair(origin, writer);
    for (uint32_t j = kFirstChainLevel; j <= lastLevel_; ++j) {
        level = ChainStep(fan, level)
                    .run(softened(arrangement.spokes, j - kFirstChainLevel),
                         softened(arrangement.vertex, j - kFirstChainLevel));
        for (const glm::dvec2& point : level) {
            putPair(point, writer);
        }
    }
}

void UvQuads::writePoints(TableWriter& writer) {
    const uint32_t vertices = isolation_.parent.cage.vertexCount();
    firstLimit_ = 2 * writer.element();
    for (uint32_t v = 0; v < vertices; ++v) {
        putPair(limitAt(v), writer);
    }
    firstPoint_ = firstLimit_ + vertices;
    for (const glm::dvec2& point : points_) {
        putPair(point, writer);
    }
    uint32_t next = firstPoint_ + static_cast<uint32_t>(points_.size());
    chains_.assign(vertices, 0);
    for (uint32_t v = 0; v < vertices; ++v) {
        if (hasChain(v)) {
            writeChain(v, writer);
            chains_[v] = next + 1; // behind the point that it is relative to
            next += 1 + (lastLevel_ - kFirstChainLevel + 1) * pointCount(fanOf(v), 3);
        }
    }
    (void)writer.element();
}

void UvQuads::addFans(FanTables& fans) const {
    for (uint32_t v = 0; v < isolation_.parent.cage.vertexCount(); ++v) {
        if (hasChain(v)) {
            (void)fans.of(fanOf(v));
        }
    }
}

void UvQuads::writePatch(const DraftPatch& patch, FanTables& fans, TableWriter& writer) const {
    const cage::Topology& topology = isolation_.parent.topology;
    const cage::Cage& cage = isolation_.parent.cage;
    std::array<uint32_t, 4> limits{}, chains{}, windows{}, sizes{}, sharpness{}, normals{};
    normals.fill(shared::kNoNormal);
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t c = patch.cageCorners[i], v = cage.faceVertices[c];
        limits[i] = firstLimit_ + v;
        sharpness[i] = std::bit_cast<uint32_t>(softened(isolation_.parent.edgeSharpness[topology.cornerEdges[c]], 1));
        if (hasChain(v)) {
            const uint32_t sector = topology.cornerSpokes[c] - topology.spokeStarts[v];
            chains[i] = chains_[v];
            windows[i] = fans.of(fanOf(v)).windows + shared::kWindowElements * sector;
            sizes[i] = pointCount(fanOf(v), 3) | lastLevel_ << shared::kChainLevelShift;
        }
    }
    for (const auto& words : {limits, chains, windows, sizes, sharpness, normals}) {
        writer.put(words);
    }
    writer.put({0u}); // every side is two halves
    for (const uint32_t point : corners_.netOf(patch.facet, patch.cageCorners[0] % 4, steps_)) {
        writer.put({firstPoint_ + point});
    }
    (void)writer.element();
}

} // namespace supple::surface::exact
