#include "cage/polygons.h"

#include "cage/triangle_edges.h"

#include <algorithm>
#include <utility>

namespace supple::cage {
namespace {

void addFace(Polygons& polygons, std::span<const uint32_t> corners) {
    polygons.vertices.insert(polygons.vertices.end(), corners.begin(), corners.end());
    polygons.close();
}

bool repeats(std::span<const uint32_t> corners, std::span<const uint32_t> welded, std::vector<uint32_t>& scratch) {
    scratch.clear();
    for (const uint32_t corner : corners)
        scratch.push_back(welded[corner]);
    std::sort(scratch.begin(), scratch.end());
    return std::adjacent_find(scratch.begin(), scratch.end()) != scratch.end();
}

constexpr size_t kBoundary = ~size_t{0};

/// Per half-edge the one that it is merged with, kBoundary where it is visible or the edge has not two triangles.
std::vector<size_t> mergedEdges(const TriangleEdges& mesh, std::span<const uint8_t> hidden) {
    std::vector<size_t> across(mesh.triangles.size(), kBoundary);
    mesh.forEachEdge([&](std::span<const size_t> sides) {
        const size_t x = sides.front();
        const size_t y = sides.back();
        if (sides.size() == 2 && hidden[x] != 0 && hidden[y] != 0 && mesh.from(x) == mesh.to(y)) {
            across[x] = y;
            across[y] = x;
        }
    });
    return across;
}

/// Triangles that are merged across hidden edges, and the half-edges round them.
struct Region {
    std::vector<size_t> triangles;
    std::vector<size_t> boundary;
};

/// Fills the region of triangle `first`, and marks its triangles as seen.
void gather(size_t first, std::span<const size_t> across, std::vector<uint8_t>& seen, Region& region) {
    seen[first] = 1;
    region.triangles.assign(1, first);
    region.boundary.clear();
    for (size_t i = 0; i < region.triangles.size(); ++i) {
        const size_t triangle = region.triangles[i];
        for (size_t e = 3 * triangle; e < 3 * triangle + 3; ++e) {
            if (across[e] == kBoundary) {
                region.boundary.push_back(e);
            } else if (seen[across[e] / 3] == 0) {
                seen[across[e] / 3] = 1;
                region.triangles.push_back(across[e] / 3);
            }
        }
    }
}

/// Fills the corners of the polygon that a region is; false where it is none.
bool outline(const Region& region, std::span<const size_t> across, const TriangleEdges& mesh,
             std::vector<uint32_t>& corners, std::vector<uint32_t>& scratch) {
    corners.clear();
    // n corners make n - 2 triangles; more of these are round a vertex within, or join what is joined already.
    if (region.triangles.size() + 2 != region.boundary.size()) {
        return false;
    }
    // Along the boundary, round each vertex from one boundary edge to the next.
    for (size_t e = region.boundary[0]; corners.size() < region.boundary.size();) {
        corners.push_back(mesh.triangles[e]);
        e = TriangleEdges::next(e);
        while (across[e] != kBoundary) {
            e = TriangleEdges::next(across[e]);
        }
        if (e == region.boundary[0]) {
            break;
        }
    }
    return corners.size() == region.boundary.size() && !repeats(corners, mesh.welded, scratch);
}

} // namespace

Polygons keepTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded) {
    const TriangleEdges mesh{triangles, welded};
    Polygons polygons;
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        if (mesh.isDegenerate(t / 3))
            ++polygons.degenerateTriangles;
        else
            addFace(polygons, triangles.subspan(t, 3));
    }
    return polygons;
}

Polygons decodeNgons(std::span<const uint32_t> triangles, std::span<const uint32_t> welded) {
    const TriangleEdges mesh{triangles, welded};
    Polygons polygons;
    std::vector<uint32_t> run; // the polygon so far: anchor, then the fan's rim
    std::vector<uint32_t> scratch;
    const auto finish = [&] {
        if (run.empty())
            return;
        if (!repeats(run, welded, scratch)) {
            addFace(polygons, run);
        } else {
            ++polygons.recutRuns;
            for (size_t k = 1; k + 1 < run.size();) {
                const uint32_t quad[4] = {run[0], run[k], run[k + 1], k + 2 < run.size() ? run[k + 2] : run[0]};
                if (k + 2 < run.size() && !repeats(quad, welded, scratch)) {
                    addFace(polygons, quad);
                    k += 2;
                } else {
                    addFace(polygons, std::span(quad).first(3));
                    k += 1;
                }
            }
        }
        run.clear();
    };
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        const uint32_t* triangle = &triangles[t];
        if (mesh.isDegenerate(t / 3)) {
            finish();
            ++polygons.degenerateTriangles;
        } else if (!run.empty() && triangle[0] == run[0] && triangle[1] == run.back()) {
            run.push_back(triangle[2]);
        } else {
            finish();
            run.assign(triangle, triangle + 3);
        }
    }
    finish();
    return polygons;
}

Polygons mergeAcrossHiddenEdges(std::span<const uint32_t> triangles, std::span<const uint32_t> welded,
                                std::span<const uint8_t> hidden) {
    const TriangleEdges mesh{triangles, welded};
    const std::vector<size_t> across = mergedEdges(mesh, hidden);
    const size_t count = triangles.size() / 3;
    Polygons polygons;
    std::vector<uint8_t> seen(count, 0);
    Region region;
    std::vector<uint32_t> corners;
    std::vector<uint32_t> scratch;
    for (size_t first = 0; first < count; ++first) {
        if (mesh.isDegenerate(first)) {
            ++polygons.degenerateTriangles;
            continue;
        }
        if (seen[first] != 0) {
            continue;
        }
        gather(first, across, seen, region);
        if (outline(region, across, mesh, corners, scratch)) {
            addFace(polygons, corners);
            continue;
        }
        ++polygons.brokenRegions;
        std::sort(region.triangles.begin(), region.triangles.end());
        for (const size_t t : region.triangles) {
            addFace(polygons, triangles.subspan(3 * t, 3));
        }
    }
    return polygons;
}

} // namespace supple::cage
