#include "cage/repair/folds.h"

#include "cage/repair/fans.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace supple::cage::repair {
namespace {

/// A vertex of more corners is not searched for an edge.
constexpr uint32_t kMaxSearchedCorners = 1024;

using Ends = std::pair<uint32_t, uint32_t>; ///< smaller vertex first

/// What is sharp, by vertices of the given cage.
class Sharpness {
public:
    Sharpness(const Cage& cage, const Draft& draft) {
        for (const auto* creases : {&cage.creases, &draft.creases}) {
            for (const Crease& crease : *creases) {
                edges_.emplace_back(Ends(std::minmax(crease.a, crease.b)), crease.sharpness);
            }
        }
        for (const CreaseScalar& scalar : cage.creaseScalars) {
            fixed_.push_back(std::minmax(scalar.vertex, scalar.toward));
        }
        for (const auto* vertices : {&cage.sharpVertices, &draft.sharpVertices}) {
            for (const SharpVertex& sharp : *vertices) {
                if (sharp.sharpness > 0.0f) {
                    fixed_.emplace_back(sharp.vertex, sharp.vertex);
                }
            }
        }
        std::sort(edges_.begin(), edges_.end());
        std::sort(fixed_.begin(), fixed_.end());
    }
    /// The sharpest crease along an edge, 0 if there is none.
    [[nodiscard]] float ofEdge(uint32_t a, uint32_t b) const {
        const Ends ends = std::minmax(a, b);
        const auto behind = std::upper_bound(edges_.begin(), edges_.end(), ends,
                                             [](const Ends& x, const auto& edge) { return x < edge.first; });
        const bool found = behind != edges_.begin() && std::prev(behind)->first == ends;
        return found ? std::max(std::prev(behind)->second, 0.0f) : 0.0f;
    }
    /// Whether an edge has a crease scalar, or a vertex (a = b) is sharp.
    [[nodiscard]] bool isFixed(uint32_t a, uint32_t b) const {
        return std::binary_search(fixed_.begin(), fixed_.end(), Ends(std::minmax(a, b)));
    }

private:
    std::vector<std::pair<Ends, float>> edges_;
    std::vector<Ends> fixed_;
};

/// Works on every face at most once: what the first fold at it leaves is for the next round.
class FoldRound {
public:
    FoldRound(const Cage& cage, const Sharpness& sharpness, Draft& draft, const std::vector<uint32_t>& twins,
              const Places& places, FoldDamage& damage)
        : cage_(cage), sharpness_(sharpness), draft_(draft), twins_(twins), places_(places), damage_(damage),
          faces_(cornerFaces(draft)), of_(vertexCorners(draft)), changed_(draft.faceCount(), 0),
          parts_(draft.faceCount()), marks_(draft.vertexCount(), kNone) {}

    /// Returns whether there was a fold. Those of the first round count as damage; the last one cuts all open.
    bool run(bool first, bool last) {
        const uint32_t vertexCount = draft_.vertexCount();
        bool any = false;
        for (uint32_t v = 0; v < vertexCount; ++v) {
            if (!isFold(v)) {
                continue;
            }
            any = true;
            const uint32_t c = of_.corners[of_.starts[v]];
            const uint32_t d = of_.corners[of_.starts[v] + 1];
            if (first) {
                damage_.folds.add(places_, draft_.faces[faces_[c]], [&] {
                    return places_.vertex(draft_.corners[c]) + " between faces " +
                           places_.number(draft_.faces[faces_[c]]) + " and " + places_.number(draft_.faces[faces_[d]]);
                });
            }
            if (last) {
                cutOpen(d);
            } else if (changed_[faces_[c]] == 0 && changed_[faces_[d]] == 0) {
                changed_[faces_[c]] = changed_[faces_[d]] = 1;
                treat(c, d);
            }
        }
        if (any) {
            rebuild();
        }
        return any;
    }

