#include "cage/bind_space.h"

#include "cage/disjoint_sets.h"
#include "cage/limits.h"
#include "cage/skeleton.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace supple::cage {
namespace {

/// Nodes are hidden by a scale of 0: then nothing is known of where their vertices stand. How large they are does not
/// matter.
bool isUsable(const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const double size = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    return std::isfinite(size) && size > 0.0 && std::abs(glm::determinant(linear)) > 1e-14 * size;
}

bool isMirrored(const glm::dmat4& matrix) {
    return glm::determinant(glm::dmat3(matrix)) < 0.0;
}

glm::dmat4 mirror() {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
}

/// Spaces that are looked at for one that is the same: no character has as many.
constexpr size_t kMostKnown = 64;
/// Joints that are looked at for one below or above another, so that no file can make this quadratic.
constexpr size_t kMostTried = 64;

/// What of a part is taken to one place.
struct Group {
    glm::dmat4 place{1.0};
    glm::dmat3 normals{1.0};
    bool mirrored = false;

    explicit Group(const glm::dmat4& to)
        : place(to), normals(glm::transpose(glm::inverse(glm::dmat3(to)))), mirrored(isMirrored(to)) {}
};

/// The vertices of a part, each of one group. All vertices of a face are of one.
class Placement {
public:
    Placement(const PartCage& part, std::vector<Group> groups)
        : groups_(std::move(groups)), ofVertex_(part.cage.vertexCount(), 0) {}

    void set(uint32_t vertex, uint8_t group) { ofVertex_[vertex] = group; }
    [[nodiscard]] const Group& of(uint32_t vertex) const { return groups_[ofVertex_[vertex]]; }
    [[nodiscard]] uint8_t numberOf(uint32_t vertex) const { return ofVertex_[vertex]; }

    /// False, and does nothing, if a coordinate would be too far to be read again.
    [[nodiscard]] bool apply(PartCage& part) const {
        const auto isFar = [](const glm::vec3& p) { return faultOfCoordinates(&p.x, 3) != nullptr; };
        std::vector<glm::vec3> positions = part.cage.positions;
        for (uint32_t v = 0; v < positions.size(); ++v) {
            positions[v] = glm::vec3(of(v).place * glm::dvec4(positions[v], 1.0));
        }
        std::vector<std::vector<glm::vec3>> deltas;
        for (const MorphTarget& target : part.morphs.targets) {
            std::vector<glm::vec3>& placed = deltas.emplace_back(target.deltas);
            for (size_t i = 0; i < placed.size(); ++i) {
                placed[i] = glm::vec3(of(target.vertices[i]).place * glm::dvec4(placed[i], 0.0));
            }
            if (std::any_of(placed.begin(), placed.end(), isFar)) {
                return false;
            }
        }
        if (std::any_of(positions.begin(), positions.end(), isFar)) {
            return false;
        }
        part.cage.positions = std::move(positions);
        const glm::dmat3 linear(groups_.front().place);
        part.gridStep *=
            static_cast<float>(std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])}));
        for (size_t i = 0; i < deltas.size(); ++i) {
            part.morphs.targets[i].deltas = std::move(deltas[i]);
        }
        applyToCorners(part.cage);
        return true;
    }

private:
    void applyToCorners(Cage& cage) const {
        for (size_t c = 0; c < cage.cornerNormals.size(); ++c) {
            glm::vec3& normal = cage.cornerNormals[c];
            const glm::dvec3 placed = of(cage.faceVertices[c]).normals * glm::dvec3(normal);
            normal = normal == glm::vec3(0.0f) ? normal : glm::vec3(glm::normalize(placed)); // zero: as the face
        }
        for (size_t c = 0; c < cage.cornerTangents.size(); ++c) {
            glm::vec4& tangent = cage.cornerTangents[c];
            const Group& group = of(cage.faceVertices[c]);
            const glm::dvec3 placed = glm::dmat3(group.place) * glm::dvec3(tangent);
            const bool none = glm::vec3(tangent) == glm::vec3(0.0f);
            tangent = none ? tangent : glm::vec4(glm::normalize(placed), group.mirrored ? -tangent.w : tangent.w);
        }
        std::vector<uint8_t> turned(cage.faceCount(), 0);
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            turned[f] = of(cage.faceVertices[cage.faceStarts[f]]).mirrored ? 1 : 0;
        }
        reverseFaces(cage, turned);
    }

    std::vector<Group> groups_;
    std::vector<uint8_t> ofVertex_;
};

