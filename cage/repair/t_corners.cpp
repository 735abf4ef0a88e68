#include "cage/repair/t_corners.h"

#include "cage/sharp_features.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace supple::cage::repair {
namespace {

using EdgeEnds = std::pair<uint32_t, uint32_t>; ///< smaller vertex first

/// Twice the area vector of a face.
glm::dvec3 areaOfFace(std::span<const glm::vec3> positions, const FaceLists& faces, uint32_t face) {
    const auto position = [&](uint32_t corner) { return glm::dvec3(positions[faces.vertices[corner]]); };
    const uint32_t first = faces.starts[face];
    glm::dvec3 area(0.0);
    for (uint32_t c = first + 1; c + 1 < faces.starts[face + 1]; ++c) {
        area += glm::cross(position(c) - position(first), position(c + 1) - position(first));
    }
    return area;
}

class TCornerFinder {
public:
    TCornerFinder(std::span<const glm::vec3> positions, const FaceLists& faces, std::span<const Side> open)
        : positions_(positions), faces_(faces), open_(open), taken_(open.size(), 0) {
        for (size_t i = 0; i < open.size(); ++i) {
            ends_.emplace_back(open[i].low, i);
            ends_.emplace_back(open[i].high, i);
        }
        std::sort(ends_.begin(), ends_.end());
    }

    std::vector<SplitSide> run() {
        std::vector<size_t> order(open_.size());
        for (size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return open_[i].corner < open_[j].corner; });
        std::vector<SplitSide> found;
        for (const size_t i : order) {
            if (taken_[i] == 0 && follow(i) && fits()) {
                taken_[i] = 1;
                take();
                found.push_back(std::move(split_));
            }
        }
        return found;
    }

private:
    /// Where a vertex lies on the side at work, in parts of its length; nothing if it does not lie inside it.
    [[nodiscard]] std::optional<double> placeOf(uint32_t vertex) const {
        const glm::dvec3 to = glm::dvec3(positions_[vertex]) - origin_;
        const double place = glm::dot(to, along_) / length2_;
        const glm::dvec3 off = to - place * along_;
        const bool inside = place > 0.0 && place < 1.0;
        const bool near = glm::dot(off, off) <= kTCornerTolerance * kTCornerTolerance * length2_;
        return inside && near ? std::optional(place) : std::nullopt;
    }

    /// The chain's sides are in no other chain, and the face has its vertices from now on.
    void take() {
        for (size_t i = 0; i < links_.size(); ++i) {
            taken_[links_[i]] = 1;
            marks_[faces_.vertices[split_.chain[i].end]] = split_.face;
        }
    }

    /// Whether the face of the side at work has a vertex. Sides come face by face, so that each face is marked once.
    [[nodiscard]] bool isOwnCorner(uint32_t vertex) {
        marks_.resize(positions_.size(), kNone);
        if (markedFace_ != split_.face) {
            markedFace_ = split_.face;
            for (uint32_t c = faces_.starts[markedFace_]; c < faces_.starts[markedFace_ + 1]; ++c) {
                marks_[faces_.vertices[c]] = markedFace_;
            }
        }
        return marks_[vertex] == markedFace_;
    }

    /// Each face is measured once: it may have any number of sides.
    [[nodiscard]] const glm::dvec3& areaOf(uint32_t face) {
        const auto [area, isNew] = areas_.try_emplace(face);
        if (isNew) {
            area->second = areaOfFace(positions_, faces_, face);
        }
        return area->second;
    }

