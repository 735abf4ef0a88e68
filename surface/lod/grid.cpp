#include "surface/lod/grid.h"

#include <cstddef>

namespace supple::surface::lod {

namespace {

constexpr uint32_t middle(uint32_t capacity) {
    return (capacity - 1) / 2;
}

/// Samples before ring r.
constexpr uint32_t ringStart(uint32_t sides, uint32_t capacity, uint32_t r) {
    return sides * r * (capacity - r + 1);
}

/// Sample k of ring r, counted from the ray of corner `side`.
uint32_t ringSample(uint32_t sides, uint32_t capacity, uint32_t r, uint32_t side, uint32_t k) {
    if (k == capacity - r) { // the ray belongs to the next side
        side = (side + 1) % sides;
        k = r;
    }
    return ringStart(sides, capacity, r) + side * (capacity - 2 * r) + k - r;
}

/// Appends triangles to an index buffer; a cell's corners go round, a first.
class Triangles {
public:
    Triangles(std::vector<uint16_t>& indices, uint32_t base) : indices_(indices), base_(base) {}

    void add(uint32_t a, uint32_t b, uint32_t c) {
        for (const uint32_t sample : {a, b, c}) {
            indices_.push_back(static_cast<uint16_t>(base_ + sample));
        }
    }
    void addCell(uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool diagonalFromA) {
        if (diagonalFromA) {
            add(a, b, c);
            add(a, c, d);
        } else {
            add(a, b, d);
            add(b, c, d);
        }
    }

private:
    std::vector<uint16_t>& indices_;
    uint32_t base_;
};

void quadTriangles(uint32_t capacity, Triangles& triangles) {
    const uint32_t row = capacity + 1;
    const uint32_t h = middle(capacity);
    for (uint32_t j = 0; j < capacity; ++j) {
        for (uint32_t i = 0; i < capacity; ++i) {
            const uint32_t a = j * row + i;
            triangles.addCell(a, a + 1, a + row + 1, a + row, (i <= h) == (j <= h));
        }
    }
}

void ringTriangles(uint32_t sides, uint32_t capacity, Triangles& triangles) {
    const uint32_t h = middle(capacity);
    for (uint32_t r = 0; r < h; ++r) {
        for (uint32_t side = 0; side < sides; ++side) {
            const auto at = [&](uint32_t ring, uint32_t k) { return ringSample(sides, capacity, ring, side, k); };
            // A ray is the diagonal of the cells at the corners; each side has one half of both.
            triangles.add(at(r, r), at(r, r + 1), at(r + 1, r + 1));
            for (uint32_t k = r + 1; k + 1 < capacity - r; ++k) {
                triangles.addCell(at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r + 1, k), k <= h);
            }
            triangles.add(at(r, capacity - r - 1), at(r, capacity - r), at(r + 1, capacity - r - 1));
        }
    }
    const uint32_t inmost = ringStart(sides, capacity, h);
    for (uint32_t side = 1; side + 1 < sides; ++side) {
        triangles.add(inmost, inmost + side, inmost + side + 1);
    }
}

} // namespace

std::vector<uint16_t> gridIndices(Form form, uint32_t capacity) {
    std::vector<uint16_t> indices;
    const uint32_t patches = patchesPerDraw(form, capacity);
    indices.reserve(std::size_t{6} * patches * sampleCount(form, capacity));
    for (uint32_t patch = 0; patch < patches; ++patch) {
        Triangles triangles(indices, patch * sampleCount(form, capacity));
        if (form == Form::quad) {
            quadTriangles(capacity, triangles);
        } else {
            ringTriangles(sides(form), capacity, triangles);
        }
    }
    return indices;
}

} // namespace supple::surface::lod
