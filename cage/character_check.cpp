#include "cage/character_check.h"

#include "cage/limits.h"
#include "cage/materials.h"
#include "cage/message.h"
#include "cage/skeleton.h"
#include "cage/smoothing.h"
#include "cage/soft.h"
#include "cage/solved_driver.h"
#include "cage/trim.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>

namespace supple::cage {

namespace {

bool isFinite(std::span<const float> values) {
    return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}
template <class Vector>
std::span<const float> numbersOf(const std::vector<Vector>& list) {
    return {reinterpret_cast<const float*>(list.data()), list.size() * sizeof(Vector) / sizeof(float)}; // NOLINT
}
/// Whether all are below the limit.
bool below(std::span<const uint32_t> list, uint64_t limit) {
    return std::all_of(list.begin(), list.end(), [&](uint32_t one) { return one < limit; });
}
bool belowOrNone(std::span<const uint32_t> list, uint64_t limit) {
    return std::all_of(list.begin(), list.end(), [&](uint32_t one) { return one < limit || one == kNone; });
}
/// Whether the list has a start for each of `count` runs, from 0 on, every run has at least `least`, and all end at
/// `end`.
bool startsRise(std::span<const uint32_t> starts, size_t count, uint32_t least, size_t end) {
    if (starts.size() != count + 1 || starts.front() != 0 || starts.back() != end) {
        return false;
    }
    for (size_t i = 0; i < count; ++i) {
        if (starts[i + 1] < starts[i] || starts[i + 1] - starts[i] < least) {
            return false;
        }
    }
    return true;
}
bool rises(std::span<const uint32_t> list) {
    return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
}

/// Gathers faults.
class Check {
public:
    Check(std::string prefix, const Character& character) : prefix_(std::move(prefix)), character_(character) {}

    bool require(bool holds, const std::string& fault) {
        if (!holds && count_++ < kMostFaults) {
            faults_ += (faults_.empty() ? "" : "\n") + prefix_ + fault;
        }
        return holds;
    }
    [[nodiscard]] bool none() const { return faults_.empty(); }
    [[nodiscard]] Status status() const { return none() ? success() : Status(Error{ErrorCode::asset, faults_}); }

    void cage(const Cage& cage, size_t sourceVertices);
    void parts();
    void skeleton();
    void skin();
    void soft();
    void mush();
    void morphs();
    void expressions();
    void drivers();
    void springs();
    void clips();
    void materials();

private:
    void cageCorners(const Cage& cage);
    void cageFaces(const Cage& cage);
    void cageMarks(const Cage& cage);
    void channel(const Channel& channel, const std::string& name);
    bool keys(const Channel& channel, const std::string& name);
    bool texture(const Texture& texture);

