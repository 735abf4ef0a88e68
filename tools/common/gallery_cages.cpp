#include "tools/common/gallery_cages.h"

#include "tools/common/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace supple::cage {
namespace {

Cage emptyCage() {
    Cage cage;
    cage.faceStarts.push_back(0);
    return cage;
}

void addFace(Cage& cage, std::initializer_list<uint32_t> vertices) {
    cage.faceVertices.insert(cage.faceVertices.end(), vertices);
    cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
}

void finish(Cage& cage) {
    cage.sourceVertices.resize(cage.positions.size());
    std::iota(cage.sourceVertices.begin(), cage.sourceVertices.end(), 0u);
}

double heightOf(GalleryShape shape, double x, double y) {
    return shape == GalleryShape::elliptic ? -0.125 * (x * x + y * y) : 0.125 * (x * x - y * y);
}

void bend(Cage& cage, GalleryShape shape) {
    for (glm::vec3& p : cage.positions)
        p.z = static_cast<float>(heightOf(shape, static_cast<double>(p.x), static_cast<double>(p.y)));
}

void append(Cage& all, const Cage& cage, const glm::vec3& offset) {
    const uint32_t first = all.vertexCount();
    for (const glm::vec3& p : cage.positions)
        all.positions.push_back(p + offset);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c)
            all.faceVertices.push_back(first + cage.faceVertices[c]);
        all.faceStarts.push_back(static_cast<uint32_t>(all.faceVertices.size()));
    }
}

/// Pulls out some faces of a closed cage: they move, and a ring of quads grows round them.
void extrude(Cage& cage, const std::vector<uint32_t>& faces, const glm::vec3& by, float scale) {
    std::map<std::pair<uint32_t, uint32_t>, bool> sides; // of the faces; whether the side is there backwards, too
    for (const uint32_t f : faces) {
        const uint32_t first = cage.faceStarts[f];
        for (uint32_t i = 0; i < 4; ++i)
            sides[{cage.faceVertices[first + i], cage.faceVertices[first + (i + 1) % 4]}] = false;
    }
    for (auto& [side, inner] : sides)
        inner = sides.contains({side.second, side.first});
    std::map<uint32_t, uint32_t> moved;
    glm::vec3 middle(0.0f);
    for (const auto& [side, inner] : sides) {
        if (moved.try_emplace(side.first, 0).second)
            middle += cage.positions[side.first];
    }
    middle /= static_cast<float>(moved.size());
    for (auto& [vertex, copy] : moved) {
        copy = cage.vertexCount();
        cage.positions.push_back(middle + by + scale * (cage.positions[vertex] - middle));
    }
    for (const uint32_t f : faces) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f] + 4; ++c)
            cage.faceVertices[c] = moved[cage.faceVertices[c]];
    }
    for (const auto& [side, inner] : sides) {
        if (!inner)
            addFace(cage, {side.first, side.second, moved[side.second], moved[side.first]});
    }
}

/// Inner vertices of pulled faces stay behind without faces.
void dropUnused(Cage& cage) {
    std::vector<uint32_t> renamed(cage.positions.size(), kNone);
    std::vector<glm::vec3> positions;
    for (uint32_t& v : cage.faceVertices) {
        if (renamed[v] == kNone) {
            renamed[v] = static_cast<uint32_t>(positions.size());
            positions.push_back(cage.positions[v]);
        }
        v = renamed[v];
    }
    cage.positions = std::move(positions);
}

glm::vec3 middleOf(const Cage& cage, uint32_t face) {
    glm::vec3 sum(0.0f);
    for (uint32_t c = cage.faceStarts[face]; c < cage.faceStarts[face + 1]; ++c)
        sum += cage.positions[cage.faceVertices[c]];
    return 0.25f * sum;
}

