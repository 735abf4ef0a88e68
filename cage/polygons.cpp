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
    // Half-edge e runs from triangles[e] to the next corner of its triangle.
    const auto next = [](size_t e) { return e % 3 == 2 ? e - 2 : e + 1; };
    const auto from = [&](size_t e) { return welded[triangles[e]]; };
    const auto to = [&](size_t e) { return welded[triangles[next(e)]]; };
    const size_t count = triangles.size() / 3;

    std::vector<size_t> byEdge;
    for (size_t e = 0; e < 3 * count; ++e) {
        if (!degenerate(&triangles[e - e % 3], welded)) {
            byEdge.push_back(e);
        }
    }
    const auto edge = [&](size_t e) { return std::pair<uint32_t, uint32_t>(std::minmax(from(e), to(e))); };
    std::sort(byEdge.begin(), byEdge.end(),
              [&](size_t x, size_t y) { return std::pair(edge(x), x) < std::pair(edge(y), y); });
    constexpr size_t kBoundary = ~size_t{0};
    std::vector<size_t> across(3 * count, kBoundary); ///< half-edge -> the one it is merged with
    for (size_t begin = 0; begin < byEdge.size();) {
        size_t end = begin;
        while (end < byEdge.size() && edge(byEdge[end]) == edge(byEdge[begin])) {
            ++end;
        }
        const size_t x = byEdge[begin];
        const size_t y = byEdge[end - 1];
        if (end - begin == 2 && hidden[x] != 0 && hidden[y] != 0 && from(x) == to(y)) {
            across[x] = y;
            across[y] = x;
        }
        begin = end;
    }

    Polygons polygons;
    std::vector<uint8_t> seen(count, 0);
    std::vector<size_t> region;
    std::vector<size_t> boundary;
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
        seen[first] = 1;
        region.assign(1, first);
        boundary.clear();
        for (size_t i = 0; i < region.size(); ++i) {
            for (size_t e = 3 * region[i]; e < 3 * region[i] + 3; ++e) {
                if (across[e] == kBoundary) {
                    boundary.push_back(e);
                } else if (seen[across[e] / 3] == 0) {
                    seen[across[e] / 3] = 1;
                    region.push_back(across[e] / 3);
                }
            }
        }
        // n corners make n - 2 triangles; more of these are round a vertex within, or join what is joined already.
        bool simple = region.size() + 2 == boundary.size();
        corners.clear();
        if (simple) {
            // Along the boundary, round each vertex from one boundary edge to the next.
            for (size_t e = boundary[0]; corners.size() < boundary.size();) {
                corners.push_back(triangles[e]);
                e = next(e);
                while (across[e] != kBoundary) {
                    e = next(across[e]);
                }
                if (e == boundary[0]) {
                    break;
                }
            }
            simple = corners.size() == boundary.size() && !repeats(corners, welded, scratch);
        }
        if (simple) {
            addFace(polygons, corners);
            continue;
        }
        ++polygons.brokenRegions;
        std::sort(region.begin(), region.end());
        for (const size_t t : region) {
            addFace(polygons, triangles.subspan(3 * t, 3));
        }
    }
    return polygons;
}

Polygons pairTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded,
                       const std::function<bool(uint32_t, uint32_t)>& sameCorner,
                       const std::function<bool(const uint32_t*, const uint32_t*)>& normalsAgree) {
    Polygons polygons;
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
                for (int corner = 0; corner < 3; ++corner) {
                    polygons.vertices.push_back(first[corner]);
                    if (corner == j)
                        polygons.vertices.push_back(s);
                }
                polygons.close();
                paired = true;
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