    /// Whether the round has cut faces apart.
    [[nodiscard]] bool cutAny() const { return cutAny_; }

private:
    /// What two faces have in common round a fold: from the corner `begin` of the first face on to its corner `end`,
    /// and so in the second one, against its direction.
    struct Path {
        uint32_t face, other;
        uint32_t begin, end;
        uint32_t otherBegin, otherEnd; ///< corners of the other face at the same vertices as begin and end
        bool closed = false;           ///< all of both faces
        bool fixed = false;            ///< has a crease scalar or a sharp vertex
        float sharpest = 0.0f;         ///< of the creases along it
        float smoothest = kHardSharpness;
    };

    [[nodiscard]] uint32_t next(uint32_t corner) const { return draft_.next(faces_[corner], corner); }
    [[nodiscard]] uint32_t previous(uint32_t corner) const { return draft_.previous(faces_[corner], corner); }
    [[nodiscard]] uint32_t source(uint32_t corner) const { return draft_.sources[draft_.vertices[corner]]; }

    [[nodiscard]] bool isFold(uint32_t v) const {
        if (of_.count(v) != 2) {
            return false;
        }
        const uint32_t c = of_.corners[of_.starts[v]];
        const uint32_t d = of_.corners[of_.starts[v] + 1];
        return twins_[c] != kNone && next(twins_[c]) == d && twins_[d] != kNone && next(twins_[d]) == c;
    }

    /// Takes in the edge that begins at a corner of the path, and the corner's vertex if it is a fold.
    void addSharpness(Path& path, uint32_t corner) const {
        const uint32_t a = source(corner);
        const uint32_t b = source(next(corner));
        path.fixed =
            path.fixed || sharpness_.isFixed(a, b) || (isFold(draft_.vertices[corner]) && sharpness_.isFixed(a, a));
        path.sharpest = std::max(path.sharpest, sharpness_.ofEdge(a, b));
        path.smoothest = std::min(path.smoothest, sharpness_.ofEdge(a, b));
    }

    [[nodiscard]] Path pathThrough(uint32_t c, uint32_t d) const {
        Path path{faces_[c], faces_[d], c, c, d, d};
        do {
            addSharpness(path, path.end);
            path.end = next(path.end);
            path.otherEnd = previous(path.otherEnd);
            path.closed = path.end == c;
        } while (!path.closed && isFold(draft_.vertices[path.end]));
        do {
            path.begin = previous(path.begin);
            path.otherBegin = next(path.otherBegin);
            addSharpness(path, path.begin);
        } while (!path.closed && isFold(draft_.vertices[path.begin]));
        return path;
    }

    void treat(uint32_t c, uint32_t d) {
        const Path path = pathThrough(c, d);
        const bool smooth = !path.fixed && path.sharpest == 0.0f;
        const bool creased = !path.fixed && path.smoothest > 0.0f;
        // NOLINTBEGIN(bugprone-branch-clone): what is tried, in this order
        if (path.closed) {
            parts_[path.face] = cornersOf(path.face); // the other face is its back
            ++damage_.dissolved[partOf(path.face)];
        } else if (bends(path) && canCutFace(c, d)) {
            cutFace(c, d);
        } else if (smooth && staysSmall(path) && sameAttributes(path) && mergedIsSimple(path)) {
            merge(path);
        } else if ((smooth || creased) && canRunPast(path)) {
            runPast(path);
        } else if (smooth && sameAttributes(path) && mergedIsSimple(path)) {
            merge(path);
        } else if (canCutFace(c, d)) {
            cutFace(c, d);
        } else {
            cutOpen(d);
        }
        // NOLINTEND(bugprone-branch-clone)
    }

    [[nodiscard]] size_t partOf(uint32_t face) const { return places_.partOf(draft_.faces[face]); }
    [[nodiscard]] const glm::vec3& position(uint32_t corner) const { return cage_.positions[source(corner)]; }

