#include "cage/sew.h"

#include "cage/message.h"
#include "cage/polygons.h"
#include "cage/sharp_features.h"
#include "cage/sound_faces.h"
#include "cage/vertex_weights.h"
#include "cage/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace supple::cage {
namespace {

/// Per cage vertex: whether it lies on an edge that has one face.
std::vector<uint8_t> boundaryVertices(const Polygons& faces, size_t vertexCount) {
    std::vector<std::pair<uint32_t, uint32_t>> edges;
    edges.reserve(faces.vertices.size());
    for (size_t f = 0; f < faces.faceCount(); ++f) {
        for (uint32_t c = faces.starts[f]; c < faces.starts[f + 1]; ++c) {
            const uint32_t next = c + 1 < faces.starts[f + 1] ? c + 1 : faces.starts[f];
            edges.push_back(std::minmax(faces.vertices[c], faces.vertices[next]));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<uint8_t> boundary(vertexCount, 0);
    for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin]) {
            ++end;
        }
        if (end - begin == 1) {
            boundary[edges[begin].first] = boundary[edges[begin].second] = 1;
        }
    }
    return boundary;
}

std::vector<uint32_t> partsOfVertices(const Character& character) {
    const Cage& cage = character.cage;
    std::vector<uint32_t> parts(cage.vertexCount(), 0);
    for (uint32_t p = 0; p < character.parts.size(); ++p) {
        const uint32_t begin = cage.faceStarts[character.parts[p].firstFace];
        const uint32_t end = cage.faceStarts[endFace(character, p)];
        for (uint32_t c = begin; c < end; ++c) {
            parts[cage.faceVertices[c]] = p;
        }
    }
    return parts;
}

/// The displacements of each vertex, by target.
struct Displacements {
    std::vector<uint32_t> starts;
    std::vector<std::pair<uint32_t, glm::vec3>> deltas;

    explicit Displacements(const Character& character) : starts(character.cage.vertexCount() + size_t{1}, 0) {
        for (const MorphTarget& target : character.morphs.targets) {
            for (const uint32_t v : target.vertices) {
                ++starts[v + 1];
            }
        }
        for (size_t v = 1; v < starts.size(); ++v) {
            starts[v] += starts[v - 1];
        }
        deltas.resize(starts.back());
        std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
        for (uint32_t t = 0; t < character.morphs.targets.size(); ++t) {
            const MorphTarget& target = character.morphs.targets[t];
            for (size_t i = 0; i < target.vertices.size(); ++i) {
                deltas[next[target.vertices[i]]++] = {t, target.deltas[i]};
            }
        }
    }
    [[nodiscard]] std::span<const std::pair<uint32_t, glm::vec3>> of(uint32_t v) const {
        return std::span(deltas).subspan(starts[v], starts[v + 1] - starts[v]);
    }
};

/// An order of vertices in which those that agree in position, skin and morph targets are equal. -0 is 0.
class Agreement {
public:
    Agreement(const Character& character, std::span<const glm::vec3> positions)
        : character_(&character), positions_(positions), displacements_(character) {}

    [[nodiscard]] int compare(uint32_t a, uint32_t b) const {
        if (const int order = compareVectors(positions_[a], positions_[b]); order != 0) {
            return order;
        }
        const auto skinOf = [&](uint32_t v) {
            const auto& starts = character_->weights.starts;
            return std::span(character_->weights.influences).subspan(starts[v], starts[v + 1] - starts[v]);
        };
        const auto x = skinOf(a), y = skinOf(b);
        if (x.size() != y.size()) {
            return x.size() < y.size() ? -1 : 1;
        }
        for (size_t i = 0; i < x.size(); ++i) {
            if (std::tie(x[i].joint, x[i].weight) != std::tie(y[i].joint, y[i].weight)) {
                return std::tie(x[i].joint, x[i].weight) < std::tie(y[i].joint, y[i].weight) ? -1 : 1;
            }
        }
        return compareMorphs(a, b);
    }

private:
    [[nodiscard]] static int compareVectors(const glm::vec3& a, const glm::vec3& b) {
        const auto order = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
        return order(a) < order(b) ? -1 : order(b) < order(a) ? 1 : 0;
    }
    [[nodiscard]] int compareMorphs(uint32_t a, uint32_t b) const {
        const auto x = displacements_.of(a), y = displacements_.of(b);
        if (x.size() != y.size()) {
            return x.size() < y.size() ? -1 : 1;
        }
        for (size_t i = 0; i < x.size(); ++i) {
            if (x[i].first != y[i].first) {
                return x[i].first < y[i].first ? -1 : 1;
            }
            if (const int order = compareVectors(x[i].second, y[i].second); order != 0) {
                return order;
            }
        }
        return 0;
    }