/// The joints of a part's skin, those with the most weight first.
std::vector<uint32_t> byWeight(const PartCage& part, size_t jointCount) {
    std::vector<double> weights(jointCount, 0.0);
    for (const Influence& influence : part.weights.influences) {
        weights[influence.joint] += influence.weight;
    }
    std::vector<uint32_t> order(jointCount);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return weights[a] > weights[b]; });
    return order;
}

struct Extent {
    glm::dvec3 low, high;

    explicit Extent(const std::vector<glm::vec3>& positions) : low(positions.front()), high(low) {
        for (const glm::vec3& p : positions) {
            low = glm::min(low, glm::dvec3(p));
            high = glm::max(high, glm::dvec3(p));
        }
    }
    [[nodiscard]] std::array<glm::dvec4, 8> corners() const {
        std::array<glm::dvec4, 8> all{};
        for (size_t k = 0; k < all.size(); ++k) {
            all[k] = {(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y, (k & 4) != 0 ? high.z : low.z, 1.0};
        }
        return all;
    }
};

/// Whether two matrices take what has this extent to one place, but for the rounding of inverse bind matrices.
bool isSamePlace(const glm::dmat4& a, const glm::dmat4& b, const Extent& extent) {
    constexpr double kRounding = 1e-4; // of the extent
    const glm::dvec3 &low = extent.low, &high = extent.high;
    const auto sizeBy = [&](const glm::dmat4& m) { return glm::length(glm::dmat3(m) * (high - low)); };
    const double most = kRounding * std::max(sizeBy(a), sizeBy(b));
    for (const glm::dvec4& p : extent.corners()) {
        if (!(glm::length(glm::dvec3(a * p) - glm::dvec3(b * p)) <= most)) {
            return false;
        }
    }
    return true;
}

/// Whether two inverse bind matrices take these points to the same places, but for their own rounding: that of a place
/// is as large as the terms that it is the sum of.
bool isSameBind(const glm::dmat4& a, const glm::dmat4& b, std::span<const glm::dvec4> points) {
    constexpr double kRounding = 1e-5;
    double largest = 0.0, difference = 0.0;
    for (const glm::dvec4& p : points) {
        largest = std::max(largest, glm::length(glm::dmat3(a) * glm::dvec3(p)));
        difference = std::max(difference, glm::length(glm::dvec3(a * p) - glm::dvec3(b * p)));
    }
    return difference <= kRounding * largest;
}

/// By vertex: whether the joints that move it mirror, as the skeleton rests. Of vertices that nothing is known of, as
/// those that a scale of 0 hides, it is `unknown`.
std::vector<uint8_t> mirroredVertices(const PartCage& part, const Skin& skin, std::span<const glm::dmat4> rest,
                                      bool unknown) {
    std::vector<double> signs;
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        const glm::dmat4 moved = rest[skin.joints[j]] * glm::dmat4(skin.inverseBinds[j]);
        signs.push_back(!isUsable(moved) ? 0.0 : isMirrored(moved) ? -1.0 : 1.0);
    }
    std::vector<uint8_t> mirrored(part.cage.vertexCount(), 0);
    for (uint32_t v = 0; v < mirrored.size(); ++v) {
        double sign = 0.0;
        for (uint32_t i = part.weights.starts[v]; i < part.weights.starts[v + 1]; ++i) {
            sign += part.weights.influences[i].weight * signs[part.weights.influences[i].joint];
        }
        mirrored[v] = sign < 0.0 || (sign == 0.0 && unknown) ? 1 : 0;
    }
    return mirrored;
}