    std::string prefix_;
    const Character& character_;
    static constexpr size_t kMostFaults = 32;
    std::string faults_; ///< lines
    size_t count_ = 0;
};

void Check::cage(const Cage& cage, size_t sourceVertices) {
    require(!cage.positions.empty() && cage.positions.size() <= kMaxVertices, "no vertices, or too many");
    require(faultOfCoordinates(numbersOf(cage.positions).data(), 3 * cage.positions.size()) == nullptr,
            "a position is not finite or beyond 1e+09");
    require(cage.sourceVertices.size() == sourceVertices, "sourceVertices are not one a vertex");
    const bool faces = !cage.faceStarts.empty() && cage.faceVertices.size() <= kMaxCorners &&
                       startsRise(cage.faceStarts, cage.faceStarts.size() - 1, 3, cage.faceVertices.size()) &&
                       cage.faceCount() > 0;
    if (!require(faces, "faces do not divide the corners") ||
        !require(below(cage.faceVertices, cage.positions.size()), "a corner names no vertex")) {
        return;
    }
    cageCorners(cage);
    cageFaces(cage);
    cageMarks(cage);
}

void Check::cageCorners(const Cage& cage) {
    const size_t corners = cage.cornerCount();
    const auto each = [&](size_t size) { return size == 0 || size == corners; };
    require(each(cage.cornerUvs.size()) && each(cage.cornerUvs1.size()) && each(cage.cornerColors.size()) &&
                each(cage.cornerNormals.size()) && each(cage.cornerTangents.size()) && each(cage.cornerFaceUvs.size()),
            "an attribute does not have one value a corner");
    const size_t triangles = corners - 2 * size_t{cage.faceCount()};
    require(cage.faceTriangles.empty() || cage.faceTriangles.size() == 3 * triangles,
            "triangles do not fill the faces");
    size_t at = 0;
    bool own = true; // corners of the face itself
    for (uint32_t f = 0; f < cage.faceCount() && !cage.faceTriangles.empty() && none(); ++f) {
        for (const size_t end = at + 3 * size_t{cage.sides(f) - 2}; at < end; ++at) {
            own =
                own && cage.faceTriangles[at] >= cage.faceStarts[f] && cage.faceTriangles[at] < cage.faceStarts[f + 1];
        }
    }
    require(own, "a triangle has a corner that is none of its face");
}

void Check::cageFaces(const Cage& cage) {
    const size_t faces = cage.faceCount();
    const auto each = [&](size_t size) { return size == 0 || size == faces; };
    if (!require(each(cage.faceMaterials.size()) && each(cage.faceParts.size()) && each(cage.faceTrimTiles.size()),
                 "something is not said for each face")) {
        return;
    }
    require(belowOrNone(cage.faceMaterials, character_.materials.size()), "a face has no such material");
    require(below(cage.faceParts, character_.parts.size()) &&
                std::is_sorted(cage.faceParts.begin(), cage.faceParts.end()),
            "parts of faces do not rise");
    require(belowOrNone(cage.faceTrimTiles, kMaxTrimTiles), "a face has no such trim tile");
}

void Check::cageMarks(const Cage& cage) {
    const uint32_t vertices = cage.vertexCount();
    const bool creases = std::all_of(cage.creases.begin(), cage.creases.end(), [&](const Crease& c) {
        return c.a < vertices && c.b < vertices && c.sharpness >= 0.0f &&
               (c.set == kNone || c.set < cage.creaseSets.size());
    });
    require(creases, "a crease has no such vertices, no sharpness of 0 and more, or no such set");
    require(cage.creaseSets.size() <= kMaxCreaseSets, "too many crease sets");
    const bool sharp = std::all_of(cage.sharpVertices.begin(), cage.sharpVertices.end(),
                                   [&](const SharpVertex& s) { return s.vertex < vertices && s.sharpness >= 0.0f; });
    require(sharp, "a sharp vertex is none, or has no sharpness of 0 and more");
    const bool scalars = std::all_of(cage.creaseScalars.begin(), cage.creaseScalars.end(), [&](const CreaseScalar& s) {
        return s.vertex < vertices && s.toward < vertices && s.alpha >= 0.0f && s.alpha <= 1.0f;
    });
    require(scalars, "a crease scalar has no such vertices, or an alpha that is not in [0, 1]");
    require(below(cage.roundCorners, vertices), "a round corner is no vertex");
    require(below(cage.holes, cage.faceCount()) && rises(cage.holes), "holes are no faces, or do not rise");
}

void Check::parts() {
    const std::vector<Part>& parts = character_.parts;
    if (!require(!parts.empty(), "no parts")) {
        return;
    }
    const Cage& cage = character_.cage;
    require(cage.faceParts.size() == (parts.size() > 1 ? cage.faceCount() : cage.faceParts.size()),
            "parts of faces are not given");
    for (size_t p = 0; p < parts.size(); ++p) {
        const Part& part = parts[p];
        const std::string name = at("part", p) + ": ";
        const uint32_t end = p + 1 < parts.size() ? parts[p + 1].firstFace : cage.faceCount();
        require(part.firstFace < end && end <= cage.faceCount() && (p > 0 || part.firstFace == 0), name + "no faces");
        require(part.node < character_.skeleton.nodes.size(), name + "no such node");
        require(below(part.joints, character_.skin.joints.size()), name + "no such joint");
        require(uint64_t{part.firstTarget} + part.targetCount <= character_.morphs.targets.size(),
                name + "no such morph targets");
        for (uint32_t f = part.firstFace; f < end && none() && !cage.faceParts.empty(); ++f) {
            require(cage.faceParts[f] == p, name + "a face is another part's");
        }
    }
}

void Check::skeleton() {
    const auto& [nodes, parentsFirst] = character_.skeleton;
    require(!nodes.empty() && parentsFirst.size() == nodes.size() && below(parentsFirst, nodes.size()),
            "the order of nodes is none");
    std::vector<uint32_t> depths(none() ? nodes.size() : 0, kNone);
    for (size_t i = 0; i < depths.size() && none(); ++i) {
        const Node& node = nodes[parentsFirst[i]];
        const std::string name = at("node", parentsFirst[i]) + ": ";
        const bool isRoot = node.parent == kNone;
        if (!require(depths[parentsFirst[i]] == kNone, name + "twice in the order") ||
            !require(isRoot || (node.parent < nodes.size() && depths[node.parent] != kNone),
                     name + "its parent does not come first")) {
            return;
        }
        depths[parentsFirst[i]] = isRoot ? 0 : depths[node.parent] + 1;
        require(depths[parentsFirst[i]] < kMaxNodeDepth, name + "nested too deep");
        require(isFinite({&node.translation.x, 3}) && isFinite({&node.rotation[0], 4}) &&
                    isFinite({&node.scale.x, 3}) && isFinite({&node.matrix[0][0], 16}),
                name + "not finite");
    }
}

void Check::skin() {
    const auto& [joints, inverseBinds] = character_.skin;
    require(!joints.empty() && joints.size() == inverseBinds.size() && below(joints, character_.skeleton.nodes.size()),
            "joints are no nodes, or have no inverse bind matrices");
    require(isFinite(numbersOf(inverseBinds)), "an inverse bind matrix is not finite");
    const std::vector<uint32_t>& starts = character_.weights.starts;
    const std::vector<Influence>& influences = character_.weights.influences;
    require(startsRise(starts, character_.cage.vertexCount(), 1, influences.size()), "a vertex has no influences");
    const size_t jointCount = joints.size();
    const bool sound = std::all_of(influences.begin(), influences.end(),
                                   [&](const Influence& i) { return i.joint < jointCount && std::isfinite(i.weight); });
    require(sound, "an influence names no joint, or has no finite weight");
}

void Check::soft() {
    for (size_t j = 0; j < character_.jiggles.size(); ++j) {
        require(isSound(character_.jiggles[j]), at("jiggle", j) + ": its numbers are out of range");
    }
    for (size_t c = 0; c < character_.cloths.size(); ++c) {
        require(isSound(character_.cloths[c]), at("cloth", c) + ": its numbers are out of range");
        require(below(character_.cloths[c].colliders, character_.springBones.colliders.size()),
                at("cloth", c) + ": it names no collider of spring bones");
    }
    const auto check = [&](const std::vector<PaintedWeight>& weights, size_t count, const std::string& what) {
        require(weights.empty() || weights.size() == character_.cage.vertexCount(),
                "not one weight of " + what + "s a vertex");
        require(std::all_of(weights.begin(), weights.end(),
                            [&](const PaintedWeight& own) {
                                return own.index == kNone ||
                                       (own.index < count && own.weight > 0.0f && own.weight <= 1.0f);
                            }),
                "a vertex names no " + what + ", or has no weight above 0 to 1");
    };
    check(character_.weights.jiggles, character_.jiggles.size(), "jiggle");
    check(character_.weights.cloths, character_.cloths.size(), "cloth");
}

void Check::mush() {
    for (size_t p = 0; p < character_.parts.size(); ++p) {
        const std::optional<Smoothing>& own = character_.parts[p].smoothing;
        require(!own || isSound(*own), at("part", p) + ": its smoothing's numbers are out of range");
    }
    const std::vector<float>& mask = character_.weights.mushMask;
    require(mask.empty() || mask.size() == character_.cage.vertexCount(), "not one mask of delta mush a vertex");
    require(std::all_of(mask.begin(), mask.end(), [](float own) { return own >= 0.0f && own <= 1.0f; }),
            "a mask of delta mush is not from 0 to 1");
}

void Check::morphs() {
    require(character_.morphs.weights.size() == character_.morphs.targets.size() && isFinite(character_.morphs.weights),
            "morph targets have no finite weights");
    for (size_t t = 0; t < character_.morphs.targets.size(); ++t) {
        const MorphTarget& target = character_.morphs.targets[t];
        const std::string name = at("morph target", t) + ": ";
        require(target.deltas.size() == target.vertices.size() && isFinite(numbersOf(target.deltas)),
                name + "displacements are not finite, or not one a vertex");
        require(below(target.vertices, character_.cage.vertexCount()) && rises(target.vertices),
                name + "vertices do not rise, or are none");
    }
}

bool Check::keys(const Channel& channel, const std::string& name) {
    const size_t values = channel.times.size() * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1);
    require(isFinite(channel.times) && isFinite(channel.values), name + "not finite");
    require(std::adjacent_find(channel.times.begin(), channel.times.end(), std::greater_equal<>()) ==
                channel.times.end(),
            name + "times do not rise");
    return require(values > 0 && channel.values.size() % values == 0, name + "not as many values as keys");
}

void Check::channel(const Channel& channel, const std::string& name) {
    require(channel.node < character_.skeleton.nodes.size(), name + "no such node");
    if (!keys(channel, name)) {
        return;
    }
    const size_t width = channel.width(), targets = character_.morphs.targets.size();
    const bool isWeights = channel.path == ChannelPath::weights;
    require(isWeights ? width > 0 && channel.firstTarget + width <= targets
                      : width == (channel.path == ChannelPath::rotation ? 4u : 3u),
            name + "not as many values as keys");
}

void Check::expressions() {
    const size_t targets = character_.morphs.targets.size();
    for (size_t e = 0; e < character_.expressions.size(); ++e) {
        const Expression& own = character_.expressions[e];
        const std::string name = at("expression", e) + ": ";
        require(own.targets.size() == own.weights.size() && isFinite(own.weights), name + "no finite weight a target");
        require(below(own.targets, targets) && rises(own.targets), name + "targets do not rise, or are none");
    }
}

void Check::drivers() {
    const std::vector<Node>& nodes = character_.skeleton.nodes;
    size_t work = 0;
    for (size_t d = 0; d < character_.drivers.size() && none(); ++d) {
        const PoseDriver& own = character_.drivers[d];
        const std::string name = at("driver", d) + ": ";
        const size_t inputs = own.inputs.size();
        const bool counts = inputs > 0 && inputs <= kMaxDriverInputs && !own.targets.empty() &&
                            own.targets.size() <= kMaxDriverTargets && own.poses.size() % inputs == 0 &&
                            own.poseCount() <= kMaxDriverPoses &&
                            own.values.size() == own.poseCount() * own.targets.size();
        if (!require(counts, name + "inputs, targets, poses and values do not fit")) {
            return;
        }
        const bool sound = std::all_of(own.inputs.begin(), own.inputs.end(), [&](const DriverInput& input) {
            return input.node < nodes.size() && !nodes[input.node].hasMatrix &&
                   std::abs(glm::length(glm::dvec3(input.axis)) - 1.0) < 1e-3 && input.weight >= kMinInputWeight &&
                   input.weight <= kMaxInputWeight;
        });
        require(sound, name + "an input names no node that turns, or its axis has not unit length, or its weight is "
                              "out of range");
        std::vector<uint32_t> targets = own.targets;
        std::sort(targets.begin(), targets.end());
        require(std::adjacent_find(targets.begin(), targets.end()) == targets.end(),
                name + "a morph target is there twice");
        const bool ofOnePart = std::any_of(character_.parts.begin(), character_.parts.end(), [&](const Part& part) {
            return std::all_of(own.targets.begin(), own.targets.end(), [&](uint32_t target) {
                return target >= part.firstTarget && target - part.firstTarget < part.targetCount;
            });
        });
        require(ofOnePart, name + "it names no morph targets of one part");
        const bool rotations = std::all_of(own.poses.begin(), own.poses.end(), [](const glm::vec4& q) {
            return glm::length(glm::dvec4(q)) > kMinTurnLength && glm::length(glm::dvec4(q)) < kMaxTurnLength;
        });
        require(rotations && isFinite(own.values) && own.width >= kMinDriverWidth && own.width <= kMaxDriverWidth &&
                    own.low <= 0.0f && own.low >= -kMaxCoordinate && own.high >= 0.0f && own.high <= kMaxCoordinate,
                name + "its poses are no rotations, or its numbers are not finite");
        work += driverWork(own);
        require(work <= kMaxDriverWork, tooMuchDriverWork());
        if (none()) {
            const Result<SolvedDriver> solved = solveDriver(own);
            require(solved.ok(), name + (solved ? "" : solved.error().message));
        }
    }
}

void Check::springs() {
    const size_t nodes = character_.skeleton.nodes.size();
    const SpringBones& bones = character_.springBones;
    const bool colliders = std::all_of(bones.colliders.begin(), bones.colliders.end(), [&](const SpringCollider& c) {
        return c.node < nodes && std::isfinite(c.radius) && isFinite({&c.offset.x, 3}) && isFinite({&c.tail.x, 3});
    });
    require(colliders, "a collider of spring bones names no node, or is not finite");
    for (const std::vector<uint32_t>& group : bones.colliderGroups) {
        require(below(group, bones.colliders.size()), "a collider group of spring bones names no collider");
    }
    for (size_t s = 0; s < bones.springs.size(); ++s) {
        const Spring& spring = bones.springs[s];
        const bool joints = std::all_of(spring.joints.begin(), spring.joints.end(), [&](const SpringJoint& j) {
            const float numbers[] = {j.hitRadius, j.stiffness, j.gravityPower, j.drag};
            return j.node < nodes && isFinite(numbers) && isFinite({&j.gravityDirection.x, 3});
        });
        require(joints && belowOrNone({&spring.center, 1}, nodes) &&
                    below(spring.colliderGroups, bones.colliderGroups.size()),
                at("spring", s) + ": it names no node or collider group, or is not finite");
    }
}

void Check::clips() {
    require(belowOrNone({&character_.clipRoot, 1}, character_.skeleton.nodes.size()), "no such root of clips");
    for (size_t c = 0; c < character_.clips.size(); ++c) {
        const Clip& clip = character_.clips[c];
        const std::string name = at("clip", c) + " ";
        require(std::isfinite(clip.duration) && clip.duration >= 0.0, name + "has no duration");
        require(std::isfinite(clip.packed.error) && std::isfinite(clip.packed.coarseError),
                name + "is packed with no finite error");
        for (size_t i = 0; i < clip.channels.size(); ++i) {
            channel(clip.channels[i], name + at("channel", i) + ": ");
        }
        for (const SharpnessCurve& curve : clip.sharpness) {
            const std::string of = name + "sharpness of " + quoted(curve.set) + ": ";
            if (keys(curve.keys, of)) {
                require(curve.keys.width() == 1 && curve.keys.firstTarget == 0, of + "not one value a key");
            }
        }
        const bool markers = std::all_of(clip.markers.begin(), clip.markers.end(),
                                         [](const Marker& m) { return std::isfinite(m.time); });
        require(markers && std::is_sorted(clip.markers.begin(), clip.markers.end(),
                                          [](const Marker& a, const Marker& b) { return a.time < b.time; }),
                name + "markers: times do not rise");
    }
}

bool Check::texture(const Texture& texture) {
    const auto isImage = [&](uint32_t image) { return image < character_.images.size() || image == kNone; };
    return isImage(texture.image) && isImage(texture.alternateImage) && texture.uvSet <= 1;
}

void Check::materials() {
    for (size_t m = 0; m < character_.materials.size(); ++m) {
        const Material& material = character_.materials[m];
        const std::string name = at("material", m) + ": ";
        const auto textures = texturesOf(material);
        require(std::all_of(textures.begin(), textures.end(), [&](const Texture* each) { return texture(*each); }),
                name + "a texture names no image or no UV set");
        require(!material.trim || (texture(material.trim->texture) && material.trim->channel <= 3 &&
                                   material.trim->tiles <= kMaxTrimTiles),
                name + "its trim names no image, channel or tile");
    }
}

} // namespace

Status checkCharacter(const Character& character) {
    Check check(character.name + ": ", character);
    check.cage(character.cage, character.cage.vertexCount());
    if (check.none()) { // what follows counts vertices and faces
        check.skeleton();
        check.parts();
        check.skin();
        check.soft();
        check.mush();
        check.morphs();
        check.expressions();
        check.drivers();
        check.springs();
        check.clips();
        check.materials();
    }
    return check.status();
}

Status checkPiece(const Character& character, const CagePiece& piece) {
    Check check(character.name + ": piece: ", character);
    check.cage(piece.cage, 0);
    check.require(piece.faces.size() == piece.cage.faceCount() && below(piece.faces, character.cage.faceCount()),
                  "its faces are not the whole cage's");
    check.require(piece.vertices.size() == piece.cage.vertexCount() && rises(piece.vertices) &&
                      below(piece.vertices, character.cage.vertexCount()),
                  "its vertices are not the whole cage's");
    return check.status();
}

} // namespace supple::cage