    const Character* character_;
    std::span<const glm::vec3> positions_;
    Displacements displacements_;
};

/// Positions on boundaries, with those replaced that are an earlier part's but for rounding to grids.
class Alignment {
public:
    Alignment(std::span<const glm::vec3> positions, std::span<const uint32_t> parts, std::span<const float> gridSteps)
        : positions_(positions), parts_(parts), gridSteps_(gridSteps),
          cell_(gridSteps.empty() ? 0.0f : 1.01f * *std::max_element(gridSteps.begin(), gridSteps.end())) {}

    [[nodiscard]] std::vector<glm::vec3> aligned(std::span<const uint8_t> boundary) {
        std::vector<glm::vec3> aligned(positions_.begin(), positions_.end());
        for (uint32_t v = 0; v < boundary.size() && cell_ > 0.0f; ++v) {
            if (boundary[v] == 0) {
                continue;
            }
            const uint32_t other = nearest(v);
            if (other != kNone) {
                aligned[v] = positions_[other];
                continue;
            }
            std::vector<uint32_t>& there = cells_[cellOf(positions_[v], 0, 0, 0)];
            if (there.size() < kMostInCell) {
                there.push_back(v);
            }
        }
        return aligned;
    }

private:
    using Cell = std::array<double, 3>;
    static constexpr size_t kMostInCell = 8; // that no file can make this quadratic

    [[nodiscard]] Cell cellOf(const glm::vec3& p, int x, int y, int z) const {
        return {std::floor(double{p.x} / cell_) + x, std::floor(double{p.y} / cell_) + y,
                std::floor(double{p.z} / cell_) + z};
    }

    /// The nearest vertex of another part whose rounding and that of this one may explain how far apart they are.
    [[nodiscard]] uint32_t nearest(uint32_t v) const {
        uint32_t found = kNone;
        float best = std::numeric_limits<float>::infinity();
        for (int i = 0; i < 27; ++i) {
            const auto cell = cells_.find(cellOf(positions_[v], i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
            for (size_t k = 0; cell != cells_.end() && k < cell->second.size(); ++k) {
                const uint32_t other = cell->second[k];
                const glm::vec3 apart = glm::abs(positions_[v] - positions_[other]);
                const float distance = std::max({apart.x, apart.y, apart.z});
                // Half a step each, and what floats round.
                const float most = 0.501f * (gridSteps_[parts_[v]] + gridSteps_[parts_[other]]);
                if (parts_[other] != parts_[v] && distance <= most && distance < best) {
                    best = distance;
                    found = other;
                }
            }
        }
        return found;
    }

    std::span<const glm::vec3> positions_;
    std::span<const uint32_t> parts_;
    std::span<const float> gridSteps_;
    float cell_;
    std::map<Cell, std::vector<uint32_t>> cells_;
};

/// Numbers the sets of vertices that may become one: on boundaries. Every other vertex is a set of its own.
std::vector<uint32_t> candidatesOf(const Character& character, std::span<const uint8_t> boundary,
                                   std::span<const glm::vec3> positions) {
    const Agreement agreement(character, positions);
    std::vector<uint32_t> order;
    for (uint32_t v = 0; v < boundary.size(); ++v) {
        if (boundary[v] != 0) {
            order.push_back(v);
        }
    }
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        const int compared = agreement.compare(a, b);
        return compared != 0 ? compared < 0 : a < b;
    });
    std::vector<uint32_t> candidates(boundary.size());
    for (uint32_t v = 0; v < candidates.size(); ++v) {
        candidates[v] = v;
    }
    for (size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && agreement.compare(order[begin], order[end]) == 0) {
            ++end;
        }
        for (size_t i = begin; i < end; ++i) {
            candidates[order[i]] = order[begin];
        }
    }
    return candidates;
}

