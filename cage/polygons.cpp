#include "cage/polygons.h"

#include <algorithm>

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
