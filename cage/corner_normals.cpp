#include "cage/corner_normals.h"

#include "cage/smooth_groups.h"

#include <cmath>
#include <cstdint>

namespace supple::cage {
namespace {

/// How far from 1 the length of a unit vector of floats may be.
constexpr double kUnit = 1e-6;

constexpr float kCosineOfDegree = 0.99984770f;

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : fallback;
}

} // namespace

glm::vec3 unitNormal(const glm::dvec3& given) {
    const double length = glm::length(given);
    if (std::abs(length - 1.0) < kUnit) {
        return given;
    }
    return unitOr(given, glm::dvec3(0.0));
}

glm::vec4 unitTangent(const glm::dvec4& given) {
    const glm::vec3 direction = unitNormal(glm::dvec3(given));
    return direction == glm::vec3(0.0f) ? glm::vec4(0.0f) : glm::vec4(direction, given.w < 0.0 ? -1.0f : 1.0f);
}

std::vector<glm::vec3> deformedCornerNormals(const Cage& cage, std::span<const glm::vec3> positions) {
    const std::vector<uint32_t> groups = smoothGroups(cage);
    std::vector<glm::dvec3> sums(cage.cornerCount(), glm::dvec3(0.0));
    std::vector<glm::dvec3> faceNormals;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t first = cage.faceStarts[face];
        const uint32_t last = cage.faceStarts[face + 1];
        const auto position = [&](uint32_t corner) { return glm::dvec3(positions[cage.faceVertices[corner]]); };
        glm::dvec3 area(0.0);
        for (uint32_t corner = first + 1; corner + 1 < last; ++corner) {
            area += glm::cross(position(corner) - position(first), position(corner + 1) - position(first));
        }
        const glm::dvec3 normal = unitOr(area, {0.0, 0.0, 0.0});
        faceNormals.push_back(normal);
        for (uint32_t corner = first; corner < last; ++corner) {
            const glm::dvec3 to = position(nextCorner(cage, face, corner)) - position(corner);
            const glm::dvec3 back = position(previousCorner(cage, face, corner)) - position(corner);
            const double angle = std::atan2(glm::length(glm::cross(to, back)), glm::dot(to, back));
            sums[groups[corner]] += angle * normal;
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(cage.cornerCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        // Faces without area still need a direction.
        const glm::dvec3 own = unitOr(faceNormals[face], {0.0, 1.0, 0.0});
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            normals.emplace_back(unitOr(sums[groups[corner]], own));
        }
    }
    return normals;
}

std::vector<glm::vec3> cornerNormals(const Cage& cage) {
    std::vector<glm::vec3> normals = deformedCornerNormals(cage, cage.positions);
    for (size_t corner = 0; corner < cage.cornerNormals.size(); ++corner) {
        if (cage.cornerNormals[corner] != glm::vec3(0.0f)) {
            normals[corner] = cage.cornerNormals[corner];
        }
    }
    return normals;
}

bool normalsAgree(const glm::vec3& a, const glm::vec3& b) {
    return glm::dot(a, b) >= kCosineOfDegree;
}

bool hasSplitNormals(const Cage& cage, const Topology& topology, const Topology::Edge& edge) {
    if (edge.twin == kNone || cage.cornerNormals.empty()) {
        return false;
    }
    const auto split = [&](uint32_t a, uint32_t b) {
        const glm::vec3& normal = cage.cornerNormals[a];
        const glm::vec3& other = cage.cornerNormals[b];
        return normal != glm::vec3(0.0f) && other != glm::vec3(0.0f) && !normalsAgree(normal, other);
    };
    const auto end = [&](uint32_t corner) { return nextCorner(cage, topology.cornerFaces[corner], corner); };
    return split(edge.corner, end(edge.twin)) || split(end(edge.corner), edge.twin);
}

} // namespace supple::cage
