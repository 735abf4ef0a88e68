#include "cage/repair/remap.h"

#include "cage/sharp_features.h"
#include "cage/triangulation.h"
#include "cage/vertex_weights.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace supple::cage::repair {
namespace {

/// Which vertices of the new cage each vertex of the given one became, packed by start index.
struct Successors {
    std::vector<uint32_t> starts;
    std::vector<uint32_t> vertices; ///< rising

    [[nodiscard]] std::span<const uint32_t> of(uint32_t vertex) const {
        if (size_t{vertex} + 1 >= starts.size()) {
            return {};
        }
        return std::span(vertices).subspan(starts[vertex], starts[vertex + 1] - starts[vertex]);
    }
    [[nodiscard]] uint32_t first(uint32_t vertex) const { return of(vertex).empty() ? kNone : of(vertex).front(); }
};

using Ends = std::pair<uint32_t, uint32_t>;

class Remapper {
public:
    Remapper(const Draft& draft, Cage& cage, SkinWeights& weights, Morphs& morphs)
        : draft_(draft), cage_(cage), weights_(weights), morphs_(morphs) {}

    Status run() {
        numberVertices();
        if (Status status = checkCopies(); !status) {
            return status;
        }
        mapWeights();
        mapMorphs();
        mapFaces();
        mapVertices();
        findCopiedEdges();
        mapCreases();
        mapSharpVertices();
        mapRoundCorners();
        mapCreaseScalars();
        return success();
    }

private:
    void numberVertices() {
        numbers_.assign(draft_.vertexCount(), kNone);
        for (const uint32_t v : draft_.vertices) {
            numbers_[v] = 0;
        }
        for (uint32_t v = 0; v < draft_.vertexCount(); ++v) {
            if (numbers_[v] != kNone) {
                numbers_[v] = static_cast<uint32_t>(sources_.size());
                sources_.push_back(draft_.sources[v]);
            }
        }
        successors_.starts.assign(size_t{cage_.vertexCount()} + 1, 0);
        for (const uint32_t source : sources_) {
            ++successors_.starts[source + 1];
        }
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            successors_.starts[v + 1] += successors_.starts[v];
        }
        successors_.vertices.resize(sources_.size());
        std::vector<uint32_t> next(successors_.starts.begin(), successors_.starts.end() - 1);
        for (uint32_t v = 0; v < sources_.size(); ++v) {
            successors_.vertices[next[sources_[v]]++] = v;
        }
    }

    /// Refuses what would take much memory, before any of it is copied.
    [[nodiscard]] Status checkCopies() const {
        size_t influences = 0;
        size_t displacements = 0;
        const auto copies = [&](uint32_t vertex) {
            const size_t successors = successors_.of(vertex).size();
            return successors > 0 ? successors - 1 : 0;
        };
        for (uint32_t v = 0; v + 1 < weights_.starts.size(); ++v) {
            influences += copies(v) * (weights_.starts[v + 1] - weights_.starts[v]);
        }
        for (const MorphTarget& target : morphs_.targets) {
            for (const uint32_t vertex : target.vertices) {
                displacements += copies(vertex);
            }
        }
        if (std::max(influences, displacements) > kMaxCopiedValues) {
            return Error{ErrorCode::limit, "repairing it would copy more than " + std::to_string(kMaxCopiedValues) +
                                               " influences or displacements"};
        }
        return success();
    }

    void mapWeights() {
        if (weights_.starts.empty()) {
            return;
        }
        SkinWeights mapped;
        mapped.starts.push_back(0);
        for (const uint32_t source : sources_) {
            appendVertex(weights_, source, mapped);
        }
        weights_ = std::move(mapped);
    }