    /// The open side that leads from a vertex to the next one on the side at work, and that one's place; the end of the
    /// side at work has place 1.
    [[nodiscard]] std::pair<size_t, double> nextLink(size_t atWork, uint32_t vertex, double place, uint32_t end) {
        const auto first = std::lower_bound(ends_.begin(), ends_.end(), std::pair(vertex, size_t{0}));
        std::pair<size_t, double> next(open_.size(), 2.0);
        size_t tried = 0;
        for (auto entry = first; entry != ends_.end() && entry->first == vertex; ++entry) {
            if (++tried > kMaxTCorners) {
                return {open_.size(), 2.0};
            }
            const Side& side = open_[entry->second];
            const uint32_t far = side.low == vertex ? side.high : side.low;
            if (entry->second == atWork || taken_[entry->second] != 0) {
                continue;
            }
            const std::optional<double> at = far == end ? std::optional(1.0) : placeOf(far);
            if (at && *at > place && *at < next.second && (far == end || !isOwnCorner(far))) {
                next = {entry->second, *at};
            }
        }
        return next;
    }

    /// Follows the chain along an open side; fills `split_` and `links_`.
    bool follow(size_t atWork) {
        const Side& side = open_[atWork];
        const uint32_t begin = faces_.vertices[side.corner];
        const uint32_t end = side.low == begin ? side.high : side.low;
        origin_ = glm::dvec3(positions_[begin]);
        along_ = glm::dvec3(positions_[end]) - origin_;
        length2_ = glm::dot(along_, along_);
        split_ = {side.face, side.corner, {}, {}};
        links_.clear();
        if (!(length2_ > 0.0)) {
            return false;
        }
        double place = 0.0;
        for (uint32_t vertex = begin; vertex != end;) {
            const auto [link, at] = nextLink(atWork, vertex, place, end);
            if (link == open_.size() || links_.size() > kMaxTCorners) {
                return false;
            }
            const Side& next = open_[link];
            const uint32_t last = faces_.next(next.face, next.corner);
            const bool same = faces_.vertices[next.corner] == vertex;
            split_.chain.push_back({next.face, same ? next.corner : last, same ? last : next.corner});
            links_.push_back(link);
            vertex = next.low == vertex ? next.high : next.low;
            place = at;
            if (vertex != end) {
                split_.places.push_back(at);
            }
        }
        return split_.chain.size() > 1;
    }

    /// Whether no face of the chain would lie back to back with the side's. A face that runs along the side in the
    /// side's own direction is to be turned.
    [[nodiscard]] bool fits() {
        constexpr double kCosineOfOneDegree = 0.99984770;
        const glm::dvec3 own = areaOf(split_.face);
        return std::none_of(split_.chain.begin(), split_.chain.end(), [&](const SplitSide::Link& link) {
            const glm::dvec3& other = areaOf(link.face);
            const bool same = faces_.next(link.face, link.begin) == link.end;
            const double lengths = glm::length(own) * glm::length(other);
            const double cosine = same ? -glm::dot(own, other) : glm::dot(own, other);
            return lengths > 0.0 && cosine < -kCosineOfOneDegree * lengths;
        });
    }

    std::span<const glm::vec3> positions_;
    FaceLists faces_;
    std::span<const Side> open_;
    std::vector<uint8_t> taken_;                    ///< per open side: part of a chain, or split by one
    std::vector<std::pair<uint32_t, size_t>> ends_; ///< vertices of open sides, sorted
    std::vector<uint32_t> marks_;                   ///< per vertex: the last marked face that has it
    uint32_t markedFace_ = kNone;
    std::unordered_map<uint32_t, glm::dvec3> areas_; ///< by face
    SplitSide split_;                                ///< of the side at work
    std::vector<size_t> links_;                      ///< the chain's open sides
    glm::dvec3 origin_{0.0}, along_{0.0};
    double length2_ = 0.0;
};

FaceLists listsOf(const Draft& draft) {
    return {draft.starts, draft.vertices};
}

/// Puts T-corners into the faces of a draft.
class TCornerMender {
public:
    TCornerMender(Cage& cage, CageNames& names, const Places& places, Draft& draft, TCornerDamage& damage)
        : cage_(cage), names_(names), places_(places), draft_(draft), damage_(damage) {}