/// The faces round the vertex nearest to a direction, or with `block` the face nearest to it and the eight round that.
std::vector<uint32_t> facesAt(const Cage& cage, const glm::vec3& direction, bool block, uint32_t among) {
    const glm::vec3 unit = glm::normalize(direction);
    const auto nearness = [&](const glm::vec3& p) { return glm::dot(glm::normalize(p), unit); };
    std::vector<uint32_t> corners;
    if (block) {
        uint32_t nearest = 0;
        for (uint32_t f = 1; f < among; ++f)
            nearest = nearness(middleOf(cage, f)) > nearness(middleOf(cage, nearest)) ? f : nearest;
        corners.assign(&cage.faceVertices[4 * nearest], &cage.faceVertices[4 * nearest] + 4);
    } else {
        uint32_t nearest = 0;
        for (uint32_t v = 1; v < cage.vertexCount(); ++v)
            nearest = nearness(cage.positions[v]) > nearness(cage.positions[nearest]) ? v : nearest;
        corners.assign(1, nearest);
    }
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < among; ++f) {
        const uint32_t* const first = &cage.faceVertices[4 * size_t{f}];
        if (std::any_of(first, first + 4,
                        [&](uint32_t v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); }))
            faces.push_back(f);
    }
    return faces;
}

} // namespace

Cage makeValenceCage(uint32_t valence, GalleryShape shape) {
    // A point (a, b) of sector s lies at a e_s + b e_{s+1}, where e are its two spokes.
    constexpr uint32_t kRings = 3;
    Cage cage = emptyCage();
    cage.positions.emplace_back(0.0f);
    const uint32_t ringPoints = kRings * kRings + kRings; // of a sector: a >= 1, 0 <= b <= kRings
    const auto vertex = [&](uint32_t s, uint32_t a, uint32_t b) {
        if (a == 0 && b == 0)
            return 0u;
        if (a == 0) // the next sector's first spoke
            return 1 + (s + 1) % valence * ringPoints + (b - 1) * (kRings + 1);
        return 1 + s % valence * ringPoints + (a - 1) * (kRings + 1) + b;
    };
    const auto spoke = [&](uint32_t s) {
        const double angle = 2.0 * std::numbers::pi * s / valence;
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    for (uint32_t s = 0; s < valence; ++s) {
        for (uint32_t a = 1; a <= kRings; ++a) {
            for (uint32_t b = 0; b <= kRings; ++b) {
                const glm::dvec2 p = static_cast<double>(a) * spoke(s) + static_cast<double>(b) * spoke(s + 1);
                cage.positions.emplace_back(glm::vec3(glm::vec2(p), 0.0f));
            }
        }
    }
    for (uint32_t s = 0; s < valence; ++s) {
        for (uint32_t b = 0; b < kRings; ++b) {
            for (uint32_t a = 0; a < kRings; ++a)
                addFace(cage, {vertex(s, a, b), vertex(s, a + 1, b), vertex(s, a + 1, b + 1), vertex(s, a, b + 1)});
        }
    }
    bend(cage, shape);
    finish(cage);
    return cage;
}

Cage makePolarCage(uint32_t valence, GalleryShape shape) {
    constexpr uint32_t kRings = 3;
    Cage cage = emptyCage();
    cage.positions.emplace_back(0.0f);
    const auto vertex = [&](uint32_t ring, uint32_t s) { return 1 + (ring - 1) * valence + s % valence; };
    for (uint32_t ring = 1; ring <= kRings; ++ring) {
        for (uint32_t s = 0; s < valence; ++s) {
            const double angle = 2.0 * std::numbers::pi * s / valence;
            cage.positions.emplace_back(static_cast<float>(ring * std::cos(angle)),
                                        static_cast<float>(ring * std::sin(angle)), 0.0f);
        }
    }
    for (uint32_t s = 0; s < valence; ++s)
        addFace(cage, {0, vertex(1, s), vertex(1, s + 1)});
    for (uint32_t ring = 1; ring < kRings; ++ring) {
        for (uint32_t s = 0; s < valence; ++s)
            addFace(cage, {vertex(ring, s), vertex(ring + 1, s), vertex(ring + 1, s + 1), vertex(ring, s + 1)});
    }
    bend(cage, shape);
    finish(cage);
    return cage;
}

std::vector<GalleryCage> galleryCages() {
    return {{"valence 3, elliptic", makeValenceCage(3, GalleryShape::elliptic)},
            {"valence 5, elliptic", makeValenceCage(5, GalleryShape::elliptic)},
            {"polar 6, elliptic", makePolarCage(6, GalleryShape::elliptic)},
            {"polar 12, elliptic", makePolarCage(12, GalleryShape::elliptic)},
            {"valence 3, saddle", makeValenceCage(3, GalleryShape::saddle)},
            {"valence 5, saddle", makeValenceCage(5, GalleryShape::saddle)},
            {"polar 6, saddle", makePolarCage(6, GalleryShape::saddle)},
            {"polar 12, saddle", makePolarCage(12, GalleryShape::saddle)}};
}

Cage makeGallery() {
    Cage all = emptyCage();
    const std::vector<GalleryCage> cages = galleryCages();
    for (uint32_t i = 0; i < cages.size(); ++i)
        append(all, cages[i].cage, glm::vec3(8.0f * static_cast<float>(i % 4), 8.0f * static_cast<float>(i / 4), 0.0f));
    finish(all);
    return all;
}

Cage makeTripleDonut() {
    constexpr int kColumns = 7, kRows = 3;
    Cage cage = emptyCage();
    const auto isSolid = [](int x, int y) {
        return x >= 0 && x < kColumns && y >= 0 && y < kRows && !(y == 1 && x % 2 == 1);
    };
    std::map<std::array<int, 3>, uint32_t> vertices;
    const auto vertex = [&](int x, int y, int z) {
        const auto [entry, isNew] = vertices.try_emplace({x, y, z}, cage.vertexCount());
        if (isNew)
            cage.positions.emplace_back(static_cast<float>(x) - 3.5f, static_cast<float>(y) - 1.5f,
                                        static_cast<float>(z) - 0.5f);
        return entry->second;
    };
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) {
            if (!isSolid(x, y))
                continue;
            addFace(cage, {vertex(x, y, 1), vertex(x + 1, y, 1), vertex(x + 1, y + 1, 1), vertex(x, y + 1, 1)});
            addFace(cage, {vertex(x, y, 0), vertex(x, y + 1, 0), vertex(x + 1, y + 1, 0), vertex(x + 1, y, 0)});
            const auto wall = [&](int ax, int ay, int bx, int by) {
                addFace(cage, {vertex(ax, ay, 0), vertex(bx, by, 0), vertex(bx, by, 1), vertex(ax, ay, 1)});
            };
            if (!isSolid(x, y - 1))
                wall(x, y, x + 1, y);
            if (!isSolid(x + 1, y))
                wall(x + 1, y, x + 1, y + 1);
            if (!isSolid(x, y + 1))
                wall(x + 1, y + 1, x, y + 1);
            if (!isSolid(x - 1, y))
                wall(x, y + 1, x, y);
        }
    }
    finish(cage);
    return cage;
}

