#include "cage/normal_creases.h"

#include "cage/corner_normals.h"
#include "cage/message.h"
#include "cage/parts.h"
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

std::vector<glm::dvec3> unitNormals(std::vector<glm::dvec3> areas) {
    for (glm::dvec3& area : areas) {
        const double length = glm::length(area);
        area = length > 0.0 ? area / length : glm::dvec3(0.0);
    }
    return areas;
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

std::vector<EdgeCounts> countHardEdges(const Cage& cage, const Topology& topology,
                                       const std::vector<uint32_t>& groups) {
    std::vector<EdgeCounts> counts(groups.size());
    if (cage.cornerNormals.empty()) {
        return counts;
    }
    const std::vector<glm::dvec3> normals = unitNormals(areaVectors(cage));
    for (const Topology::Edge& edge : topology.edges) {
        if (edge.twin == kNone) {
            continue;
        }
        const uint32_t face = topology.cornerFaces[edge.corner], other = topology.cornerFaces[edge.twin];
        if (!normalsAgree(glm::vec3(normals[face]), glm::vec3(normals[other]))) {
            EdgeCounts& own = counts[groups[cage.faceParts.empty() ? 0 : cage.faceParts[face]]];
            ++own.bent;
            own.hard += hasSplitNormals(cage, topology, edge) ? 1 : 0;
        }
    }
    return counts;
}

void creasePartlySplitNormals(Character& character) {
    Cage& cage = character.cage;
    const Result<Topology> topology = buildTopology(cage);
    if (!topology) {
        return;
    }
    const std::vector<uint32_t> groups = sewnTo(cage, character.parts.size());
    const std::vector<EdgeCounts> counts = countHardEdges(cage, *topology, groups);
    std::vector<uint8_t> wanted(groups.size(), 1); // by group
    for (size_t part = 0; part < groups.size(); ++part) {
        const PolygonSource source = character.parts[part].polygonSource;
        const bool plain = source == PolygonSource::triangles || source == PolygonSource::pairedTriangles;
        const EdgeCounts& own = counts[groups[part]];
        wanted[groups[part]] = wanted[groups[part]] != 0 && plain && own.hard > 0 && !own.isHardEverywhere() ? 1 : 0;
    }
    std::vector<uint8_t> creased(groups.size(), 0); // by part
    const uint32_t edges = creaseEdges(cage, *topology, [&](const Topology::Edge& edge) {
        const uint32_t face = topology->cornerFaces[edge.corner];
        const uint32_t part = cage.faceParts.empty() ? 0 : cage.faceParts[face];
        const bool hard = wanted[groups[part]] != 0 && hasSplitNormals(cage, *topology, edge);
        creased[part] = creased[part] != 0 || hard ? 1 : 0;
        return hard;
    });
    if (edges > 0) {
        warn(character.warnings, "file",
             counted(edges, "edge", "edges") + " of " +
                 std::to_string(std::count(creased.begin(), creased.end(), uint8_t{1})) + " of " +
                 counted(groups.size(), "part", "parts") + " made hard creases: their normals are split");
    }
}

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
