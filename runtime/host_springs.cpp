#include "runtime/host_springs.h"

#include "cage/skeleton.h"
#include "skinning/playback.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>

namespace supple::runtime {

namespace {

template <class T>
void copyTo(std::span<T> from, std::span<T> to) {
    std::copy(from.begin(), from.end(), to.begin());
}

/// Rows of a column-major matrix.
shared::Affine affineOf(const glm::mat4& m) {
    const glm::mat4 rows = glm::transpose(m);
    return {rows[0], rows[1], rows[2]};
}

/// What shears is lost.
shared::Transform transformOf(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    const glm::dquat q = skinning::nearestRotation(linear);
    const glm::dmat3 within = glm::transpose(glm::mat3_cast(q)) * linear;
    return {glm::vec3(m[3]), skinning::floatsOf(q), glm::vec3(glm::dvec3(within[0][0], within[1][1], within[2][2]))};
}

shared::Transform between(const shared::Transform& a, const shared::Transform& b, float part) {
    const float side = glm::dot(a.rotation, b.rotation) < 0.0f ? -1.0f : 1.0f;
    return {a.translation + (b.translation - a.translation) * part,
            shared::unit(a.rotation * (1.0f - part) + b.rotation * (side * part)),
            a.scale + (b.scale - a.scale) * part};
}

} // namespace

HostSprings::HostSprings(const Asset& asset, uint32_t capacity)
    : asset_(&asset), nodeCount_(asset.clipTable->nodes.size()),
      stateElements_(skinning::SpringTwin::stateElements(*asset.clipTable)),
      jointOfNode_(asset.character.skeleton.nodes.size(), cage::kNone), globals_(jointOfNode_.size()), clock_(capacity),
      twin_(*asset.clipTable),
      shownTwin_(*asset.clipTable,
                 skinning::PoseLayout::of(skinning::SkinningMode::linear, asset.clipTable->jointCount, 0), 0),
      placedWords_(4 * size_t{skinning::PlaybackState::elements(0, 0)}), shown_(nodeCount_),
      posed_(capacity * nodeCount_), before_(posed_.size()), states_(capacity * stateElements_), slots_(capacity),
      undoBefore_(posed_.size()), undoStates_(states_.size()), undoSlots_(capacity) {
    undone_.reserve(capacity);
    const skinning::ClipTable& table = *asset.clipTable;
    const auto flags = [&](size_t place) { return table.words[4 * place * shared::kNodeElements + 1]; };
    for (uint32_t j = 0; j < table.jointCount; ++j) {
        const uint32_t node = asset.character.skin.joints[j];
        jointOfNode_[node] = j;
        if ((flags(table.places[node]) & shared::kNodeInChain) != 0) {
            hanging_.push_back(j);
        }
    }
    for (uint32_t place = 0; place < nodeCount_; ++place) {
        if ((flags(place) & (shared::kNodeInChain | shared::kNodeOfSprings)) != 0) {
            needed_.push_back(place);
        }
    }
    skinning::PlaybackState(placedWords_).setTransform(glm::mat4(1.0f));
}

void HostSprings::setPose(uint32_t slot, std::span<const shared::Transform> locals) {
    if (areTaken()) {
        std::copy(locals.begin(), locals.end(), of(posed_, slot).begin());
        slots_[slot].isPosed = true;
    }
}

void HostSprings::setJoints(uint32_t slot, std::span<const glm::mat4> joints) {
    if (!areTaken()) {
        return;
    }
    const std::vector<cage::Node>& nodes = asset_->character.skeleton.nodes;
    const auto above = [&](uint32_t node) {
        return nodes[node].parent != cage::kNone ? globals_[nodes[node].parent] : glm::dmat4(1.0);
    };
    for (const uint32_t node : asset_->character.skeleton.parentsFirst) {
        const uint32_t joint = jointOfNode_[node];
        globals_[node] =
            joint != cage::kNone ? glm::dmat4(joints[joint]) : above(node) * cage::localMatrix(nodes[node]);
    }
    for (const uint32_t place : needed_) {
        const uint32_t node = asset_->clipTable->nodes[place];
        const glm::dmat4 parent = above(node);
        // Below what is flat, nothing shows where a node is.
        const bool flat = !(std::abs(glm::determinant(glm::dmat3(parent))) > 1e-30);
        of(posed_, slot)[place] =
            transformOf(flat ? cage::localMatrix(nodes[node]) : glm::inverse(parent) * globals_[node]);
    }
    slots_[slot].isPosed = true;
}

void HostSprings::setBindPose(uint32_t slot) {
    if (areTaken()) {
        slots_[slot].isPosed = false;
        clock_.settle(slot);
    }
}

void HostSprings::setTime(uint64_t frame, double time) {
    if (frame_ != frame) {
        timeBefore_ = time_;
        frame_ = frame;
        undone_.clear();
    }
    time_ = time;
}

void HostSprings::keepForUndo(uint32_t slot) {
    if (slots_[slot].frame == frame_) {
        return;
    }
    undone_.push_back(slot);
    undoSlots_[slot] = slots_[slot];
    slots_[slot].frame = frame_;
    copyTo(of(before_, slot), of(undoBefore_, slot));
    copyTo(stateOf(states_, slot), stateOf(undoStates_, slot));
}

void HostSprings::pose(uint32_t slot, double part) {
    const std::span<const shared::Transform> from = of(before_, slot), to = of(posed_, slot);
    for (const uint32_t place : needed_) {
        shown_[place] = part < 1.0 ? between(from[place], to[place], static_cast<float>(part)) : to[place];
    }
}

bool HostSprings::swing(uint32_t slot, const SpringPlace& place, const glm::mat4& placement) {
    if (!areTaken() || !slots_[slot].isPosed) {
        return false;
    }
    keepForUndo(slot);
    Slot& own = slots_[slot];
    const SpringClock::Due due = clock_.take(slot, frame_, time_, place, false);
    const std::span<glm::vec4> state = stateOf(states_, slot);
    const double span = time_ - own.time;
    for (uint32_t k = 0; k < due.count; ++k) {
        const bool onTheWay = !due.settles && span > 0.0 && k < due.jump; // none: behind all
        pose(slot, onTheWay ? (springTime(due.first + k) - own.time) / span : 1.0);
        skinning::SpringTwin::Step now{shared::identity(), affineOf(placement), due.settles};
        if (due.moves && due.jump != k) {
            now.move = {due.rows[k][0], due.rows[k][1], due.rows[k][2]};
        }
        twin_.step(shown_, now, state);
    }
    own.time = time_;
    copyTo(of(posed_, slot), of(before_, slot));
    copyTo(of(posed_, slot), std::span(shown_));
    twin_.show(state, due.part, shown_);
    shownTwin_.poseLocals(placedWords_, shown_, {});
    return true;
}

void HostSprings::show(std::span<skinning::Affine> palette, std::span<glm::vec4> rotations) const {
    for (const uint32_t joint : hanging_) {
        const shared::Affine skinned = shownTwin_.skinned(joint);
        palette[joint] = {{skinned.x, skinned.y, skinned.z}};
        if (!rotations.empty()) {
            skinning::jointRotations(palette.subspan(joint, 1), rotations.subspan(joint, 1));
        }
    }
}

void HostSprings::cancelFrame(uint64_t frame) {
    if (frame_ != frame) {
        return;
    }
    clock_.cancelFrame(frame);
    time_ = timeBefore_;
    for (const uint32_t slot : undone_) {
        undoSlots_[slot].isPosed = slots_[slot].isPosed; // by calls since then
        slots_[slot] = undoSlots_[slot];
        copyTo(of(undoBefore_, slot), of(before_, slot));
        copyTo(stateOf(undoStates_, slot), stateOf(states_, slot));
    }
    undone_.clear();
}

void HostSprings::takeOver(const HostSprings& other, uint32_t count) {
    if (!areTaken()) {
        return;
    }
    clock_.takeOver(other.clock_, count);
    time_ = other.time_;
    std::copy_n(other.posed_.begin(), count * nodeCount_, posed_.begin());
    std::copy_n(other.before_.begin(), count * nodeCount_, before_.begin());
    std::copy_n(other.states_.begin(), count * stateElements_, states_.begin());
    std::copy_n(other.slots_.begin(), count, slots_.begin());
}

} // namespace supple::runtime
