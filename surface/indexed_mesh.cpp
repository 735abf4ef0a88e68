#include "surface/indexed_mesh.h"

#include <algorithm>
#include <tuple>

namespace supple::surface {

namespace {

/// Where a sample of a domain lies: on an edge at k, at a corner (k = 0), or inside.
struct Place {
    bool inside = true;
    uint32_t edge = 0; ///< or the number among those inside
    uint32_t k = 0;
};

std::vector<Place> placesOf(Domain domain, uint32_t rate) {
    std::vector<Place> all(sampleCount(domain, rate));
    for (uint32_t edge = 0; edge < cornerCount(domain); ++edge) {
        for (uint32_t k = 0; k < rate; ++k) {
            all[edgeSample(domain, rate, edge, k)] = {false, edge, k};
        }
    }
    if (domain == Domain::polar) { // the apex is a whole row
        for (uint32_t i = 0; i <= rate; ++i) {
            all[rate * (rate + 1) + i] = {false, 2, 0};
        }
    }
    uint32_t inside = 0;
    for (Place& place : all) {
        if (place.inside) {
            place.edge = inside++;
        }
    }
    return all;
}

/// Which vertices are a patch's, by its samples. `places`: those of its domain.
std::vector<uint32_t> verticesOf(const Tables& tables, const Evaluation& evaluation, const std::vector<Place>& places,
                                 uint32_t patch) {
    const uint32_t rate = evaluation.rate;
    const PatchRange& range = tables.rangeOf(patch);
    const uint32_t inside = evaluation.firstVertices[static_cast<size_t>(&range - tables.ranges.data())] +
                            (patch - range.firstPatch) * interiorCount(domainOf(range.patchClass), rate);
    const MeshTables::Patch& own = tables.mesh.patches[patch];
    std::vector<uint32_t> result;
    result.reserve(places.size());
    for (const Place& place : places) {
        if (place.inside) {
            result.push_back(inside + place.edge);
        } else if (place.k == 0) {
            result.push_back(evaluation.firstCornerVertex + own.corners[place.edge]);
        } else {
            const uint32_t k = own.reversed[place.edge] ? rate - place.k : place.k;
            result.push_back(evaluation.firstEdgeVertex + own.edges[place.edge] * (rate - 1) + k - 1);
        }
    }
    return result;
}

/// Patches of one class are sorted by material and part.
IndexedMesh triangleMesh(const Tables& tables) {
    IndexedMesh mesh;
    mesh.indices = tables.triangles.indices;
    for (const DrawRange& draw : tables.drawRanges) {
        mesh.ranges.push_back({draw.part, draw.material, 3 * draw.firstPatch, 3 * draw.patchCount});
    }
    return mesh;
}

} // namespace

uint32_t interiorCount(Domain domain, uint32_t rate) {
    switch (domain) {
    case Domain::triangle:
        return rate < 3 ? 0 : sampleCount(domain, rate - 3);
    case Domain::pentagon:
        return sampleCount(domain, rate - 1);
    default:
        return (rate - 1) * (rate - 1);
    }
}

IndexedMesh indexedMesh(const Tables& tables, const Evaluation& evaluation) {
    if (!tables.triangles.indices.empty()) {
        return triangleMesh(tables);
    }
    std::vector<DrawRange> draws = tables.drawRanges;
    std::stable_sort(draws.begin(), draws.end(), [](const DrawRange& a, const DrawRange& b) {
        return std::tie(a.material, a.part) < std::tie(b.material, b.part);
    });
    IndexedMesh mesh;
    for (const DrawRange& draw : draws) {
        const auto first = static_cast<uint32_t>(mesh.indices.size());
        if (mesh.ranges.empty() || mesh.ranges.back().part != draw.part ||
            mesh.ranges.back().material != draw.material) {
            mesh.ranges.push_back({draw.part, draw.material, first, 0});
        }
        const std::vector<uint16_t> grid = gridIndices(draw.domain, evaluation.rate);
        const std::vector<Place> places = placesOf(draw.domain, evaluation.rate);
        for (uint32_t patch = draw.firstPatch; patch < draw.firstPatch + draw.patchCount; ++patch) {
            const std::vector<uint32_t> vertices = verticesOf(tables, evaluation, places, patch);
            for (const uint16_t sample : grid) {
                mesh.indices.push_back(vertices[sample]);
            }
        }
        mesh.ranges.back().indexCount += static_cast<uint32_t>(mesh.indices.size()) - first;
    }
    return mesh;
}

std::vector<uint32_t> meshVertices(const Tables& tables, const Evaluation& evaluation, uint32_t patch) {
    if (!tables.triangles.indices.empty()) {
        const auto first = tables.triangles.indices.begin() + ptrdiff_t{3} * patch;
        return {first, first + 3};
    }
    const Domain domain = domainOf(tables.rangeOf(patch).patchClass);
    return verticesOf(tables, evaluation, placesOf(domain, evaluation.rate), patch);
}

uint64_t gridMeshIndices(const Tables& tables, const Evaluation& evaluation) {
    uint64_t count = 0;
    for (const DrawRange& draw : tables.drawRanges) {
        count += gridIndices(draw.domain, evaluation.rate).size() * uint64_t{draw.patchCount};
    }
    return count;
}

IndexedMesh gridMesh(const Tables& tables, const Evaluation& evaluation) {
    IndexedMesh mesh;
    mesh.indices.reserve(gridMeshIndices(tables, evaluation));
    uint32_t firstVertex = 0;
    for (const DrawRange& draw : tables.drawRanges) {
        const std::vector<uint16_t> grid = gridIndices(draw.domain, evaluation.rate);
        const auto indexCount = static_cast<uint32_t>(grid.size()) * draw.patchCount;
        mesh.ranges.push_back({draw.part, draw.material, static_cast<uint32_t>(mesh.indices.size()), indexCount});
        for (uint32_t patch = 0; patch < draw.patchCount; ++patch) {
            for (const uint16_t sample : grid) {
                mesh.indices.push_back(firstVertex + sample);
            }
            firstVertex += sampleCount(draw.domain, evaluation.rate);
        }
    }
    return mesh;
}

} // namespace supple::surface