/// Takes the vertices out that are no longer there. `roots`: per vertex the one that stands for it.
void mergeVertices(std::span<const uint32_t> roots, Character& character) {
    Cage& cage = character.cage;
    std::vector<uint32_t> places(roots.size(), kNone);
    SkinWeights weights;
    weights.starts.push_back(0);
    uint32_t kept = 0;
    for (uint32_t v = 0; v < roots.size(); ++v) {
        if (roots[v] != v) {
            continue;
        }
        places[v] = kept;
        cage.positions[kept] = cage.positions[v];
        cage.sourceVertices[kept] = cage.sourceVertices[v];
        ++kept;
        appendVertex(character.weights, v, weights);
    }
    cage.positions.resize(kept);
    cage.sourceVertices.resize(kept);
    character.weights = std::move(weights);
    const auto place = [&](uint32_t v) { return places[roots[v]]; };
    for (uint32_t& v : cage.faceVertices) {
        v = place(v);
    }
    for (MorphTarget& target : character.morphs.targets) {
        MorphTarget moved{target.name, {}, {}};
        for (size_t i = 0; i < target.vertices.size(); ++i) {
            if (roots[target.vertices[i]] == target.vertices[i]) { // the others say the same
                moved.vertices.push_back(place(target.vertices[i]));
                moved.deltas.push_back(target.deltas[i]);
            }
        }
        target = std::move(moved);
    }
    for (Crease& crease : cage.creases) {
        crease.a = place(crease.a);
        crease.b = place(crease.b);
    }
    for (SharpVertex& sharp : cage.sharpVertices) {
        sharp.vertex = place(sharp.vertex);
    }
    for (uint32_t& v : cage.roundCorners) {
        v = place(v);
    }
    for (CreaseScalar& scalar : cage.creaseScalars) {
        scalar.vertex = place(scalar.vertex);
        scalar.toward = place(scalar.toward);
    }
}

/// Both parts may have named an edge or a vertex: the sharper counts. Of crease scalars the first counts.
void mergeFeatures(Cage& cage) {
    const auto unique = [](auto& list, auto key, auto before, auto merge) {
        std::stable_sort(list.begin(), list.end(), [&](const auto& x, const auto& y) {
            return key(x) != key(y) ? key(x) < key(y) : before(x, y);
        });
        size_t kept = 0;
        for (size_t i = 0; i < list.size(); ++i) {
            if (kept > 0 && key(list[kept - 1]) == key(list[i])) {
                merge(list[i], list[kept - 1]);
            } else {
                list[kept++] = list[i];
            }
        }
        list.resize(kept);
    };
    const auto leave = [](const auto&, const auto&) {};
    const auto sharper = [](const auto& x, const auto& y) { return x.sharpness > y.sharpness; };
    unique(
        cage.creases,
        [](const Crease& c) {
            return std::minmax({c.a, c.b});
        },
        sharper, mergeCrease);
    unique(
        cage.sharpVertices, [](const SharpVertex& s) { return s.vertex; }, sharper, leave);
    unique(
        cage.creaseScalars, [](const CreaseScalar& s) { return std::pair(s.vertex, s.toward); },
        [](const CreaseScalar&, const CreaseScalar&) { return false; }, leave);
}

} // namespace

uint32_t sewParts(Character& character, std::span<const float> gridSteps) {
    if (character.parts.size() < 2) {
        return 0;
    }
    const Polygons faces = soundFaces(character.cage);
    const std::vector<uint32_t> parts = partsOfVertices(character);
    const auto partOf = [&](uint32_t face) { return parts[faces.vertices[faces.starts[face]]]; };
    const auto mayJoin = [&](uint32_t face, uint32_t other) {
        return partOf(face) != partOf(other) && !lieBackToBack(character.cage.positions, faces, face, other);
    };
    const std::vector<uint8_t> boundary = boundaryVertices(faces, character.cage.vertexCount());
    const std::vector<glm::vec3> aligned = Alignment(character.cage.positions, parts, gridSteps).aligned(boundary);
    Welding welding = weld(candidatesOf(character, boundary, aligned), faces, mayJoin);
    unweldDefects(faces, welding);
    uint32_t merged = 0;
    Found rounded;
    for (uint32_t v = 0; v < welding.roots.size(); ++v) {
        merged += welding.roots[v] != v ? 1 : 0;
        if (aligned[v] != character.cage.positions[v] && welding.roots[v] != v) {
            rounded.add([&] { return at("part", parts[v]); });
        }
    }
    if (rounded.count > 0) {
        warn(character.warnings, "parts",
             rounded.told("vertex is another part's but for the rounding of its grid",
                          "vertices are other parts' but for the rounding of their grids") +
                 "; sewn");
    }
    if (merged > 0) {
        mergeVertices(welding.roots, character);
        mergeFeatures(character.cage);
        character.seamVertexCount += merged;
    }
    return merged;
}

} // namespace supple::cage