    void run(const std::vector<SplitSide>& sides) {
        splitCreases(sides);
        splitScalars(sides);
        std::map<uint32_t, const SplitSide*> atCorners;
        for (const SplitSide& side : sides) {
            atCorners.emplace(side.corner, &side);
            for (size_t i = 0; i < side.places.size(); ++i) {
                damage_.corners.add(places_, draft_.faces[side.face], [&] { return nameOf(side, i); });
            }
        }
        Draft after;
        for (uint32_t f = 0; f < draft_.faceCount(); ++f) {
            addFace(f, atCorners, after);
        }
        after.sources = std::move(draft_.sources);
        draft_ = std::move(after);
    }

private:
    [[nodiscard]] uint32_t vertexBehind(const SplitSide& side, size_t link) const {
        return draft_.vertices[side.chain[link].end];
    }
    [[nodiscard]] EdgeEnds endsOf(const SplitSide& side) const {
        return std::minmax(draft_.vertices[side.corner], draft_.vertices[draft_.next(side.face, side.corner)]);
    }
    [[nodiscard]] size_t partOf(uint32_t face) const { return places_.partOf(draft_.faces[face]); }

    /// The neighbor's corner at a T-corner: of the side's own part if one of the two neighbors there is.
    [[nodiscard]] std::pair<uint32_t, uint32_t> faceAndCorner(const SplitSide& side, size_t i) const {
        const SplitSide::Link &before = side.chain[i], &behind = side.chain[i + 1];
        const bool takeBehind = partOf(before.face) != partOf(side.face) && partOf(behind.face) == partOf(side.face);
        return takeBehind ? std::pair(behind.face, behind.begin) : std::pair(before.face, before.end);
    }

    [[nodiscard]] std::string nameOf(const SplitSide& side, size_t i) const {
        const auto [face, corner] = faceAndCorner(side, i);
        const std::string of = partOf(face) == partOf(side.face) ? "" : " of " + names_.parts[partOf(face)];
        return places_.vertex(draft_.corners[corner]) + of + " on " +
               places_.edge(draft_.corners[side.corner], draft_.corners[draft_.next(side.face, side.corner)]) + " of " +
               places_.face(draft_.faces[side.face]);
    }

    /// The crease of an edge goes to all its pieces. One that a piece has already stays if it is sharper.
    void splitCreases(const std::vector<SplitSide>& sides) {
        std::map<EdgeEnds, const SplitSide*> atEnds;
        for (const SplitSide& side : sides) {
            atEnds.emplace(endsOf(side), &side);
        }
        std::vector<Crease> pieces;
        std::erase_if(cage_.creases, [&](const Crease& crease) {
            const auto found = atEnds.find(std::minmax(crease.a, crease.b));
            if (found == atEnds.end()) {
                return false;
            }
            for (const SplitSide::Link& link : found->second->chain) {
                pieces.push_back(
                    {draft_.vertices[link.begin], draft_.vertices[link.end], crease.sharpness, crease.set});
            }
            return true;
        });
        if (pieces.empty()) {
            return;
        }
        std::map<EdgeEnds, size_t> known;
        for (size_t i = 0; i < cage_.creases.size(); ++i) {
            known.emplace(std::minmax(cage_.creases[i].a, cage_.creases[i].b), i);
        }
        for (const Crease& piece : pieces) {
            const auto [place, isNew] = known.emplace(std::minmax(piece.a, piece.b), cage_.creases.size());
            if (isNew) {
                cage_.creases.push_back(piece);
            } else {
                mergeCrease(piece, cage_.creases[place->second]);
            }
        }
    }

