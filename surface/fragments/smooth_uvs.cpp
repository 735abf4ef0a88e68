#include "surface/fragments/smooth_uvs.h"

#include "surface/subdivision/masks.h"
#include "surface/uv_levels.h"
#include "surface/valence.h"

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace supple::surface::fragments {

using namespace subdivision;
namespace {

using cage::kNone;

/// Where corners of faces lie in the face of the isolated mesh that they came from.
using Places = std::array<glm::ivec2, 4>;

std::vector<Places> nextPlaces(const std::vector<Places>& places, bool quads) {
    std::vector<Places> next;
    next.reserve(4 * places.size());
    for (const Places& p : places) {
        const int sides = quads ? 4 : 3;
        const auto middle = [&](int c) { return (p[c] + p[(c + 1) % sides]) / 2; };
        for (int c = 0; c < sides; ++c) {
            const glm::ivec2 before = middle((c + sides - 1) % sides);
            next.push_back(quads ? Places{p[c], middle(c), (p[0] + p[2]) / 2, before}
                                 : Places{p[c], middle(c), before, glm::ivec2(0)});
        }
        if (!quads) {
            next.push_back({middle(0), middle(1), middle(2), glm::ivec2(0)});
        }
    }
    return next;
}

/// Limits at the vertices of a level.
class LimitFinder {
public:
    LimitFinder(const ChannelLevel& level, const UvDemand& demand) : level_(level), demand_(demand) {}

    /// Takes a vertex.
    void load(uint32_t v) {
        const RefinedMesh& mesh = level_.mesh;
        const cage::Topology& topology = mesh.topology;
        base_ = topology.spokeStarts[v];
        fan_ = {demand_.subdivision, topology.sectorCount(v), topology.boundary[v] != 0};
        ring_.assign(1, level_.values[v]);
        spokes_.clear();
        bool sharp = mesh.vertexSharpness[v] > 0.0f;
        for (uint32_t k = 0; k < topology.spokeCount(v); ++k) {
            ring_.push_back(level_.values[topology.spokeVertices[base_ + k]]);
            if (demand_.subdivision == Subdivision::catmullClark && k < fan_.sectors) {
                const uint32_t corner = topology.sectorCorners[base_ + k];
                ring_.push_back(level_.values[mesh.cage.faceVertices[corner / 4 * 4 + (corner + 2) % 4]]);
            }
            const float sharpness = mesh.edgeSharpness[cage::spokeEdge(mesh.cage, topology, base_ + k)];
            spokes_.push_back(sharpness > 0.0f ? 1.0f : 0.0f); // limits ask no more
            sharp = sharp || sharpness > 0.0f;
        }
        limit_ = sharp ? sharpLimit(v) : smoothLimit();
        value_ = applied(limit_->position);
        runs_.clear();
        for (const CentreRun& run : limit_->runs) {
            runs_.push_back({applied(run.first), applied(run.second)});
        }
    }

    [[nodiscard]] uint32_t sectors() const { return fan_.sectors; }
    [[nodiscard]] uint32_t corner(uint32_t sector) const { return level_.mesh.topology.sectorCorners[base_ + sector]; }
    /// The limit, with the slopes along the two edges of a sector, towards its corner's next and last.
    [[nodiscard]] UvSample at(uint32_t sector) const {
        UvSample sample;
        sample.value = value_;
        slopes(sector, sample);
        return sample;
    }

private:
    using Key = std::tuple<uint32_t, bool, std::vector<float>, float>;
    struct Slopes {
        glm::dvec2 first, second;
    };

    const CentreLimit* smoothLimit() {
        const auto [known, isNew] = smooth_.try_emplace(fan_.sectors);
        if (isNew) {
            known->second = centreLimit(fan_, spokes_, 0.0f);
        }
        return &known->second;
    }

    const CentreLimit* sharpLimit(uint32_t v) {
        float sharp = level_.mesh.vertexSharpness[v];
        if (v < level_.companions.size() && level_.companions[v] != kNone) {
            const uint32_t other = level_.companions[v];
            const std::vector<float> spokes = spokeSharpness(level_.mesh, other);
            const bool corner = vertexRule(spokes, level_.mesh.vertexSharpness[other]).rule == CentreRule::corner;
            sharp = corner ? kInfiniteSharpness : sharp;
        }
        const auto [known, isNew] = sharp_.try_emplace({fan_.sectors, fan_.open, spokes_, sharp});
        if (isNew) {
            known->second = centreLimit(fan_, spokes_, sharp);
        }
        return &known->second;
    }

    [[nodiscard]] glm::dvec2 applied(const CentreMask& mask) const {
        glm::dvec2 sum(0.0);
        for (size_t i = 0; i < mask.size(); ++i) {
            sum += mask[i] * ring_[i];
        }
        return sum;
    }

    /// The run of sectors with one tangent plane that a sector lies in.
    [[nodiscard]] size_t runOf(uint32_t sector) const {
        size_t index = 0;
        for (const CentreRun& run : limit_->runs) {
            if ((sector + fan_.sectors - run.firstSector) % fan_.sectors < run.sectors) {
                return index;
            }
            ++index;
        }
        return 0;
    }

    void slopes(uint32_t sector, UvSample& sample) const {
        const size_t index = runOf(sector);
        const CentreRun& run = limit_->runs[index];
        const bool loop = demand_.subdivision == Subdivision::loop;
        if (run.corner) {
            const uint32_t stride = loop ? 1 : 2, spokes = fan_.sectors + (fan_.open ? 1 : 0);
            sample.u = ring_[1 + stride * sector] - ring_[0];
            sample.v = ring_[1 + stride * ((sector + 1) % spokes)] - ring_[0];
            return;
        }
        const bool smooth = limit_->runs.size() == 1 && !fan_.open;
        const uint32_t j = (sector + fan_.sectors - run.firstSector) % fan_.sectors;
        // Per step of the grid: at regular vertices that is what they are, elsewhere a common factor of both.
        const double scale = loop ? 1.0 / 3.0 : 1.0 / 12.0, across = loop ? 0.5 / std::sqrt(3.0) : 1.0 / 6.0;
        const glm::dvec2 first = runs_[index].first * (smooth ? scale : 0.5);
        const glm::dvec2 second = runs_[index].second * (smooth ? scale : across);
        const auto along = [&](uint32_t k) {
            const auto [cosine, sine] = turn(k, smooth ? fan_.sectors : 2 * run.sectors);
            return cosine * first + sine * second;
        };
        sample.u = along(j);
        sample.v = along(j + 1);
    }

    const ChannelLevel& level_;
    const UvDemand& demand_;
    std::map<uint32_t, CentreLimit> smooth_; ///< closed fans, by sectors
    std::map<Key, CentreLimit> sharp_;
    // The vertex at work:
    uint32_t base_ = 0;
    Fan fan_;
    std::vector<float> spokes_;
    std::vector<glm::dvec2> ring_; ///< the vertex, then ring 1 in spiral order
    const CentreLimit* limit_ = nullptr;
    glm::dvec2 value_{0.0};
    std::vector<Slopes> runs_;
};

/// Slopes along the grid, from those along the edges of a face that runs from `corner` to `next` and to `last`.
void turnSlopes(UvSample& sample, const glm::ivec2& corner, const glm::ivec2& next, const glm::ivec2& last) {
    const glm::dvec2 a(next - corner), b(last - corner);
    const double det = a.x * b.y - a.y * b.x;
    const glm::dvec2 along = sample.u, across = sample.v;
    sample.u = (b.y * along - a.y * across) / det;
    sample.v = (a.x * across - b.x * along) / det;
}

} // namespace

Result<std::vector<UvSample>> limitUvs(const RefinedMesh& cage, const std::vector<glm::vec2>& uvs,
                                       const UvDemand& demand) {
    Result<cage::UvChannel> channel = cage::buildUvChannel(
        cage.cage, cage.topology, {cage.edgeSharpness, cage.vertexSharpness}, uvs, demand.mode, demand.folds);
    if (!channel) {
        return channel.error();
    }
    ChannelLevel level = firstChannelLevel(cage, std::move(*channel));
    const bool quads = demand.subdivision == Subdivision::catmullClark;
    const int side = 1 << demand.steps;
    std::vector<Places> places;
    for (uint32_t i = 0; i < demand.isolationSteps + demand.steps; ++i) {
        if (const Status done = refineChannel(level, demand.subdivision, demand.mode); !done) {
            return done.error();
        }
        if (i + 1 == demand.isolationSteps) {
            const Places whole = quads ? Places{{{0, 0}, {side, 0}, {side, side}, {0, side}}}
                                       : Places{{{0, 0}, {side, 0}, {0, side}, {0, 0}}};
            places.assign(level.mesh.cage.faceCount(), whole);
        } else if (i >= demand.isolationSteps) {
            places = nextPlaces(places, quads);
        }
    }
    const uint32_t samples = quads ? (side + 1) * (side + 1) : (side + 1) * (side + 2) / 2;
    const uint32_t sides = quads ? 4 : 3;
    const auto perFace = static_cast<uint32_t>(1) << (2 * demand.steps); // of the isolated mesh
    std::vector<UvSample> result(size_t{samples} * (places.size() / perFace));
    LimitFinder finder(level, demand);
    for (uint32_t v = 0; v < level.mesh.cage.vertexCount(); ++v) {
        finder.load(v);
        for (uint32_t sector = 0; sector < finder.sectors(); ++sector) {
            const uint32_t corner = finder.corner(sector), f = corner / sides, c = corner % sides;
            const glm::ivec2 at = places[f][c];
            UvSample sample = finder.at(sector);
            turnSlopes(sample, at, places[f][(c + 1) % sides], places[f][(c + sides - 1) % sides]);
            const int before = quads ? at.y * (side + 1) : at.y * (side + 1) - at.y * (at.y - 1) / 2;
            result[size_t{samples} * (f / perFace) + static_cast<uint32_t>(before + at.x)] = sample;
        }
    }
    return result;
}

} // namespace supple::surface::fragments