    void mapMorphs() {
        for (MorphTarget& target : morphs_.targets) {
            std::vector<std::pair<uint32_t, size_t>> entries; // vertex, entry of the target
            for (size_t i = 0; i < target.vertices.size(); ++i) {
                for (const uint32_t vertex : successors_.of(target.vertices[i])) {
                    entries.emplace_back(vertex, i);
                }
            }
            std::sort(entries.begin(), entries.end());
            MorphTarget mapped{target.name, {}, {}};
            for (const auto& [vertex, i] : entries) {
                mapped.vertices.push_back(vertex);
                mapped.deltas.push_back(target.deltas[i]);
            }
            target = std::move(mapped);
        }
    }

    template <class Values>
    void gather(Values& values, const std::vector<uint32_t>& from) {
        if (values.empty()) {
            return;
        }
        Values gathered;
        gathered.reserve(from.size());
        for (const uint32_t i : from) {
            gathered.push_back(values[i]);
        }
        values = std::move(gathered);
    }

    /// The file's cut of a face that kept its corners. A face that is turned round has them in reverse. Empty for any
    /// other face.
    [[nodiscard]] std::vector<uint32_t> keptTriangles(uint32_t face) const {
        const uint32_t source = draft_.faces[face], sourceStart = cage_.faceStarts[source], start = draft_.starts[face];
        const uint32_t sides = draft_.sides(face);
        if (sides < 3 || sides != cage_.sides(source)) {
            return {};
        }
        std::vector<uint32_t> places(sides, kNone); // per corner that it was: where it stands now
        for (uint32_t k = 0; k < sides; ++k) {
            const uint32_t was = draft_.corners[start + k] - sourceStart; // wraps for corners of other faces
            if (was >= sides || places[was] != kNone) {
                return {};
            }
            places[was] = k;
        }
        const bool turned = (places[0] + 1) % sides != places[1];
        std::vector<uint32_t> triangles;
        const size_t first = size_t{3} * (sourceStart - size_t{2} * source);
        for (size_t t = first; t < first + size_t{3} * (sides - 2); t += 3) {
            for (const size_t k : {size_t{0}, size_t{turned ? 2u : 1u}, size_t{turned ? 1u : 2u}}) {
                triangles.push_back(places[cage_.faceTriangles[t + k] - sourceStart]);
            }
        }
        return triangles;
    }

