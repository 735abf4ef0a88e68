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
      jointOfNode_(asset.character.skeleton.nodes.size(), cage::kNone), globals_(jointOfNode_.size()),
      twin_(*asset.clipTable),
      shownTwin_(*asset.clipTable,
                 skinning::PoseLayout::of(skinning::SkinningMode::linear, asset.clipTable->jointCount, 0), 0),
      placedWords_(4 * size_t{skinning::PlaybackState::elements(0, 0)}), shown_(nodeCount_),
      posed_(capacity * nodeCount_), before_(posed_.size()), states_(capacity * stateElements_),
      undoBefore_(posed_.size()), undoStates_(states_.size()) {
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
}

void HostSprings::begin(uint32_t slot) {
    if (areTaken()) {
        copyTo(of(before_, slot), of(undoBefore_, slot));
        copyTo(stateOf(states_, slot), stateOf(undoStates_, slot));
    }
}

void HostSprings::pose(uint32_t slot, float part) {
    const std::span<const shared::Transform> from = of(before_, slot), to = of(posed_, slot);
    for (const uint32_t place : needed_) {
        shown_[place] = part < 1.0f ? between(from[place], to[place], part) : to[place];
    }
}

void HostSprings::step(uint32_t slot, const HostSteps::Due& due, uint32_t step, const glm::mat4& placement) {
    if (!areTaken()) {
        return;
    }
    pose(slot, due.ways[step]);
    skinning::SpringTwin::Step now{shared::identity(), affineOf(placement), due.steps.settles, {}};
    if (due.steps.moves && due.steps.jump != step) {
        const std::array<glm::vec4, 3>& rows = due.steps.rows[step];
        now.move = {rows[0], rows[1], rows[2]};
    }
    now.wind = due.steps.wind[step];
    twin_.step(shown_, now, stateOf(states_, slot));
}

void HostSprings::turn(std::span<glm::vec4> state, float part, std::span<skinning::Affine> palette,
                       std::span<glm::vec4> rotations) {
    twin_.show(state, part, shown_);
    shownTwin_.poseLocals(placedWords_, shown_, {});
    for (const uint32_t joint : hanging_) {
        const shared::Affine skinned = shownTwin_.skinned(joint);
        palette[joint] = {{skinned.x, skinned.y, skinned.z}};
        if (!rotations.empty()) {
            skinning::jointRotations(palette.subspan(joint, 1), rotations.subspan(joint, 1));
        }
    }
}

void HostSprings::showStep(uint32_t slot, std::span<skinning::Affine> palette, std::span<glm::vec4> rotations) {
    if (areTaken()) {
        turn(stateOf(states_, slot), 1.0f, palette, rotations);
    }
}

void HostSprings::show(uint32_t slot, float part, std::span<skinning::Affine> palette, std::span<glm::vec4> rotations) {
    copyTo(of(posed_, slot), of(before_, slot));
    copyTo(of(posed_, slot), std::span(shown_));
    turn(stateOf(states_, slot), part, palette, rotations);
}

void HostSprings::restore(uint32_t slot) {
    if (areTaken()) {
        copyTo(of(undoBefore_, slot), of(before_, slot));
        copyTo(stateOf(undoStates_, slot), stateOf(states_, slot));
    }
}

void HostSprings::takeOver(const HostSprings& other, uint32_t count) {
    if (!areTaken()) {
        return;
    }
    std::copy_n(other.posed_.begin(), count * nodeCount_, posed_.begin());
    std::copy_n(other.before_.begin(), count * nodeCount_, before_.begin());
    std::copy_n(other.states_.begin(), count * stateElements_, states_.begin());
    std::copy_n(other.undoBefore_.begin(), count * nodeCount_, undoBefore_.begin());
    std::copy_n(other.undoStates_.begin(), count * stateElements_, undoStates_.begin());
}

} // namespace supple::runtime
