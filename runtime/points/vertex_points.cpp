#include "runtime/points/vertex_points.h"

#include "runtime/cpu_group.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace supple::runtime {
namespace {

/// Parameters that differ by less are the same: handles are floats, and places sums of theirs.
constexpr double kSameParameter = 1e-6;

/// A point in the piece of a surface that has it.
struct PlacedPoint {
    uint32_t point = 0;
    cpu::Place place;
};
using PlacedPoints = std::unordered_map<uint32_t, std::vector<PlacedPoint>>; ///< by piece

/// Where sectors of a pentagon meet, samples are those of the sector behind, and the middle that of the first.
cpu::Place uniquePlace(surface::Domain domain, cpu::Place place) {
    if (domain == surface::Domain::pentagon && place.x + place.y >= 1.0 - kSameParameter) {
        const bool isMiddle = place.y >= 1.0 - kSameParameter;
        place.sector = isMiddle ? 0 : (place.sector + 1) % 5;
        place.x = 0.0;
    }
    return place;
}

bool isSamePlace(const cpu::Place& a, const cpu::Place& b) {
    return a.sector == b.sector && std::abs(a.x - b.x) <= kSameParameter && std::abs(a.y - b.y) <= kSameParameter;
}

/// Whether some sample may lie there, of a piece that has so many segments along a side.
bool mayBeSample(const cpu::Place& place, uint32_t along) {
    const auto off = [](double x) { return std::abs(x - std::round(x)); };
    return std::max(off(place.x * along), off(place.y * along)) <= kSameParameter * along;
}

class VertexFinder {
public:
    VertexFinder(const CpuGroup::Part& part, const Tessellation& surface) : part_(part), surface_(surface) {}

    /// The points of a patch on its samples.
    void add(uint32_t patch, const std::vector<PlacedPoint>& points) {
        const surface::Domain domain = part_.surface->domainOf(patch);
        for (uint32_t rate = 1; rate <= SUPPLE_MAX_RATE; ++rate) {
            std::vector<uint32_t> vertices;
            for (const PlacedPoint& own : points) {
                if (!mayBeSample(own.place, rate << surface_.tables().isolationSteps)) {
                    continue;
                }
                if (vertices.empty()) {
                    vertices = surface_.verticesOf(patch, rate);
                }
                const cpu::Place place = uniquePlace(domain, own.place);
                for (uint32_t sample = 0; sample < vertices.size(); ++sample) {
                    if (isSamePlace(uniquePlace(domain, part_.surface->placeOfSample(patch, rate, sample, 0.0)),
                                    place)) {
                        byRate_[rate].push_back({own.point, vertices[sample]});
                        break;
                    }
                }
            }
        }
    }
    void finish(uint32_t surface, VertexPoints& out) {
        for (uint32_t rate = 1; rate <= SUPPLE_MAX_RATE; ++rate) {
            std::vector<std::pair<uint32_t, uint32_t>>& found = byRate_[rate];
            if (found.empty()) {
                continue;
            }
            std::sort(found.begin(), found.end());
            // On a border of patches in one piece all have the same bits.
            found.erase(std::unique(found.begin(), found.end(),
                                    [](const auto& a, const auto& b) { return a.first == b.first; }),
                        found.end());
            out.runs.push_back(
                {surface, rate, static_cast<uint32_t>(out.words.size() / 2), static_cast<uint32_t>(found.size())});
            for (const auto& [point, vertex] : found) {
                out.words.insert(out.words.end(), {point, vertex});
            }
        }
    }

private:
    const CpuGroup::Part& part_;
    const Tessellation& surface_;
    std::vector<std::pair<uint32_t, uint32_t>> byRate_[SUPPLE_MAX_RATE + 1]; ///< point and vertex
};

} // namespace

Result<VertexPoints> vertexPoints(const CpuGroup& group, const Surfaces& surfaces,
                                  std::span<const SuppleSurfacePoint> points) {
    std::vector<PlacedPoints> placed(group.parts().size());
    for (uint32_t k = 0; k < points.size(); ++k) {
        const CpuGroup::Found found = group.find(points[k]);
        placed[found.part][found.place.place.piece].push_back({k, found.place.place});
    }
    VertexPoints all;
    for (uint32_t s = 0; s < surfaces.size(); ++s) {
        if (surfaces[s].gridRate() == 0) {
            return Error{ErrorCode::argument,
                         "SUPPLE_POINT_SET_ON_VERTICES needs surface vertices at a rate: surface " + std::to_string(s) +
                             " has none"};
        }
        VertexFinder finder(group.parts()[s], surfaces[s]);
        const cpu::Surface& surface = *group.parts()[s].surface;
        for (uint32_t patch = 0; patch < surface.patches().size(); ++patch) {
            const auto own = placed[s].find(surface.placeOfSample(patch, 1, 0, 0.0).piece);
            if (own != placed[s].end()) {
                finder.add(patch, own->second);
            }
        }
        finder.finish(s, all);
    }
    return all;
}

} // namespace supple::runtime