/// For each vertex one of its piece: of those that faces join.
std::vector<uint32_t> piecesOf(const Cage& cage) {
    DisjointSets sets(cage.vertexCount());
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f] + 1; c < cage.faceStarts[f + 1]; ++c) {
            sets.unite(cage.faceVertices[cage.faceStarts[f]], cage.faceVertices[c]);
        }
    }
    std::vector<uint32_t> pieces(cage.vertexCount());
    for (uint32_t v = 0; v < pieces.size(); ++v) {
        pieces[v] = sets.find(v);
    }
    return pieces;
}

/// An inverse bind matrix, affine whatever was rounded.
glm::mat4 asBind(const glm::dmat4& matrix) {
    glm::mat4 bind(matrix);
    for (int k = 0; k < 4; ++k) {
        bind[k][3] = k < 3 ? 0.0f : 1.0f; // not -0
    }
    return bind;
}

/// Whether the inverse bind matrix of what was taken to `place` can do what `given` does: its numbers are those of a
/// file, and it takes back what has this extent, but for a small part of its size.
bool isExact(const glm::mat4& bind, const glm::dmat4& place, const glm::dmat4& given, const Extent& extent) {
    constexpr double kMost = 0.01; // of what `given` makes of the extent
    if (faultOfCoordinates(&bind[0][0], 16) != nullptr) {
        return false;
    }
    const double most = kMost * glm::length(glm::dmat3(given) * (extent.high - extent.low));
    for (const glm::dvec4& p : extent.corners()) {
        const glm::dvec4 placed(glm::vec3(place * p), 1.0);
        if (!(glm::length(glm::dvec3(glm::dmat4(bind) * placed) - glm::dvec3(given * p)) <= most)) {
            return false;
        }
    }
    return true;
}

} // namespace

void MeshBinding::addFollower() {
    skin.joints.push_back(node);
    skin.inverseBinds.emplace_back(1.0f);
    hasFollower = true;
}

MeshBinding bindToNode(uint32_t node) {
    return {node, false, {{node}, {glm::mat4(1.0f)}}};
}

BindSpace::BindSpace(const Skeleton& skeleton, std::span<const MeshBinding> meshes, std::span<const PartCage> parts,
                     bool alone)
    : skeleton_(skeleton), rest_(restPlaces(skeleton)), alone_(alone), spaces_(meshes.size(), glm::dmat4(1.0)) {
    std::vector<size_t> order(meshes.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::erase_if(order, [&](size_t i) { return !meshes[i].skinned; });
    const std::vector<size_t> asGiven = order;
    // The one with most joints says most of where those of the others stand.
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return meshes[a].skinJoints() > meshes[b].skinJoints(); });
    for (const size_t i : order) {
        spaces_[i] = spaceOf(meshes[i], parts[i]);
        addJoints(meshes[i], spaces_[i]);
    }
    joints_.clear();
    for (const size_t i : asGiven) {
        addJoints(meshes[i], spaces_[i]);
    }
}

void BindSpace::addJoints(const MeshBinding& mesh, const glm::dmat4& space) {
    const bool isOwn = space == glm::dmat4(1.0);
    for (size_t j = 0; j < mesh.skinJoints(); ++j) {
        const glm::dmat4 bind(mesh.skin.inverseBinds[j]);
        if (isUsable(bind)) {
            joints_.emplace(mesh.skin.joints[j],
                            Joint{isOwn ? glm::inverse(bind) : space * glm::inverse(bind),
                                  isOwn ? mesh.skin.inverseBinds[j] : asBind(bind * glm::inverse(space))});
        }
    }
}

