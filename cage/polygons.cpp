#include "cage/polygons.h"

#include <algorithm>
#include <utility>

namespace supple::cage {
namespace {

bool degenerate(const uint32_t* triangle, std::span<const uint32_t> welded) {
    const uint32_t a = welded[triangle[0]];
    const uint32_t b = welded[triangle[1]];
    const uint32_t c = welded[triangle[2]];
    return a == b || b == c || c == a;
}

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

/// The half-edges of triangles over welded vertices: half-edge e runs from triangles[e] to the next corner of its
/// triangle.
struct TriangleEdges {
    std::span<const uint32_t> triangles;
    std::span<const uint32_t> welded;

    [[nodiscard]] static size_t next(size_t e) { return e % 3 == 2 ? e - 2 : e + 1; }
    [[nodiscard]] uint32_t from(size_t e) const { return welded[triangles[e]]; }
    [[nodiscard]] uint32_t to(size_t e) const { return welded[triangles[next(e)]]; }
    [[nodiscard]] std::pair<uint32_t, uint32_t> edge(size_t e) const { return std::minmax(from(e), to(e)); }
};

constexpr size_t kBoundary = ~size_t{0};

/// Per half-edge the one that it is merged with, kBoundary where it is visible or the edge has not two triangles.
std::vector<size_t> mergedEdges(const TriangleEdges& mesh, std::span<const uint8_t> hidden) {
    const size_t count = mesh.triangles.size() / 3;
    std::vector<size_t> byEdge;
    for (size_t e = 0; e < 3 * count; ++e) {
        if (!degenerate(&mesh.triangles[e - e % 3], mesh.welded)) {
            byEdge.push_back(e);
        }
    }
    std::sort(byEdge.begin(), byEdge.end(),
              [&](size_t x, size_t y) { return std::pair(mesh.edge(x), x) < std::pair(mesh.edge(y), y); });
    std::vector<size_t> across(3 * count, kBoundary);
    for (size_t begin = 0; begin < byEdge.size();) {
        size_t end = begin;
        while (end < byEdge.size() && mesh.edge(byEdge[end]) == mesh.edge(byEdge[begin])) {
            ++end;
        }
        const size_t x = byEdge[begin];
        const size_t y = byEdge[end - 1];
        if (end - begin == 2 && hidden[x] != 0 && hidden[y] != 0 && mesh.from(x) == mesh.to(y)) {
            across[x] = y;
            across[y] = x;
        }
        begin = end;
    }
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

/// How many faces the vertices have that triangles surround.
class InnerFans {
public:
    InnerFans(std::span<const uint32_t> triangles, std::span<const uint32_t> welded)
        : faces_(welded.size(), 0), onBoundary_(welded.size(), 0) {
        std::vector<std::pair<uint32_t, uint32_t>> edges;
        for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
            for (size_t k = 0; k < 3 && !degenerate(&triangles[t], welded); ++k) {
                const uint32_t from = welded[triangles[t + k]], to = welded[triangles[t + (k + 1) % 3]];
                ++faces_[from];
                edges.push_back(std::minmax(from, to));
            }
        }
        std::sort(edges.begin(), edges.end());
        for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            end = static_cast<size_t>(
                std::upper_bound(edges.begin() + static_cast<ptrdiff_t>(begin), edges.end(), edges[begin]) -
                edges.begin());
            if (end - begin != 2) {
                onBoundary_[edges[begin].first] = onBoundary_[edges[begin].second] = 1;
            }
        }
    }

    /// Whether the vertex keeps three faces if two of its faces become one.
    [[nodiscard]] bool canMerge(uint32_t vertex) const { return onBoundary_[vertex] != 0 || faces_[vertex] > 3; }
    void merge(uint32_t vertex) { --faces_[vertex]; }

private:
    std::vector<uint32_t> faces_; ///< by welded vertex
    std::vector<uint8_t> onBoundary_;
};

} // namespace

Polygons keepTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded) {
    Polygons polygons;
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        if (degenerate(&triangles[t], welded))
            ++polygons.degenerateTriangles;
        else
            addFace(polygons, triangles.subspan(t, 3));
    }
    return polygons;
}

Polygons decodeNgons(std::span<const uint32_t> triangles, std::span<const uint32_t> welded) {
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
        if (degenerate(triangle, welded)) {
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
        if (degenerate(&triangles[3 * first], welded)) {
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

Polygons pairTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded,
                       const std::function<bool(uint32_t, uint32_t)>& sameCorner,
                       const std::function<bool(const uint32_t*, const uint32_t*)>& normalsAgree) {
    Polygons polygons;
    InnerFans fans(triangles, welded);
    const size_t count = triangles.size() / 3;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t* first = &triangles[3 * i];
        if (degenerate(first, welded)) {
            ++polygons.degenerateTriangles;
            continue;
        }
        const uint32_t* second = i + 1 < count ? first + 3 : nullptr;
        bool paired = false;
        for (int j = 0; j < 3 && second != nullptr && !degenerate(second, welded) && !paired; ++j) {
            for (int k = 0; k < 3 && !paired; ++k) {
                // first runs p -> q along the shared edge, second q -> p; s is second's third corner
                const uint32_t p = first[j];
                const uint32_t q = first[(j + 1) % 3];
                const uint32_t s = second[(k + 2) % 3];
                if (welded[second[k]] != welded[q] || welded[second[(k + 1) % 3]] != welded[p] ||
                    welded[s] == welded[first[(j + 2) % 3]] || !sameCorner(second[k], q) ||
                    !sameCorner(second[(k + 1) % 3], p) || !normalsAgree(first, second))
                    continue;
                paired = true;
                if (!fans.canMerge(welded[p]) || !fans.canMerge(welded[q])) {
                    addFace(polygons, std::span(first, 3));
                    addFace(polygons, std::span(second, 3));
                    continue;
                }
                fans.merge(welded[p]);
                fans.merge(welded[q]);
                for (int corner = 0; corner < 3; ++corner) {
                    polygons.vertices.push_back(first[corner]);
                    if (corner == j)
                        polygons.vertices.push_back(s);
                }
                polygons.close();
            }
        }
        if (paired)
            ++i;
        else
            addFace(polygons, std::span(first, 3));
    }
    return polygons;
}

} // namespace supple::cage
