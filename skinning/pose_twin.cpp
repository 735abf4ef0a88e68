#include "skinning/pose_twin.h"

#include "shaders/pose/affine.h"
#include "shaders/pose/knots.h"
#include "shaders/pose/limbs.h"
#include "shaders/pose/straight.h"
#include "shaders/pose/time.h"
#include "shaders/shared/pose.h"
#include "skinning/driver_twin.h"
#include "skinning/playback.h"
#include "skinning/split_time.h"

#include <bit>

namespace supple::twin {

using namespace shared;

namespace {

/// What GLSL has from shaders/pose/tables.glsl.
struct PoseLoads {
    const uint32_t* tableWords = nullptr;
    const uint32_t* stateWords = nullptr;
    const float* masks = nullptr;
    PosePush push;

    [[nodiscard]] vec2 posedTime() const { return {push.timeHigh, push.timeLow}; }
    [[nodiscard]] uvec4 table(uint i) const { return elementOf(tableWords, i); }
    [[nodiscard]] uvec4 state(uint i) const { return elementOf(stateWords, i); }
    [[nodiscard]] vec4 tableFloats(uint i) const { return floatsOf(table(i)); }
    [[nodiscard]] vec4 stateFloats(uint i) const { return floatsOf(state(i)); }
    [[nodiscard]] vec4 maskValues(uint i) const {
        const float* const v = masks + 4 * size_t{i};
        return {v[0], v[1], v[2], v[3]};
    }
    [[nodiscard]] static float component(const vec4& v, uint k) { return v[static_cast<int>(k)]; }
    [[nodiscard]] float packedFloat(uint first, uint i) const { return component(tableFloats(first + i / 4), i % 4); }

private:
    static uvec4 elementOf(const uint32_t* words, uint i) {
        const uint32_t* const w = words + 4 * size_t{i};
        return {w[0], w[1], w[2], w[3]};
    }
    static vec4 floatsOf(const uvec4& w) {
        return {uintBitsToFloat(w.x), uintBitsToFloat(w.y), uintBitsToFloat(w.z), uintBitsToFloat(w.w)};
    }
};

template <bool roots>
struct PoseCode : PoseLoads {
    static constexpr bool kAdds = true, kRoots = roots, kTransitions = true, kKeyedClips = true, kPackedClips = true,
                          kCoarseTwins = true;
#include "shaders/pose/contacts.h"
#include "shaders/pose/layers.h"
#include "shaders/pose/transition.h"
};

/// Modifiers, on locals that lie in memory.
struct ModifyCode : PoseLoads {
    Transform* locals = nullptr;
    Affine place;
    vec4* held = nullptr;

    [[nodiscard]] Transform nodeLocal(uint node) const { return locals[node]; }
    void keepTranslation(uint node, const vec3& translation) const { locals[node].translation = translation; }
    void keepRotation(uint node, const vec4& rotation) const { locals[node].rotation = rotation; }
    [[nodiscard]] Affine placement() const { return place; }
    [[nodiscard]] vec4 heldAt(uint foot) const { return held[foot]; }
    void keepHeld(uint foot, const vec4& own) const { held[foot] = own; }
#include "shaders/pose/modify.h"
};

Affine affineOf(const PoseLoads& loads, uint first) {
    return rowsOf(loads.tableFloats(first), loads.tableFloats(first + 1), loads.tableFloats(first + 2));
}

glm::mat4 matrixOf(const Affine& m) {
    return glm::transpose(glm::mat4(m.x, m.y, m.z, vec4(0.0f, 0.0f, 0.0f, 1.0f)));
}

} // namespace
} // namespace supple::twin