glm::dmat4 BindSpace::spaceOf(const MeshBinding& mesh, const PartCage& part) {
    std::vector<uint32_t> order = byWeight(part, mesh.skin.joints.size());
    std::erase_if(
        order, [&](uint32_t j) { return j >= mesh.skinJoints() || !isUsable(glm::dmat4(mesh.skin.inverseBinds[j])); });
    if (order.empty()) {
        return glm::dmat4(1.0);
    }
    std::optional<glm::dmat4> space;
    if (joints_.empty()) {
        const glm::dmat4 moved = rest_[mesh.skin.joints[order[0]]] * glm::dmat4(mesh.skin.inverseBinds[order[0]]);
        space = isUsable(moved) && isMirrored(moved) ? mirror() : glm::dmat4(1.0);
    }
    for (size_t i = 0; i < order.size() && !space; ++i) {
        const auto joint = joints_.find(mesh.skin.joints[order[i]]);
        if (joint != joints_.end()) {
            space = joint->second.place * glm::dmat4(mesh.skin.inverseBinds[order[i]]);
        }
    }
    if (!space) {
        space = spaceBesideJoints(mesh, order);
    }
    if (!space || !isUsable(*space)) {
        return glm::dmat4(1.0);
    }
    const Extent extent(part.cage.positions);
    const auto known =
        std::find_if(known_.begin(), known_.end(), [&](const auto& k) { return isSamePlace(k, *space, extent); });
    if (known != known_.end()) {
        return *known;
    }
    if (known_.size() < kMostKnown) {
        known_.push_back(*space);
    }
    return *space;
}

std::optional<glm::dmat4> BindSpace::spaceBesideJoints(const MeshBinding& mesh, std::span<const uint32_t> order) const {
    const auto from = [&](uint32_t known, uint32_t j) -> std::optional<glm::dmat4> {
        const glm::dmat4 place = joints_.at(known).place * glm::inverse(rest_[known]) * rest_[mesh.skin.joints[j]];
        return isUsable(rest_[known]) && isUsable(place) ? std::optional(place * glm::dmat4(mesh.skin.inverseBinds[j]))
                                                         : std::nullopt;
    };
    // Between a joint and one below it nothing but what lies between them counts, so these come first.
    for (size_t i = 0; i < std::min(order.size(), kMostTried); ++i) {
        uint32_t node = mesh.skin.joints[order[i]];
        while (node != kNone && !joints_.contains(node)) {
            node = skeleton_.nodes[node].parent;
        }
        if (node != kNone && from(node, order[i])) {
            return from(node, order[i]);
        }
    }
    std::map<uint32_t, uint32_t> own;
    for (const uint32_t j : order) {
        own.emplace(mesh.skin.joints[j], j);
    }
    size_t tried = 0;
    for (auto joint = joints_.begin(); joint != joints_.end() && tried < kMostTried; ++joint, ++tried) {
        uint32_t node = joint->first;
        while (node != kNone && !own.contains(node)) {
            node = skeleton_.nodes[node].parent;
        }
        if (node != kNone && from(joint->first, own.at(node))) {
            return from(joint->first, own.at(node));
        }
    }
    return from(joints_.begin()->first, order[0]);
}

glm::dmat4 BindSpace::placeOf(uint32_t node) const {
    glm::dmat4 place(1.0);
    for (uint32_t above = node; above != kNone; above = skeleton_.nodes[above].parent) {
        const auto joint = joints_.find(above);
        if (joint != joints_.end()) {
            return joint->second.place * place;
        }
        place = localMatrix(skeleton_.nodes[above]) * place;
    }
    constexpr uint32_t kItself[] = {0};
    const std::optional<glm::dmat4> beside =
        joints_.empty() ? std::nullopt : spaceBesideJoints(bindToNode(node), kItself);
    return beside.value_or(place);
}

glm::mat4 BindSpace::bindOf(uint32_t node, const glm::mat4& inverseBind, const glm::dmat4& space,
                            std::span<const glm::dvec4> placed) const {
    const glm::mat4 bind = asBind(glm::dmat4(inverseBind) * glm::inverse(space));
    const auto joint = joints_.find(node);
    if (joint == joints_.end()) {
        return bind;
    }
    // Joints that several meshes have are one if they stand in one place, but for rounding.
    const glm::mat4& known = joint->second.inverseBind;
    return isSameBind(glm::dmat4(known), glm::dmat4(bind), placed) ? known : bind;
}

