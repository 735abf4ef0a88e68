#include "cage/repair/faces.h"

#include "cage/repair/rings.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace supple::cage::repair {
namespace {

/// Cuts faces where they pass a vertex again: what lies between the two passages is a loop of its own.
class LoopCutter {
public:
    LoopCutter(const Cage& cage, Draft& draft) : cage_(cage), draft_(draft), places_(cage.vertexCount(), kNone) {}

    [[nodiscard]] bool passesTwice(uint32_t face) {
        bool twice = false;
        for (uint32_t c = cage_.faceStarts[face]; c < cage_.faceStarts[face + 1]; ++c) {
            uint32_t& place = places_[cage_.faceVertices[c]];
            twice = twice || place != kNone;
            place = 0;
        }
        for (uint32_t c = cage_.faceStarts[face]; c < cage_.faceStarts[face + 1]; ++c) {
            places_[cage_.faceVertices[c]] = kNone;
        }
        return twice;
    }

    /// Adds the face's simple loops; returns whether the face passed a vertex twice.
    bool add(uint32_t face) {
        bool repeated = false;
        for (uint32_t c = cage_.faceStarts[face]; c < cage_.faceStarts[face + 1]; ++c) {
            const uint32_t vertex = cage_.faceVertices[c];
            if (places_[vertex] != kNone) {
                repeated = true;
                takeFrom(places_[vertex], face);
            }
            places_[vertex] = static_cast<uint32_t>(open_.size());
            open_.push_back(c);
        }
        takeFrom(0, face);
        return repeated;
    }

private:
    /// Ends the loop that begins at this place of the open one.
    void takeFrom(size_t first, uint32_t face) {
        const bool bounds = open_.size() - first >= 3;
        for (size_t i = first; i < open_.size(); ++i) {
            const uint32_t vertex = cage_.faceVertices[open_[i]];
            places_[vertex] = kNone;
            if (bounds) {
                draft_.addCorner(vertex, open_[i]);
            }
        }
        if (bounds) {
            draft_.closeFace(face);
        }
        open_.resize(first);
    }

    const Cage& cage_;
    Draft& draft_;
    std::vector<uint32_t> open_;   ///< corners
    std::vector<uint32_t> places_; ///< per vertex: in open_
};

/// Each face's vertices from the smallest one on, towards the smaller of its two neighbors.
std::vector<uint32_t> canonicalFaces(const Draft& draft) {
    std::vector<uint32_t> canonical;
    canonical.reserve(draft.cornerCount());
    for (uint32_t f = 0; f < draft.faceCount(); ++f) {
        const uint32_t sides = draft.sides(f);
        const uint32_t* face = draft.vertices.data() + draft.starts[f];
        const auto first = static_cast<uint32_t>(std::min_element(face, face + sides) - face);
        const bool forward = face[(first + 1) % sides] < face[(first + sides - 1) % sides];
        for (uint32_t k = 0; k < sides; ++k) {
            canonical.push_back(face[(forward ? first + k : first + sides - k) % sides]);
        }
    }
    return canonical;
}

} // namespace

Draft simpleFaces(const Cage& cage, const Places& places, FaceDamage& damage) {
    Draft draft;
    draft.sources.resize(cage.vertexCount());
    std::iota(draft.sources.begin(), draft.sources.end(), 0u);
    LoopCutter cutter(cage, draft);
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t before = draft.faceCount();
        const auto name = [&] { return places.face(face); };
        if (cutter.passesTwice(face) && addRing(cage, face, draft)) {
            damage.ringed.add(places, face, name);
            continue;
        }
        const bool repeated = cutter.add(face);
        if (draft.faceCount() == before) {
            damage.empty.add(places, face, name);
        } else if (repeated) {
            damage.repeating.add(places, face, name);
        }
    }
    return draft;
}

Draft withoutDuplicates(Draft draft, const Places& places, FaceDamage& damage) {
    const std::vector<uint32_t> canonical = canonicalFaces(draft);
    const auto begin = [&](uint32_t f) { return canonical.begin() + draft.starts[f]; };
    const auto end = [&](uint32_t f) { return canonical.begin() + draft.starts[f + 1]; };
    std::vector<uint32_t> order(draft.faceCount());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t f, uint32_t g) {
        if (draft.sides(f) != draft.sides(g)) {
            return draft.sides(f) < draft.sides(g);
        }
        const auto [x, y] = std::mismatch(begin(f), end(f), begin(g));
        return x != end(f) ? *x < *y : f < g;
    });
    std::vector<uint32_t> firsts(draft.faceCount()); // per face: the first one that is the same
    std::iota(firsts.begin(), firsts.end(), 0u);
    for (size_t i = 1; i < order.size(); ++i) {
        const uint32_t f = order[i - 1];
        const uint32_t g = order[i];
        if (draft.sides(f) == draft.sides(g) && std::equal(begin(f), end(f), begin(g))) {
            firsts[g] = firsts[f];
        }
    }
    Draft kept;
    for (uint32_t f = 0; f < draft.faceCount(); ++f) {
        if (firsts[f] != f) {
            damage.duplicated.add(places, draft.faces[f], [&] {
                return places.face(draft.faces[f]) + " is " + places.face(draft.faces[firsts[f]]) + " again";
            });
            continue;
        }
        for (uint32_t c = draft.starts[f]; c < draft.starts[f + 1]; ++c) {
            kept.addCorner(draft.vertices[c], draft.corners[c]);
        }
        kept.closeFace(draft.faces[f]);
    }
    kept.sources = std::move(draft.sources);
    return kept;
}

} // namespace supple::cage::repair