namespace supple::skinning {

using namespace shared;

PoseTwin::PoseTwin(const ClipTable& table, const PoseLayout& layout, uint32_t transition)
    : table_(&table), layout_(layout) {
    push_.nodeCount = static_cast<uint32_t>(table.nodes.size());
    push_.jointCount = table.jointCount;
    push_.morphCount = layout.morphCount;
    push_.joints = table.joints;
    push_.levels = table.levels;
    push_.levelCount = table.levelCount;
    push_.restWeights = table.restWeights;
    push_.clips = table.clips;
    push_.maskStride = maskElements(table);
    push_.transition = transition;
    push_.contacts = table.contacts;
    push_.footCount = table.footCount;
    locals_.resize(table.nodes.size());
    globals_.resize(table.nodes.size());
    weights_.resize((layout.morphCount + 3) / 4);
    shownWeights_.resize(weights_.size());
    held_.resize(table.footCount);
    driverTurns_.resize(table.driverNodes.size());
}

void PoseTwin::pose(std::span<const uint32_t> state, std::span<const float> masks, double time, Stands stands) {
    sample(state, masks, time, stands);
    if (bindPose_) {
        shownWeights_ = weights_;
    } else {
        finish(state);
    }
}

void PoseTwin::sample(std::span<const uint32_t> state, std::span<const float> masks, double time, Stands stands) {
    const SplitTime split = splitTime(time);
    push_.timeHigh = split.high;
    push_.timeLow = split.low;
    const twin::PoseLoads loads{table_->words.data(), state.data(), masks.data(), push_};
    twin::PoseCode<false> code{loads};
    for (uint32_t quad = 0; quad < weights_.size(); ++quad) {
        weights_[quad] = code.shownWeights(0, quad, code.morphWeights(0, quad));
    }
    place_ = stands == Stands::placed ? code.transformOf(0) : identity();
    const glm::uvec4 header = loads.state(0);
    bindPose_ = (header.y & kStateBindPose) != 0;
    if (bindPose_) {
        return;
    }
    auto none = code.standing();
    for (uint32_t node = 0; node < push_.nodeCount; ++node) {
        locals_[node] = code.shownTransform(0, node, code.posedTransform(0, node, none));
    }
    if (header.w != 0) {
        twin::PoseCode<true> roots{loads};
        auto sinceBegin = roots.standing();
        const shared::Transform root = roots.posedTransform(0, header.z, sinceBegin);
        locals_[header.z] = roots.shownTransform(0, header.z, root);
        if ((header.y & kStateTravels) != 0) {
            place_ = roots.travelled(0, place_, sinceBegin);
        }
    }
    if (header.y >> kStateModifierShift != 0) {
        twin::PoseCode<true> feet{loads};
        for (uint32_t foot = 0; foot < push_.footCount; ++foot) {
            held_[foot] = feet.heldFoot(0, foot);
        }
    }
}

void PoseTwin::poseLocals(std::span<const uint32_t> state, std::span<const shared::Transform> locals,
                          std::span<const glm::vec4> held) {
    const twin::PoseLoads loads{table_->words.data(), state.data(), nullptr, push_};
    place_ = twin::PoseCode<false>{loads}.transformOf(0);
    bindPose_ = false;
    std::copy(locals.begin(), locals.end(), locals_.begin());
    std::copy(held.begin(), held.end(), held_.begin());
    finish(state);
}

void PoseTwin::hold(const cage::Character& character, const Rig& rig, const Layer& layer, const RootSelection& root,
                    std::span<glm::vec4> held) const {
    if (held.empty() || layer.mode == LayerMode::additive || layer.weight == 0.0) {
        return;
    }
    twin::PoseCode<true> code{{table_->words.data(), nullptr, nullptr, push_}};
    const bool rooted = root.axes != 0 && root.node != cage::kNone;
    const auto clip = static_cast<uint32_t>(layer.clip - character.clips.data());
    const SplitTime time = splitTime(layer.loop ? loopTime(layer.time, layer.clip->duration).time : layer.time);
    const RootPlace begin = rooted ? rootPlaceAt(character, *layer.clip, root.node, 0.0) : RootPlace();
    const glm::dquat& q = begin.rotation;
    const glm::vec4 rotation(glm::dvec4(q.x, q.y, q.z, q.w));
    const uint32_t node = rooted ? table_->places[root.node] : kNoNode;
    for (uint32_t foot = 0; foot < held.size(); ++foot) {
        const glm::vec4 own = code.heldInClip(clip, {time.high, time.low}, foot, node, rooted ? root.axes : 0u,
                                              glm::vec3(begin.position), rotation);
        const auto weight = static_cast<float>(layerWeight(rig, layer, table_->nodes[table_->footPlace(foot)]));
        held[foot] = weight != 0.0f ? code.heldMix(held[foot], own, weight) : held[foot];
    }
}

void PoseTwin::finish(std::span<const uint32_t> state) {
    const twin::PoseLoads loads{table_->words.data(), state.data(), nullptr, push_};
    twin::ModifyCode code{loads, locals_.data(), place_, held_.data()};
    code.modifyInstance(0);
    drive();
    for (uint32_t node = 0; node < push_.nodeCount; ++node) {
        const uint32_t parent = code.parentOf(node);
        const shared::Affine local = code.localMatrix(node, locals_[node]);
        globals_[node] = parent == kNoNode ? local : combined(globals_[parent], local);
    }
}

void PoseTwin::drive() {
    shownWeights_ = weights_;
    if (table_->drivers == 0 || weights_.empty()) {
        return;
    }
    for (size_t i = 0; i < driverTurns_.size(); ++i) {
        driverTurns_[i] = locals_[table_->places[table_->driverNodes[i]]].rotation;
    }
    addDriven(table_->words, table_->drivers, driverTurns_, shownWeights_);
}

const shared::Affine& PoseTwin::nodeOf(uint32_t joint) const {
    return globals_[table_->words[4 * size_t{table_->joints + kJointElements * joint + 3}]];
}

glm::mat4 PoseTwin::joint(uint32_t joint) const {
    return twin::matrixOf(nodeOf(joint));
}

glm::mat4 PoseTwin::placedJoint(uint32_t joint) const {
    return twin::matrixOf(combined(place_, nodeOf(joint)));
}

shared::Affine PoseTwin::skinned(uint32_t joint) const {
    const twin::PoseLoads loads{table_->words.data(), nullptr, nullptr, push_};
    return combined(nodeOf(joint), twin::affineOf(loads, push_.joints + kJointElements * joint));
}

glm::mat4 PoseTwin::placedJointBetween(const PoseTwin& later, float part, std::span<const uint32_t> state,
                                       uint32_t joint) const {
    twin::PoseCode<false> code{{table_->words.data(), state.data(), nullptr, push_}};
    const shared::Affine between =
        straight(combined(place_, nodeOf(joint)), combined(later.place_, later.nodeOf(joint)), part);
    return twin::matrixOf(combined(code.transformOf(0), between));
}

void PoseTwin::writeBetween(const PoseTwin& later, float part, std::span<const uint32_t> state,
                            std::span<glm::vec4> pose) const {
    twin::PoseCode<false> code{{table_->words.data(), state.data(), nullptr, push_}};
    const shared::Affine transform = code.transformOf(0);
    const bool rotations = layout_.hasRotations();
    if (rotations) {
        put(combined(transform, straight(place_, later.place_, part)), pose, 0);
    }
    for (uint32_t joint = 0; joint < push_.jointCount; ++joint) {
        const shared::Affine a = own(joint), b = later.own(joint);
        if (rotations) {
            const size_t at = kRotationTransform + kRotationElements * size_t{joint};
            put(straight(a, b, part), pose, at);
            pose[at + 3] = straightRotation(rotationOf(a), rotationOf(b), part);
        } else {
            const shared::Affine between = straight(combined(place_, a), combined(later.place_, b), part);
            put(combined(transform, between), pose, kLinearElements * size_t{joint});
        }
    }
    const bool hosts = table_->drivers == 0 && (code.state(0).y & kStateHostWeights) != 0;
    for (size_t quad = 0; quad < weights_.size(); ++quad) {
        pose[layout_.morphWeights + quad] = hosts ? code.morphWeights(0, static_cast<uint32_t>(quad))
                                                  : straight(shownWeights_[quad], later.shownWeights_[quad], part);
    }
}

void PoseTwin::put(const shared::Affine& m, std::span<glm::vec4> pose, size_t at) {
    pose[at] = m.x;
    pose[at + 1] = m.y;
    pose[at + 2] = m.z;
}

shared::Affine PoseTwin::own(uint32_t joint) const {
    return bindPose_ ? identity() : skinned(joint);
}

void PoseTwin::write(std::span<glm::vec4> pose) const {
    const bool rotations = layout_.hasRotations();
    if (rotations) {
        put(place_, pose, 0);
    }
    for (uint32_t joint = 0; joint < push_.jointCount; ++joint) {
        const shared::Affine m = own(joint);
        if (rotations) {
            const size_t at = kRotationTransform + kRotationElements * size_t{joint};
            put(m, pose, at);
            pose[at + 3] = rotationOf(m);
        } else {
            put(combined(place_, m), pose, kLinearElements * size_t{joint});
        }
    }
    std::copy(shownWeights_.begin(), shownWeights_.end(), pose.begin() + layout_.morphWeights);
}

} // namespace supple::skinning