bool BindSpace::placeSkinned(const glm::dmat4& space, PartCage& part, MeshBinding& mesh) const {
    const bool isSpaceMirrored = isMirrored(space);
    const std::vector<uint8_t> mirrored = mirroredVertices(part, mesh.skin, rest_, isSpaceMirrored);
    const std::vector<uint32_t> pieces = piecesOf(part.cage);
    std::vector<uint8_t> turns(pieces.size(), 1); // of a piece: all of its vertices are mirrored, as the others are not
    std::vector<uint8_t> follows(pieces.size(), 0);
    const auto follower = static_cast<uint32_t>(mesh.skinJoints());
    for (uint32_t v = 0; v < pieces.size(); ++v) {
        const uint32_t first = part.weights.starts[v];
        follows[v] = mesh.hasFollower && part.weights.influences[first].joint == follower ? 1 : 0;
        turns[pieces[v]] = turns[pieces[v]] != 0 && (mirrored[v] != 0) != isSpaceMirrored && follows[v] == 0 ? 1 : 0;
    }
    const glm::dmat4 ofFollower = mesh.hasFollower ? placeOf(mesh.node) : glm::dmat4(1.0);
    enum : uint8_t { own, following, turned };
    Placement placement(
        part, {Group(space), Group(isUsable(ofFollower) ? ofFollower : glm::dmat4(1.0)), Group(space * mirror())});
    bool isTurned = false;
    for (uint32_t v = 0; v < pieces.size(); ++v) {
        placement.set(v, follows[v] != 0 ? following : turns[pieces[v]] != 0 ? turned : own);
        isTurned = isTurned || placement.numberOf(v) == turned;
    }
    if (space == glm::dmat4(1.0) && !isTurned && (!mesh.hasFollower || ofFollower == glm::dmat4(1.0))) {
        return true;
    }
    Skin skin = mesh.skin;
    const size_t count = mesh.skinJoints();
    const Extent extent(part.cage.positions);
    std::array<glm::dvec4, 8> placed = extent.corners();
    for (glm::dvec4& corner : placed) {
        corner = space * corner;
    }
    bool exact = true;
    for (size_t j = 0; j < count && space != glm::dmat4(1.0); ++j) {
        skin.inverseBinds[j] = bindOf(skin.joints[j], skin.inverseBinds[j], space, placed);
        exact = exact && isExact(skin.inverseBinds[j], space, glm::dmat4(mesh.skin.inverseBinds[j]), extent);
    }
    if (mesh.hasFollower && isUsable(ofFollower)) {
        skin.inverseBinds.back() = asBind(glm::inverse(ofFollower));
        exact = exact && isExact(skin.inverseBinds.back(), ofFollower, glm::dmat4(1.0), extent);
    }
    const size_t firstTurned = skin.joints.size();
    for (size_t j = 0; j < count && isTurned; ++j) {
        const glm::dmat4 given(mesh.skin.inverseBinds[j]);
        skin.joints.push_back(skin.joints[j]);
        skin.inverseBinds.push_back(asBind(given * glm::inverse(space * mirror())));
        exact = exact && isExact(skin.inverseBinds.back(), space * mirror(), given, extent);
    }
    if (!exact || !placement.apply(part)) {
        return false;
    }
    for (uint32_t v = 0; v < pieces.size(); ++v) {
        for (uint32_t i = part.weights.starts[v]; i < part.weights.starts[v + 1] && placement.numberOf(v) == turned;
             ++i) {
            part.weights.influences[i].joint += static_cast<uint32_t>(firstTurned);
        }
    }
    mesh.skin = std::move(skin);
    return true;
}

bool BindSpace::place(size_t number, PartCage& part, MeshBinding& mesh) const {
    if (mesh.skinned) {
        return placeSkinned(spaces_[number], part, mesh);
    }
    const glm::dmat4 place = placeOf(mesh.node);
    if (!isUsable(place) || (alone_ && !isMirrored(place))) {
        return true;
    }
    const glm::mat4 bind = asBind(glm::inverse(place));
    if (!isExact(bind, place, glm::dmat4(1.0), Extent(part.cage.positions)) ||
        !Placement(part, {Group(place)}).apply(part)) {
        return false;
    }
    mesh.skin.inverseBinds[0] = bind;
    return true;
}

} // namespace supple::cage
