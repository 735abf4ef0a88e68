#include "cage/ngon_fans.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace supple::cage {
namespace {

/// Corners of a polygon that are tried as the start of its fan: enough for any polygon that is drawn by hand, and a
/// bound on the quadratic search.
constexpr size_t kMaxStarts = 64;

/// A folded triangle outweighs any number of fans that begin elsewhere than their polygon.
constexpr uint64_t kFoldCost = uint64_t{1} << 32;

uint64_t fanCost(std::span<const uint32_t> face, std::span<const glm::vec3> positions, const glm::dvec3& normal,
                 size_t start) {
    const auto corner = [&](size_t k) { return glm::dvec3(positions[face[(start + k) % face.size()]]); };
    uint64_t cost = start == 0 ? 0 : 1;
    const glm::dvec3 origin = corner(0);
    glm::dvec3 spoke = corner(1) - origin;
    for (size_t k = 2; k < face.size(); ++k) {
        const glm::dvec3 next = corner(k) - origin;
        cost += glm::dot(glm::cross(spoke, next), normal) < 0.0 ? kFoldCost : 0;
        spoke = next;
    }
    return cost;
}

/// Twice the area vector.
glm::dvec3 newellNormal(std::span<const uint32_t> face, std::span<const glm::vec3> positions) {
    const glm::dvec3 origin(positions[face[0]]);
    glm::dvec3 normal(0.0);
    for (size_t k = 1; k + 1 < face.size(); ++k) {
        normal += glm::cross(glm::dvec3(positions[face[k]]) - origin, glm::dvec3(positions[face[k + 1]]) - origin);
    }
    return normal;
}

/// What the faces up to one cost when its fan begins at `vertex`, its corner `start`.
struct Best {
    uint64_t cost = std::numeric_limits<uint64_t>::max();
    uint32_t vertex = 0;
    uint8_t start = 0;
};

} // namespace

std::vector<uint32_t> encodeNgons(const Polygons& polygons, std::span<const glm::vec3> positions) {
    const auto faceOf = [&](size_t f) {
        return std::span(polygons.vertices).subspan(polygons.starts[f], polygons.starts[f + 1] - polygons.starts[f]);
    };
    // The cheapest choice of starts, face by face. The vertices of a face differ, so of the face before it never needs
    // more than the best two: one of them begins elsewhere.
    std::vector<uint8_t> before; // per face and start: the start of the face before it
    std::vector<size_t> offsets;
    Best best[2];
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        const auto face = faceOf(f);
        const glm::dvec3 normal = newellNormal(face, positions);
        Best next[2];
        offsets.push_back(before.size());
        for (size_t start = 0; start < std::min(face.size(), kMaxStarts); ++start) {
            Best own{fanCost(face, positions, normal, start), face[start], static_cast<uint8_t>(start)};
            if (f > 0) {
                const Best& from = best[best[0].vertex == face[start] ? 1 : 0];
                own.cost += from.cost;
                before.push_back(from.start);
            } else {
                before.push_back(0);
            }
            if (own.cost < next[0].cost) {
                next[1] = next[0];
                next[0] = own;
            } else if (own.cost < next[1].cost) {
                next[1] = own;
            }
        }
        std::copy(std::begin(next), std::end(next), std::begin(best));
    }

    std::vector<uint8_t> starts(polygons.faceCount());
    uint8_t start = best[0].start;
    for (size_t f = polygons.faceCount(); f-- > 0;) {
        starts[f] = start;
        start = before[offsets[f] + start];
    }
    std::vector<uint32_t> triangles;
    triangles.reserve(3 * (polygons.vertices.size() - 2 * polygons.faceCount()));
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        const auto face = faceOf(f);
        for (size_t k = 1; k + 1 < face.size(); ++k) {
            for (const size_t corner : {size_t{0}, k, k + 1}) {
                triangles.push_back(face[(starts[f] + corner) % face.size()]);
            }
        }
    }
    return triangles;
}

} // namespace supple::cage
