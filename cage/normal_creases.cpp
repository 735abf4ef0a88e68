#include "cage/normal_creases.h"

#include "cage/corner_normals.h"
#include "cage/topology.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <utility>
#include <vector>

namespace supple::cage {
namespace {

/// Makes the edges for which `isHard` holds infinitely sharp, and counts them.
template <class Test>
uint32_t creaseEdges(Cage& cage, const Topology& topology, Test isHard) {
    std::map<std::pair<uint32_t, uint32_t>, size_t> known;
    for (size_t i = 0; i < cage.creases.size(); ++i) {
        known.emplace(std::minmax(cage.creases[i].a, cage.creases[i].b), i);
    }
    uint32_t count = 0;
    for (const Topology::Edge& edge : topology.edges) {
        if (edge.twin == kNone || !isHard(edge)) {
            continue;
        }
        ++count;
        const uint32_t a = cage.faceVertices[edge.corner];
        const uint32_t b = cage.faceVertices[edge.twin];
        const auto crease = known.find(std::minmax(a, b));
        if (crease == known.end()) {
            cage.creases.push_back({a, b, kHardSharpness});
        } else {
            float& sharpness = cage.creases[crease->second].sharpness;
            sharpness = std::max(sharpness, kHardSharpness);
        }
    }
    return count;
}

/// Sums of cross products along the boundary: twice the face's area, across its mean plane.
std::vector<glm::dvec3> areaVectors(const Cage& cage) {
    std::vector<glm::dvec3> areas(cage.faceCount(), glm::dvec3(0.0));
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t first = cage.faceStarts[face];
        const auto fromFirst = [&](uint32_t corner) {
            return glm::dvec3(cage.positions[cage.faceVertices[corner]]) -
                   glm::dvec3(cage.positions[cage.faceVertices[first]]);
        };
        for (uint32_t corner = first + 1; corner + 1 < cage.faceStarts[face + 1]; ++corner) {
            areas[face] += glm::cross(fromFirst(corner), fromFirst(corner + 1));
        }
    }
    return areas;
}

} // namespace

uint32_t creaseSplitNormals(Cage& cage) {
    const Result<Topology> topology = buildTopology(cage);
    if (!topology) {
        return 0;
    }
    return creaseEdges(cage, *topology,
                       [&](const Topology::Edge& edge) { return hasSplitNormals(cage, *topology, edge); });
}

uint32_t creaseAngles(Cage& cage, double degrees) {
    const Result<Topology> topology = buildTopology(cage);
    if (!topology) {
        return 0;
    }
    const std::vector<glm::dvec3> areas = areaVectors(cage);
    return creaseEdges(cage, *topology, [&](const Topology::Edge& edge) {
        const glm::dvec3& a = areas[topology->cornerFaces[edge.corner]];
        const glm::dvec3& b = areas[topology->cornerFaces[edge.twin]];
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) > degrees * glm::pi<double>() / 180.0;
    });
}

} // namespace supple::cage
