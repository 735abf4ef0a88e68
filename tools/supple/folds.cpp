#include "tools/supple/folds.h"

#include "tools/reference/pm.h"

#include <algorithm>
#include <map>
#include <utility>

namespace supple::tools {
namespace {

/// The grid of a domain: its triangles, and which of them share a side.
struct Grid {
    explicit Grid(surface::Domain domain)
        : indices(surface::gridIndices(domain, kFoldRate)), samples(surface::sampleCount(domain, kFoldRate)) {
        std::map<std::pair<uint16_t, uint16_t>, uint32_t> sides;
        for (uint32_t i = 0; i < indices.size(); ++i) {
            const uint32_t t = i / 3;
            const uint16_t a = indices[i], b = indices[3 * t + (i + 1) % 3];
            const auto other = sides.find({b, a});
            if (other != sides.end()) {
                neighbours.emplace_back(other->second, t);
            }
            sides[{a, b}] = t;
        }
    }

    [[nodiscard]] uint32_t triangles() const { return static_cast<uint32_t>(indices.size() / 3); }

    std::vector<uint16_t> indices;
    uint32_t samples;
    std::vector<std::pair<uint32_t, uint32_t>> neighbours;
};

uint32_t flippedTriangles(const surface::pm::Patch<double>& patch, const Grid& grid) {
    std::vector<glm::dvec3> points;
    for (uint32_t s = 0; s < grid.samples; ++s) {
        const auto at = surface::pm::domainPoint<double>(patch.facetClass, kFoldRate, s);
        points.push_back(surface::pm::evaluate(patch, at).position);
    }
    std::vector<glm::dvec3> normals;
    glm::dvec3 whole(0.0);
    for (uint32_t t = 0; t < grid.triangles(); ++t) {
        const uint16_t* const corners = &grid.indices[3 * size_t{t}];
        const glm::dvec3& a = points[corners[0]];
        normals.push_back(glm::cross(points[corners[1]] - a, points[corners[2]] - a));
        whole += normals.back();
    }
    const bool folded = std::any_of(grid.neighbours.begin(), grid.neighbours.end(), [&](const auto& pair) {
        return glm::dot(normals[pair.first], normals[pair.second]) < 0.0;
    });
    const auto flipped = std::count_if(normals.begin(), normals.end(),
                                       [&](const glm::dvec3& normal) { return glm::dot(normal, whole) < 0.0; });
    return folded ? static_cast<uint32_t>(flipped) : 0;
}

} // namespace

Folds findFolds(const surface::pm::Mesh& mesh) {
    const std::vector<glm::dvec3> positions(mesh.cage.positions.begin(), mesh.cage.positions.end());
    const auto coefficients = surface::pm::construct<double>(mesh, positions);
    std::vector<Grid> grids;
    for (uint32_t domain = 0; domain < surface::kDomainCount; ++domain) {
        grids.emplace_back(static_cast<surface::Domain>(domain));
    }
    Folds folds;
    std::map<uint32_t, Folds::Face> faces; // a face of six and more sides has several patches
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        if (std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f)) {
            continue;
        }
        const Grid& grid = grids[static_cast<size_t>(surface::pm::domainOf(mesh.classes[f]))];
        const uint32_t flipped = flippedTriangles(surface::pm::gatherPatch<double>(mesh, coefficients, f), grid);
        Folds::Face& face = faces[mesh.sourceFaces[f]];
        face.face = mesh.sourceFaces[f];
        face.flipped += flipped;
        face.triangles += grid.triangles();
        folds.flipped += flipped;
        folds.triangles += grid.triangles();
    }
    for (const auto& [index, face] : faces) {
        if (face.flipped > 0) {
            folds.faces.push_back(face);
        }
    }
    std::stable_sort(folds.faces.begin(), folds.faces.end(), [](const Folds::Face& a, const Folds::Face& b) {
        return uint64_t{a.flipped} * b.triangles > uint64_t{b.flipped} * a.triangles;
    });
    return folds;
}

} // namespace supple::tools