    /// Crease scalars stay at the ends of the edge. Between two that are given they are linear.
    void splitScalars(const std::vector<SplitSide>& sides) {
        if (cage_.creaseScalars.empty()) {
            return;
        }
        std::map<EdgeEnds, float> given; // (vertex, toward)
        for (const CreaseScalar& scalar : cage_.creaseScalars) {
            given[EdgeEnds(scalar.vertex, scalar.toward)] = scalar.alpha;
        }
        std::set<EdgeEnds> split;
        for (const SplitSide& side : sides) {
            const uint32_t begin = draft_.vertices[side.chain.front().begin];
            const uint32_t end = draft_.vertices[side.chain.back().end];
            const auto first = given.find(EdgeEnds(begin, end)), last = given.find(EdgeEnds(end, begin));
            split.insert({EdgeEnds(begin, end), EdgeEnds(end, begin)});
            const auto put = [&](uint32_t vertex, uint32_t toward, float alpha) {
                if (!given.contains(EdgeEnds(vertex, toward))) {
                    cage_.creaseScalars.push_back({vertex, toward, alpha});
                }
            };
            if (first != given.end()) {
                put(begin, vertexBehind(side, 0), first->second);
            }
            for (size_t i = 0; i < side.places.size() && first != given.end() && last != given.end(); ++i) {
                const float alpha = glm::mix(first->second, last->second, static_cast<float>(side.places[i]));
                put(vertexBehind(side, i), draft_.vertices[side.chain[i].begin], alpha);
                put(vertexBehind(side, i), vertexBehind(side, i + 1), alpha);
            }
            if (last != given.end()) {
                put(end, draft_.vertices[side.chain.back().begin], last->second);
            }
        }
        std::erase_if(cage_.creaseScalars, [&](const CreaseScalar& scalar) {
            return split.contains(EdgeEnds(scalar.vertex, scalar.toward));
        });
    }

    void addFace(uint32_t face, const std::map<uint32_t, const SplitSide*>& atCorners, Draft& after) {
        std::vector<std::pair<uint32_t, uint32_t>> corners; // vertex, corner of the given cage
        for (uint32_t c = draft_.starts[face]; c < draft_.starts[face + 1]; ++c) {
            corners.emplace_back(draft_.vertices[c], draft_.corners[c]);
            const auto found = atCorners.find(c);
            for (size_t i = 0; found != atCorners.end() && i < found->second->places.size(); ++i) {
                corners.emplace_back(vertexBehind(*found->second, i), addCorner(*found->second, i));
            }
        }
        size_t first = 0;
        if (corners.size() > draft_.sides(face)) {
            damage_.sides[partOf(face)].push_back(static_cast<uint32_t>(corners.size()));
            first = firstCorner(corners);
        }
        std::rotate(corners.begin(), corners.begin() + static_cast<ptrdiff_t>(first), corners.end());
        for (const auto& [vertex, corner] : corners) {
            after.addCorner(vertex, corner);
        }
        after.closeFace(draft_.faces[face]);
    }

    /// The first corner from which a fan of triangles has no flat one; the first of all if there is none.
    [[nodiscard]] size_t firstCorner(const std::vector<std::pair<uint32_t, uint32_t>>& corners) const {
        const size_t count = corners.size();
        const auto isFlat = [&](size_t i, size_t j, size_t k) {
            const auto at = [&](size_t corner) { return glm::dvec3(cage_.positions[corners[corner % count].first]); };
            const glm::dvec3 x = at(j) - at(i), y = at(k) - at(i), z = at(k) - at(j);
            const double longest = std::max({glm::dot(x, x), glm::dot(y, y), glm::dot(z, z)});
            return !(glm::length(glm::cross(x, y)) > kTCornerTolerance * longest);
        };
        for (size_t first = 0; first < std::min(count, kMaxTCorners); ++first) {
            bool flat = false;
            for (size_t k = 1; k + 1 < count && !flat; ++k) {
                flat = isFlat(first, first + k, first + k + 1);
            }
            if (!flat) {
                return first;
            }
        }
        return 0;
    }

    /// Returns the number of the new corner.
    uint32_t addCorner(const SplitSide& side, size_t i) {
        const uint32_t from = draft_.corners[side.corner];
        const uint32_t to = draft_.corners[draft_.next(side.face, side.corner)];
        const auto place = static_cast<float>(side.places[i]);
        const auto mixed = [&](auto& values) {
            if (!values.empty()) {
                const auto value = glm::mix(values[from], values[to], place);
                values.push_back(value);
            }
        };
        mixed(cage_.cornerUvs);
        mixed(cage_.cornerUvs1);
        mixed(cage_.cornerColors);
        mixed(cage_.cornerFaceUvs);
        addNormal(side, i);
        addTangent(from, to, place);
        if (!names_.cornerVertices.empty()) {
            const uint32_t number = names_.cornerVertices[draft_.corners[faceAndCorner(side, i).second]];
            names_.cornerVertices.push_back(number);
        }
        cage_.faceVertices.push_back(vertexBehind(side, i));
        return cage_.cornerCount() - 1;
    }

