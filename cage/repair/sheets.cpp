#include "cage/repair/sheets.h"

#include "cage/message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace supple::cage::repair {
namespace {

/// Sets of joined faces, and for every face whether it is turned against the representative of its set.
class Pieces {
public:
    explicit Pieces(size_t count) : parents_(count), turned_(count, 0), sizes_(count, 1) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }

    struct Place {
        uint32_t root = 0;
        uint8_t turned = 0;
    };
    Place find(uint32_t face) {
        uint32_t root = face;
        uint8_t turned = 0;
        while (parents_[root] != root) {
            turned ^= turned_[root];
            root = parents_[root];
        }
        const Place place{root, turned};
        while (parents_[face] != root && face != root) {
            const uint32_t parent = std::exchange(parents_[face], root);
            const uint8_t own = std::exchange(turned_[face], turned);
            turned ^= own;
            face = parent;
        }
        return place;
    }
    /// Joins two faces, one of which must be turned if `against`. False if they are joined already and do not fit.
    bool join(uint32_t f, uint32_t g, bool against) {
        Place a = find(f);
        Place b = find(g);
        const auto turned = static_cast<uint8_t>(a.turned ^ b.turned ^ (against ? 1 : 0));
        if (a.root == b.root) {
            return turned == 0;
        }
        if (sizes_[a.root] < sizes_[b.root]) {
            std::swap(a, b);
        }
        parents_[b.root] = a.root;
        turned_[b.root] = turned;
        sizes_[a.root] += sizes_[b.root];
        return true;
    }

private:
    std::vector<uint32_t> parents_;
    std::vector<uint8_t> turned_; ///< against the parent
    std::vector<uint32_t> sizes_;
};

class Joiner {
public:
    Joiner(const Cage& cage, Draft& draft, const Places& places, SheetDamage& damage)
        : draft_(draft), places_(places), damage_(damage), sides_(sortedSides(draft)), pieces_(draft.faceCount()),
          turned_(draft.faceCount(), 0), twins_(draft.cornerCount(), kNone) {
        damage_.atCut.assign(draft.vertexCount(), 0);
        for (uint32_t f = 0; f < draft.faceCount(); ++f) {
            normals_.push_back(areaOf(cage, f));
        }
    }

    std::vector<uint32_t> run() {
        sortEdges();
        pinEnds();
        joinPairs();
        settle();
        for (const Edge& edge : crowded_) {
            joinFitting(edge);
        }
        for (const Edge& edge : crowded_) {
            joinTurned(edge);
        }
        settle();
        return turnFaces();
    }

private:
    using Edge = std::span<const Side>;

    /// Normal of a face, as long as twice its area.
    [[nodiscard]] glm::dvec3 areaOf(const Cage& cage, uint32_t face) const {
        const auto position = [&](uint32_t c) { return glm::dvec3(cage.positions[draft_.vertices[c]]); };
        const glm::dvec3 origin = position(draft_.starts[face]);
        glm::dvec3 area(0.0);
        for (uint32_t c = draft_.starts[face] + 1; c + 1 < draft_.starts[face + 1]; ++c) {
            area += glm::cross(position(c) - origin, position(c + 1) - origin);
        }
        return area;
    }

    void sortEdges() {
        for (size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
            while (end < sides_.size() && sides_[end].sameEdge(sides_[begin])) {
                ++end;
            }
            const Edge edge = Edge(sides_).subspan(begin, end - begin);
            if (edge.size() == 2) {
                pairs_.push_back(edge);
            } else if (edge.size() > 2) {
                crowded_.push_back(edge);
                cutAt(edge);
                draft_.creases.push_back({edge[0].low, edge[0].high, kHardSharpness});
                damage_.crowded.add(places_, draft_.faces[edge[0].face], [&] { return nameWithFaces(edge); });
            }
        }
    }

    /// Where crowded edges end or branch, no curve runs on: the sheets stay together in the vertex.
    void pinEnds() {
        std::vector<uint32_t> ends;
        for (const Edge& edge : crowded_) {
            ends.insert(ends.end(), {edge[0].low, edge[0].high});
        }
        std::sort(ends.begin(), ends.end());
        for (size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
            while (end < ends.size() && ends[end] == ends[begin]) {
                ++end;
            }
            if (end - begin != 2) {
                draft_.sharpVertices.push_back({ends[begin], kHardSharpness});
            }
        }
    }

    [[nodiscard]] std::string nameOf(const Edge& edge) const {
        const Side& side = edge[0];
        return places_.edge(draft_.corners[side.corner], draft_.corners[draft_.next(side.face, side.corner)]);
    }

    [[nodiscard]] std::string nameWithFaces(const Edge& edge) const {
        std::string name = nameOf(edge) + " of faces ";
        for (size_t i = 0; i < std::min(edge.size(), kMaxListedFaces); ++i) {
            name += (i > 0 ? ", " : "") + places_.number(draft_.faces[edge[i].face]);
        }
        return name + (edge.size() > kMaxListedFaces ? ", ..." : "");
    }

    void cutAt(const Edge& edge) {
        damage_.atCut[edge[0].low] = 1;
        damage_.atCut[edge[0].high] = 1;
    }

    void join(const Side& a, const Side& b) {
        twins_[a.corner] = b.corner;
        twins_[b.corner] = a.corner;
    }

    /// Those that fit as they are come first: so the fewest faces are turned, and what cannot fit is cut where it does
    /// not.
    void joinPairs() {
        for (const bool against : {false, true}) {
            for (const Edge& edge : pairs_) {
                if ((edge[0].forward == edge[1].forward) != against) {
                    continue;
                }
                if (pieces_.join(edge[0].face, edge[1].face, against)) {
                    join(edge[0], edge[1]);
                } else {
                    cutAt(edge);
                    damage_.unorientable.add(places_, draft_.faces[edge[0].face], [&] { return nameOf(edge); });
                }
            }
        }
    }