Cage makeShaft() {
    constexpr uint32_t kAround = 12, kAlong = 88, kCap = 3; // a cap of 3 x 3 quads has 12 sides
    Cage cage = emptyCage();
    const auto radiusAt = [](uint32_t ring) {
        constexpr float kRadii[] = {0.7f, 0.7f, 1.0f, 1.3f, 1.0f, 1.0f, 1.5f, 1.0f, 0.8f, 0.6f, 0.6f};
        return kRadii[std::min<size_t>(ring / 8, std::size(kRadii) - 1)];
    };
    for (uint32_t ring = 0; ring <= kAlong; ++ring) {
        for (uint32_t i = 0; i < kAround; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kAround;
            const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
            cage.positions.emplace_back(0.16f * static_cast<float>(ring) - 7.0f, radiusAt(ring) * c,
                                        radiusAt(ring) * s);
        }
    }
    const auto vertex = [&](uint32_t ring, uint32_t i) { return ring * kAround + i % kAround; };
    for (uint32_t ring = 0; ring < kAlong; ++ring) {
        for (uint32_t i = 0; i < kAround; ++i)
            addFace(cage, {vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1), vertex(ring + 1, i)});
    }
    for (const bool end : {false, true}) { // the cap's border is the last ring, counted round its square
        const uint32_t ring = end ? kAlong : 0;
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> square;
        for (uint32_t i = 0; i < kAround; ++i) {
            const uint32_t side = i / kCap, k = i % kCap;
            const std::pair<uint32_t, uint32_t> at[] = {{k, 0}, {kCap, k}, {kCap - k, kCap}, {0, kCap - k}};
            square[at[side]] = vertex(ring, i);
        }
        for (uint32_t y = 1; y < kCap; ++y) {
            for (uint32_t x = 1; x < kCap; ++x) {
                square[{x, y}] = cage.vertexCount();
                const float u = static_cast<float>(x) / kCap, v = static_cast<float>(y) / kCap;
                const auto corner = [&](uint32_t i) { return cage.positions[vertex(ring, i)]; };
                cage.positions.push_back((1.0f - v) * ((1.0f - u) * corner(0) + u * corner(3)) +
                                         v * ((1.0f - u) * corner(9) + u * corner(6)));
            }
        }
        for (uint32_t y = 0; y < kCap; ++y) {
            for (uint32_t x = 0; x < kCap; ++x) {
                const uint32_t a = square[{x, y}], b = square[{x + 1, y}], c = square[{x + 1, y + 1}],
                               d = square[{x, y + 1}];
                if (end)
                    addFace(cage, {a, b, c, d});
                else
                    addFace(cage, {a, d, c, b});
            }
        }
    }
    for (uint32_t key = 0; key < 8; ++key) { // one quad each, far apart
        const uint32_t face = (10 * key + 8) * kAround + 5 * key % kAround;
        const glm::vec3 middle = middleOf(cage, face);
        extrude(cage, {face}, 0.35f * glm::normalize(glm::vec3(0.0f, middle.y, middle.z)), 0.8f);
    }
    dropUnused(cage);
    finish(cage);
    return cage;
}