    /// Whether what the faces have in common is far from straight.
    [[nodiscard]] bool bends(const Path& path) const {
        const glm::vec3 along = position(path.end) - position(path.begin);
        const float length = glm::length(along);
        for (uint32_t c = next(path.begin); c != path.end; c = next(c)) {
            const glm::vec3 to = position(c) - position(path.begin);
            const float place = length > 0.0f ? std::clamp(glm::dot(to, along) / (length * length), 0.0f, 1.0f) : 0.0f;
            if (glm::length(to - place * along) > kMostBend * length) {
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] bool canCutFace(uint32_t c, uint32_t d) const {
        return std::max(draft_.sides(faces_[c]), draft_.sides(faces_[d])) >= 4;
    }
    /// Cuts a triangle off the face of more corners, by the shorter of the two edges from the fold that do so.
    void cutFace(uint32_t c, uint32_t d) {
        const uint32_t corner = draft_.sides(faces_[d]) > draft_.sides(faces_[c]) ? d : c;
        const uint32_t face = faces_[corner];
        const uint32_t ahead = next(next(corner)), behind = previous(previous(corner));
        const bool isAhead =
            glm::distance(position(ahead), position(corner)) <= glm::distance(position(behind), position(corner));
        parts_[face] = isAhead ? stretch(corner, ahead) : stretch(behind, corner);
        seconds_[face] = isAhead ? stretch(ahead, corner) : stretch(corner, behind);
        const uint32_t other = faces_[corner == c ? d : c];
        parts_[other] = cornersOf(other);
        ++damage_.kept[partOf(face)];
    }

    /// Whether the two faces make at most a quad, and nothing becomes a fold.
    [[nodiscard]] bool staysSmall(const Path& path) const {
        const auto sides = stretch(path.end, path.begin).size() + stretch(path.otherBegin, path.otherEnd).size() - 2;
        return sides <= 4 && !wouldFold(draft_.vertices[path.begin]) && !wouldFold(draft_.vertices[path.end]);
    }
    /// Whether a vertex has two faces if it loses one, and no boundary.
    [[nodiscard]] bool wouldFold(uint32_t v) const {
        const auto first = of_.corners.begin() + of_.starts[v];
        return of_.count(v) <= 3 &&
               std::all_of(first, first + of_.count(v), [&](uint32_t c) { return twins_[c] != kNone; });
    }

    [[nodiscard]] bool sameAttributes(const Path& path) const {
        const uint32_t f = draft_.faces[path.face];
        const uint32_t g = draft_.faces[path.other];
        const auto same = [&](const std::vector<uint32_t>& values) { return values.empty() || values[f] == values[g]; };
        const auto isHole = [&](uint32_t face) {
            return std::binary_search(cage_.holes.begin(), cage_.holes.end(), face);
        };
        return same(cage_.faceParts) && same(cage_.faceMaterials) && same(cage_.faceTrimTiles) &&
               isHole(f) == isHole(g);
    }

    /// The corners of a face from one to another, both included.
    [[nodiscard]] std::vector<uint32_t> stretch(uint32_t from, uint32_t to) const {
        std::vector<uint32_t> corners{from};
        while (corners.back() != to) {
            corners.push_back(next(corners.back()));
        }
        return corners;
    }
    [[nodiscard]] std::vector<uint32_t> cornersOf(uint32_t face) const {
        return stretch(draft_.starts[face], draft_.starts[face + 1] - 1);
    }

    bool mergedIsSimple(const Path& path) {
        for (const uint32_t c : stretch(path.end, path.begin)) {
            marks_[draft_.vertices[c]] = path.face;
        }
        const std::vector<uint32_t> others = stretch(path.otherBegin, path.otherEnd);
        return std::none_of(others.begin() + 1, others.end() - 1,
                            [&](uint32_t c) { return marks_[draft_.vertices[c]] == path.face; });
    }

    void merge(const Path& path) {
        ++damage_.dissolved[partOf(path.face)];
        std::vector<uint32_t>& merged = parts_[path.face];
        merged = stretch(path.end, path.begin);
        const std::vector<uint32_t> others = stretch(path.otherBegin, path.otherEnd);
        merged.insert(merged.end(), others.begin() + 1, others.end() - 1);
    }

    bool canRunPast(const Path& path) {
        if (next(path.end) == path.begin || next(path.otherBegin) == path.otherEnd) {
            return false;
        }
        uint32_t a = draft_.vertices[path.begin];
        uint32_t b = draft_.vertices[path.end];
        if (of_.count(b) < of_.count(a)) {
            std::swap(a, b);
        }
        if (of_.count(a) > kMaxSearchedCorners) {
            return false;
        }
        for (uint32_t i = of_.starts[a]; i < of_.starts[a + 1]; ++i) {
            const uint32_t c = of_.corners[i];
            if (draft_.vertices[next(c)] == b || draft_.vertices[previous(c)] == b) {
                return false;
            }
        }
        return newEdges_.insert(std::minmax(a, b)).second;
    }

    void runPast(const Path& path) {
        ++damage_.dissolved[partOf(path.face)];
        parts_[path.face] = stretch(path.end, path.begin);
        parts_[path.other] = stretch(path.otherBegin, path.otherEnd);
        if (path.sharpest > 0.0f) {
            draft_.creases.push_back({source(path.begin), source(path.end), path.sharpest});
        }
    }

    void cutOpen(uint32_t corner) {
        draft_.vertices[corner] = draft_.copyVertex(draft_.vertices[corner]);
        ++damage_.cutOpen[partOf(faces_[corner])];
        cutAny_ = true;
        for (const uint32_t face : {faces_[corner], faces_[twins_[corner]]}) {
            changed_[face] = 1;
            if (parts_[face].empty()) {
                parts_[face] = cornersOf(face);
            }
        }
    }

    void rebuild() {
        Draft after;
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            if (changed_[f] == 0) {
                parts_[f] = cornersOf(f);
            }
            for (const uint32_t c : parts_[f]) {
                after.addCorner(draft_.vertices[c], draft_.corners[c]);
            }
            if (!parts_[f].empty()) {
                after.closeFace(draft_.faces[f]);
            }
            const auto second = seconds_.find(f);
            if (second != seconds_.end()) {
                for (const uint32_t c : second->second) {
                    after.addCorner(draft_.vertices[c], draft_.corners[c]);
                }
                after.closeFace(draft_.faces[f]);
            }
        }
        after.sources = std::move(draft_.sources);
        after.creases = std::move(draft_.creases);
        after.sharpVertices = std::move(draft_.sharpVertices);
        draft_ = std::move(after);
    }

    const Cage& cage_;
    const Sharpness& sharpness_;
    Draft& draft_;
    const std::vector<uint32_t>& twins_;
    const Places& places_;
    FoldDamage& damage_;
    bool cutAny_ = false;
    const std::vector<uint32_t> faces_; ///< per corner
    const VertexCorners of_;
    std::vector<uint8_t> changed_;                      ///< per face
    std::vector<std::vector<uint32_t>> parts_;          ///< per changed face: its corners now, empty if it is gone
    std::map<uint32_t, std::vector<uint32_t>> seconds_; ///< per face that is cut: its second part
    std::vector<uint32_t> marks_;                       ///< per vertex: the face at work that has it
    std::set<Ends> newEdges_;
};

} // namespace

void dissolveFolds(const Cage& cage, Draft& draft, std::vector<uint32_t> twins, const Places& places,
                   FoldDamage& damage) {
    for (int round = 1; round <= kMaxFoldRounds; ++round) {
        const Sharpness sharpness(cage, draft);
        FoldRound atWork(cage, sharpness, draft, twins, places, damage);
        if (!atWork.run(round == 1, round == kMaxFoldRounds)) {
            return;
        }
        const bool cutAny = atWork.cutAny();
        twins = matchSides(draft);
        if (cutAny) {
            FanDamage ofCuts;
            separateFans(draft, twins, {}, places, ofCuts);
        }
    }
}

} // namespace supple::cage::repair