    /// Chooses which faces of every piece are turned.
    void settle() {
        struct Half {
            double area = 0.0;
            uint32_t lowest = kNone;
        };
        std::vector<std::array<Half, 2>> halves(draft_.faceCount());
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            const Pieces::Place place = pieces_.find(f);
            Half& half = halves[place.root][place.turned];
            half.area += glm::length(normals_[f]);
            half.lowest = std::min(half.lowest, f);
        }
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            const Pieces::Place place = pieces_.find(f);
            const auto& [as, turned] = halves[place.root];
            const bool keepsTurned = as.area != turned.area ? turned.area > as.area : turned.lowest < as.lowest;
            turned_[f] = place.turned ^ (keepsTurned ? 1 : 0);
        }
    }

    [[nodiscard]] bool runsForward(const Side& side) const { return side.forward != (turned_[side.face] != 0); }

    /// How far the surface bends from one face to the other, in steps so coarse that rounding does not decide. The
    /// faces are as settled; `against`: but for one of them.
    [[nodiscard]] int64_t bend(uint32_t f, uint32_t g, bool against) const {
        constexpr double kSteps = 1 << 20;
        const double lengths = glm::length(normals_[f]) * glm::length(normals_[g]);
        if (!(lengths > 0.0)) {
            return static_cast<int64_t>(2.0 * kSteps) + 1; // a face without area comes last
        }
        const double cosine = glm::dot(normals_[f], normals_[g]) / lengths;
        const bool opposite = (turned_[f] != turned_[g]) != against;
        return std::llround(kSteps * (1.0 + (opposite ? cosine : -cosine)));
    }

    struct Candidate {
        int64_t bend = 0;
        const Side* first = nullptr;
        const Side* second = nullptr;
    };
    [[nodiscard]] std::vector<Candidate> candidates(const Edge& edge, bool against) const {
        std::vector<Candidate> found;
        for (size_t i = 0; i < edge.size(); ++i) {
            for (size_t j = i + 1; j < edge.size(); ++j) {
                const bool open = twins_[edge[i].corner] == kNone && twins_[edge[j].corner] == kNone;
                if (open && (runsForward(edge[i]) == runsForward(edge[j])) == against) {
                    found.push_back({bend(edge[i].face, edge[j].face, against), &edge[i], &edge[j]});
                }
            }
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const Candidate& x, const Candidate& y) { return x.bend < y.bend; });
        return found;
    }

    void joinBest(const Edge& edge, bool against) {
        for (const Candidate& candidate : candidates(edge, against)) {
            const Side& a = *candidate.first;
            const Side& b = *candidate.second;
            if (twins_[a.corner] == kNone && twins_[b.corner] == kNone &&
                pieces_.join(a.face, b.face, a.forward == b.forward)) {
                join(a, b);
            }
        }
    }

    void joinFitting(const Edge& edge) {
        if (edge.size() <= kMaxWeighedFaces) {
            joinBest(edge, false);
            return;
        }
        std::vector<const Side*> waiting[2];
        for (const Side& side : edge) {
            waiting[runsForward(side) ? 1 : 0].push_back(&side);
        }
        for (size_t i = 0; i < std::min(waiting[0].size(), waiting[1].size()); ++i) {
            if (pieces_.join(waiting[0][i]->face, waiting[1][i]->face,
                             waiting[0][i]->forward == waiting[1][i]->forward)) {
                join(*waiting[0][i], *waiting[1][i]);
            }
        }
    }

    void joinTurned(const Edge& edge) {
        if (edge.size() <= kMaxWeighedFaces) {
            joinBest(edge, true);
        }
    }

    /// Reverses the corners of faces behind the first one, and their twins with them.
    std::vector<uint32_t> turnFaces() {
        std::vector<uint32_t> places(draft_.cornerCount()); // per side: the corner that it begins at afterwards
        std::iota(places.begin(), places.end(), 0u);
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            if (turned_[f] == 0) {
                continue;
            }
            damage_.turned.add(places_, draft_.faces[f], [&] { return places_.face(draft_.faces[f]); });
            const uint32_t first = draft_.starts[f];
            const uint32_t sides = draft_.sides(f);
            for (uint32_t k = 0; k < sides; ++k) {
                places[first + k] = first + (sides - (k + 1) % sides) % sides;
            }
            std::reverse(draft_.vertices.begin() + first + 1, draft_.vertices.begin() + first + sides);
            std::reverse(draft_.corners.begin() + first + 1, draft_.corners.begin() + first + sides);
        }
        std::vector<uint32_t> twins(twins_.size(), kNone);
        for (uint32_t c = 0; c < twins_.size(); ++c) {
            twins[places[c]] = twins_[c] == kNone ? kNone : places[twins_[c]];
        }
        return twins;
    }

    Draft& draft_;
    const Places& places_;
    SheetDamage& damage_;
    const std::vector<Side> sides_;
    std::vector<Edge> pairs_;
    std::vector<Edge> crowded_;
    Pieces pieces_;
    std::vector<glm::dvec3> normals_; ///< per face
    std::vector<uint8_t> turned_;     ///< per face, as settled
    std::vector<uint32_t> twins_;
};

} // namespace

std::vector<uint32_t> joinFaces(const Cage& cage, Draft& draft, const Places& places, SheetDamage& damage) {
    return Joiner(cage, draft, places, damage).run();
}

} // namespace supple::cage::repair