Cage makeFrog() {
    constexpr uint32_t kSide = 12;
    Cage cage = makeCubeSphere(kSide);
    const uint32_t among = cage.faceCount();
    struct Limb {
        glm::vec3 at;
        bool block;
        uint32_t segments;
        glm::vec3 first, last; ///< how a segment moves, at the body and at the end
        float scale;
    };
    const glm::vec3 thigh(0.16f, 0.06f, -0.12f), foot(0.02f, -0.14f, 0.14f);
    const glm::vec3 arm(0.10f, -0.08f, 0.10f), hand(0.04f, -0.12f, 0.04f);
    const auto mirrored = [](const glm::vec3& v) { return glm::vec3(-v.x, v.y, v.z); };
    const Limb limbs[] = {
        {{1.0f, -0.35f, -0.8f}, true, 8, thigh, foot, 0.92f},
        {{-1.0f, -0.35f, -0.8f}, true, 8, mirrored(thigh), mirrored(foot), 0.92f},
        {{0.8f, -0.5f, 0.7f}, true, 8, arm, hand, 0.92f},
        {{-0.8f, -0.5f, 0.7f}, true, 8, mirrored(arm), mirrored(hand), 0.92f},
        {{0.5f, 0.8f, 0.6f}, false, 2, {0.03f, 0.14f, 0.05f}, {0.03f, 0.10f, 0.05f}, 0.9f},
        {{-0.5f, 0.8f, 0.6f}, false, 2, {-0.03f, 0.14f, 0.05f}, {-0.03f, 0.10f, 0.05f}, 0.9f},
        {{0.0f, -0.1f, 1.0f}, true, 1, {0.0f, 0.0f, 0.12f}, {0.0f, 0.0f, 0.12f}, 0.8f},
    };
    std::vector<std::vector<uint32_t>> places; // found on the sphere, before anything is pulled
    for (const Limb& limb : limbs)
        places.push_back(facesAt(cage, limb.at, limb.block, among));
    for (glm::vec3& p : cage.positions)
        p *= glm::vec3(0.9f, 0.65f, 1.1f);
    for (size_t i = 0; i < std::size(limbs); ++i) {
        const Limb& limb = limbs[i];
        for (uint32_t s = 0; s < limb.segments; ++s) {
            const float t = limb.segments < 2 ? 0.0f : static_cast<float>(s) / static_cast<float>(limb.segments - 1);
            extrude(cage, places[i], glm::mix(limb.first, limb.last, t), limb.scale);
        }
    }
    dropUnused(cage);
    finish(cage);
    return cage;
}

Cage makeRow(const Cage& cage, uint32_t count) {
    glm::vec3 low = cage.positions.front(), high = low;
    for (const glm::vec3& p : cage.positions)
        low = glm::min(low, p), high = glm::max(high, p);
    Cage all = emptyCage();
    for (uint32_t i = 0; i < count; ++i)
        append(all, cage, glm::vec3(1.1f * (high.x - low.x) * static_cast<float>(i), 0.0f, 0.0f));
    finish(all);
    return all;
}

} // namespace supple::cage