    /// The neighbors' own if they have one normal there and the edge is smooth at both ends: so shading goes on across
    /// it. Else what the face has.
    void addNormal(const SplitSide& side, size_t i) {
        std::vector<glm::vec3>& normals = cage_.cornerNormals;
        if (normals.empty()) {
            return;
        }
        const auto at = [&](uint32_t corner) { return normals[draft_.corners[corner]]; };
        const glm::vec3 from = at(side.corner), to = at(draft_.next(side.face, side.corner));
        const glm::vec3 before = at(side.chain[i].end), behind = at(side.chain[i + 1].begin);
        if (before == behind && at(side.chain.front().begin) == from && at(side.chain.back().end) == to) {
            normals.push_back(before);
            return;
        }
        const glm::vec3 mean = glm::mix(from, to, static_cast<float>(side.places[i]));
        const float length = glm::length(mean);
        const bool hasBoth = from != glm::vec3(0.0f) && to != glm::vec3(0.0f) && length > 0.0f;
        normals.push_back(hasBoth ? mean / length : glm::vec3(0.0f));
    }

    void addTangent(uint32_t from, uint32_t to, float place) {
        std::vector<glm::vec4>& tangents = cage_.cornerTangents;
        if (tangents.empty()) {
            return;
        }
        const glm::vec4 a = tangents[from], b = tangents[to];
        const glm::vec3 mean = glm::mix(glm::vec3(a), glm::vec3(b), place);
        const float length = glm::length(mean);
        const bool hasBoth = glm::vec3(a) != glm::vec3(0.0f) && glm::vec3(b) != glm::vec3(0.0f) && a.w == b.w;
        tangents.push_back(hasBoth && length > 0.0f ? glm::vec4(mean / length, a.w) : glm::vec4(0.0f));
    }

    Cage& cage_;
    CageNames& names_;
    const Places& places_;
    Draft& draft_;
    TCornerDamage& damage_;
};

} // namespace

std::vector<Side> openSides(const Cage& cage, const Topology& topology) {
    std::vector<Side> open;
    for (const Topology::Edge& edge : topology.edges) {
        if (edge.twin != kNone) {
            continue;
        }
        const uint32_t face = topology.cornerFaces[edge.corner];
        const uint32_t a = cage.faceVertices[edge.corner];
        const uint32_t b = cage.faceVertices[nextCorner(cage, face, edge.corner)];
        open.push_back({std::min(a, b), std::max(a, b), edge.corner, face, a < b});
    }
    return open;
}

std::vector<Side> openSides(const Draft& draft) {
    const std::vector<Side> sides = sortedSides(draft);
    std::vector<Side> open;
    for (size_t i = 0; i < sides.size(); ++i) {
        const bool before = i > 0 && sides[i].sameEdge(sides[i - 1]);
        const bool behind = i + 1 < sides.size() && sides[i].sameEdge(sides[i + 1]);
        if (!before && !behind) {
            open.push_back(sides[i]);
        }
    }
    return open;
}

std::vector<SplitSide> findTCorners(std::span<const glm::vec3> positions, const FaceLists& faces,
                                    std::span<const Side> open) {
    return TCornerFinder(positions, faces, open).run();
}

void mendTCorners(Cage& cage, CageNames& names, const Places& places, Draft& draft, TCornerDamage& damage) {
    const std::vector<SplitSide> sides = findTCorners(cage.positions, listsOf(draft), openSides(draft));
    if (!sides.empty()) {
        TCornerMender(cage, names, places, draft, damage).run(sides);
    }
}

} // namespace supple::cage::repair