    /// Before the faces are mapped. Other faces than those that kept their corners are cut anew.
    void mapTriangles() {
        bool whole = !cage_.faceTriangles.empty();
        for (uint32_t f = 0; f < cage_.faceCount() && whole; ++f) {
            whole = cage_.sides(f) >= 3; // so every face's triangles are where its corners say
        }
        if (!whole) {
            cage_.faceTriangles.clear();
            return;
        }
        std::vector<uint32_t> mapped;
        std::vector<glm::vec3> corners;
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            std::vector<uint32_t> triangles = keptTriangles(f);
            if (triangles.empty()) {
                corners.clear();
                for (uint32_t c = draft_.starts[f]; c < draft_.starts[f + 1]; ++c) {
                    corners.push_back(cage_.positions[draft_.sources[draft_.vertices[c]]]);
                }
                clipEars(corners, triangles);
            }
            for (const uint32_t corner : triangles) {
                mapped.push_back(draft_.starts[f] + corner);
            }
        }
        cage_.faceTriangles = std::move(mapped);
    }

    /// Before the faces are mapped. A triangle whose corners are no longer on one face is lost.
    void mapSourceTriangles() {
        if (cage_.sourceTriangles.empty()) {
            return;
        }
        struct Place {
            uint32_t corner = kNone, face = kNone;
        };
        std::vector<Place> places(cage_.cornerCount()); // per corner that it was: where it stands first
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            for (uint32_t c = draft_.starts[f]; c < draft_.starts[f + 1]; ++c) {
                const uint32_t was = draft_.corners[c], source = draft_.faces[f];
                const bool own = was >= cage_.faceStarts[source] && was < cage_.faceStarts[source + 1];
                if (own && places[was].corner == kNone) {
                    places[was] = {c, f};
                }
            }
        }
        for (size_t t = 0; t < cage_.sourceTriangles.size(); t += 3) {
            const auto at = [&](size_t k) {
                const uint32_t corner = cage_.sourceTriangles[t + k];
                return corner == kNone ? Place{} : places[corner];
            };
            const Place a = at(0), b = at(1), c = at(2);
            const bool together = a.face != kNone && a.face == b.face && a.face == c.face;
            cage_.sourceTriangles[t] = together ? a.corner : kNone;
            cage_.sourceTriangles[t + 1] = together ? b.corner : kNone;
            cage_.sourceTriangles[t + 2] = together ? c.corner : kNone;
        }
    }

    void mapFaces() {
        mapTriangles();
        mapSourceTriangles();
        cage_.faceStarts = draft_.starts;
        cage_.faceVertices.clear();
        for (const uint32_t v : draft_.vertices) {
            cage_.faceVertices.push_back(numbers_[v]);
        }
        gather(cage_.cornerUvs, draft_.corners);
        gather(cage_.cornerUvs1, draft_.corners);
        gather(cage_.cornerColors, draft_.corners);
        gather(cage_.cornerNormals, draft_.corners);
        gather(cage_.cornerTangents, draft_.corners);
        gather(cage_.cornerFaceUvs, draft_.corners);
        gather(cage_.faceMaterials, draft_.faces);
        gather(cage_.faceParts, draft_.faces);
        gather(cage_.faceTrimTiles, draft_.faces);
        const std::vector<uint32_t> holes = std::exchange(cage_.holes, {});
        for (uint32_t f = 0; f < draft_.faceCount() && !holes.empty(); ++f) {
            if (std::binary_search(holes.begin(), holes.end(), draft_.faces[f])) {
                cage_.holes.push_back(f);
            }
        }
    }

    void mapVertices() {
        gather(cage_.positions, sources_);
        gather(cage_.sourceVertices, sources_);
    }

    [[nodiscard]] bool copied(uint32_t source) const { return successors_.of(source).size() > 1; }

    /// Edges with an end that has copies, under the ends that they had.
    void findCopiedEdges() {
        if (cage_.creases.empty() && cage_.creaseScalars.empty() && draft_.creases.empty()) {
            return;
        }
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            for (uint32_t c = draft_.starts[f]; c < draft_.starts[f + 1]; ++c) {
                const uint32_t v = cage_.faceVertices[c];
                const uint32_t w = cage_.faceVertices[draft_.next(f, c)];
                if (copied(sources_[v]) || copied(sources_[w])) {
                    const bool rises = sources_[v] < sources_[w];
                    const Ends now = rises ? Ends(v, w) : Ends(w, v);
                    copiedEdges_.emplace_back(Ends(sources_[now.first], sources_[now.second]), now);
                }
            }
        }
        std::sort(copiedEdges_.begin(), copiedEdges_.end());
        copiedEdges_.erase(std::unique(copiedEdges_.begin(), copiedEdges_.end()), copiedEdges_.end());
    }

    /// Calls `put` with every edge (vertex at a, vertex at b) that an edge became; with its ends where it is none.
    template <class Put>
    void forEachEdge(uint32_t a, uint32_t b, Put&& put) const {
        const Ends key = std::minmax(a, b);
        auto edge = std::lower_bound(copiedEdges_.begin(), copiedEdges_.end(), std::pair(key, Ends(0, 0)));
        if (edge == copiedEdges_.end() || edge->first != key) {
            put(successors_.first(a), successors_.first(b));
            return;
        }
        for (; edge != copiedEdges_.end() && edge->first == key; ++edge) {
            put(a < b ? edge->second.first : edge->second.second, a < b ? edge->second.second : edge->second.first);
        }
    }

    /// Entries of an edge that has become several count once, in the place of the first: no list may grow beyond the
    /// number of edges. `merge` adds an entry to an earlier one.
    template <class Entry, class Key, class Merge>
    std::vector<Entry> once(const std::vector<Entry>& entries, Key&& key, Merge&& merge) const {
        std::vector<Entry> kept;
        std::map<Ends, size_t> known;
        for (const Entry& entry : entries) {
            const Ends ends = key(entry);
            if (copied(ends.first) || copied(ends.second)) {
                const auto [place, isNew] = known.try_emplace(ends, kept.size());
                if (!isNew) {
                    merge(kept[place->second], entry);
                    continue;
                }
            }
            kept.push_back(entry);
        }
        return kept;
    }

    void mapCreases() {
        cage_.creases.insert(cage_.creases.end(), draft_.creases.begin(), draft_.creases.end());
        const auto ends = [](const Crease& crease) { return Ends(std::minmax(crease.a, crease.b)); };
        const auto merge = [](Crease& kept, const Crease& crease) { mergeCrease(crease, kept); };
        const std::vector<Crease> given = once(cage_.creases, ends, merge);
        cage_.creases.clear();
        for (const Crease& crease : given) {
            forEachEdge(crease.a, crease.b, [&](uint32_t a, uint32_t b) {
                if (a != kNone && b != kNone) {
                    cage_.creases.push_back({a, b, crease.sharpness, crease.set});
                }
            });
        }
    }

    void mapSharpVertices() {
        cage_.sharpVertices.insert(cage_.sharpVertices.end(), draft_.sharpVertices.begin(), draft_.sharpVertices.end());
        const auto vertex = [](const SharpVertex& sharp) { return Ends(sharp.vertex, sharp.vertex); };
        const auto sharpest = [](SharpVertex& kept, const SharpVertex& sharp) {
            kept.sharpness = std::max(kept.sharpness, sharp.sharpness);
        };
        const std::vector<SharpVertex> given = once(cage_.sharpVertices, vertex, sharpest);
        cage_.sharpVertices.clear();
        for (const SharpVertex& sharp : given) {
            for (const uint32_t v : successors_.of(sharp.vertex)) {
                cage_.sharpVertices.push_back({v, sharp.sharpness});
            }
        }
    }

    void mapRoundCorners() {
        std::vector<uint32_t> given;
        given.swap(cage_.roundCorners);
        for (const uint32_t vertex : given) {
            for (const uint32_t v : successors_.of(vertex)) {
                cage_.roundCorners.push_back(v);
            }
        }
    }

    void mapCreaseScalars() {
        const auto ends = [](const CreaseScalar& scalar) { return Ends(scalar.vertex, scalar.toward); };
        const auto last = [](CreaseScalar& kept, const CreaseScalar& scalar) { kept.alpha = scalar.alpha; };
        const std::vector<CreaseScalar> given = once(cage_.creaseScalars, ends, last);
        cage_.creaseScalars.clear();
        for (const CreaseScalar& scalar : given) {
            forEachEdge(scalar.vertex, scalar.toward, [&](uint32_t vertex, uint32_t toward) {
                if (vertex != kNone && toward != kNone) {
                    cage_.creaseScalars.push_back({vertex, toward, scalar.alpha});
                }
            });
        }
    }

    const Draft& draft_;
    Cage& cage_;
    SkinWeights& weights_;
    Morphs& morphs_;
    std::vector<uint32_t> numbers_; ///< per vertex of the draft: of the new cage, kNone without a face
    std::vector<uint32_t> sources_; ///< per vertex of the new cage: of the given one
    Successors successors_;
    std::vector<std::pair<Ends, Ends>> copiedEdges_; ///< (given ends, new ends), sorted; the smaller given one first
};

} // namespace

Status applyDraft(const Draft& draft, Cage& cage, SkinWeights& weights, Morphs& morphs) {
    return Remapper(draft, cage, weights, morphs).run();
}

} // namespace supple::cage::repair
