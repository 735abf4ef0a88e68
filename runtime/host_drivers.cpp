#include "runtime/host_drivers.h"

#include "skinning/driver_twin.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_inverse.hpp>
#include <utility>

namespace supple::runtime {

namespace {

/// There are two directions at least that it does not make flat.
bool tellsRotation(const glm::dmat3& matrix) {
    constexpr double kFlat = 1e-9; // by the square of its size
    const double size =
        std::max({glm::dot(matrix[0], matrix[0]), glm::dot(matrix[1], matrix[1]), glm::dot(matrix[2], matrix[2])});
    const double area =
        std::max({glm::length(glm::cross(matrix[0], matrix[1])), glm::length(glm::cross(matrix[1], matrix[2])),
                  glm::length(glm::cross(matrix[2], matrix[0]))});
    return area > kFlat * size && std::isfinite(area);
}

} // namespace

HostDrivers::HostDrivers(const cage::Character& character, std::shared_ptr<const skinning::DriverTable> table,
                         uint32_t instanceCount)
    : table_(std::move(table)), targetCount_(character.morphs.targets.size()), quads_((targetCount_ + 3) / 4),
      turns_(instanceCount * table_->nodes.size()), posed_(instanceCount, false), weights_(instanceCount * quads_) {
    const std::vector<cage::Node>& nodes = character.skeleton.nodes;
    std::vector<uint32_t> joints(nodes.size(), cage::kNone); // the first of a node
    for (size_t j = character.skin.joints.size(); j-- > 0;) {
        joints[character.skin.joints[j]] = static_cast<uint32_t>(j);
    }
    for (const uint32_t node : table_->nodes) {
        Hung& own = hung_.emplace_back();
        own.joint = joints[node];
        own.rest = skinning::floatsOf(glm::dquat(nodes[node].rotation));
        for (int axis = 0; axis < 3; ++axis) {
            own.signs[axis] = nodes[node].scale[axis] < 0.0f ? -1.0 : 1.0;
        }
        uint32_t parent = nodes[node].parent;
        for (; parent != cage::kNone && joints[parent] == cage::kNone; parent = nodes[parent].parent) {
            const skinning::Transform rest = skinning::restTransform(nodes[parent]);
            own.between = glm::dmat3(skinning::localMatrix(nodes[parent], rest)) * own.between;
        }
        own.above = parent != cage::kNone ? joints[parent] : cage::kNone;
    }
}

void HostDrivers::setBindPose(uint32_t instance) {
    if (any()) {
        posed_[instance] = false;
    }
}

void HostDrivers::setLocals(uint32_t instance, const skinning::Pose& pose) {
    for (size_t i = 0; i < nodes().size(); ++i) {
        turns(instance)[i] = skinning::floatsOf(pose.locals[nodes()[i]].rotation);
        posed_[instance] = true;
    }
}

void HostDrivers::setLocals(uint32_t instance, const skinning::ClipTable& table,
                            std::span<const shared::Transform> locals) {
    for (size_t i = 0; i < nodes().size(); ++i) {
        turns(instance)[i] = locals[table.places[nodes()[i]]].rotation;
        posed_[instance] = true;
    }
}

void HostDrivers::setJoints(uint32_t instance, std::span<const glm::mat4> joints) {
    for (size_t i = 0; i < hung_.size(); ++i) {
        turns(instance)[i] = turnOf(hung_[i], joints);
        posed_[instance] = true;
    }
}

glm::vec4 HostDrivers::turnOf(const Hung& node, std::span<const glm::mat4> joints) {
    if (node.joint == cage::kNone) {
        return node.rest;
    }
    const glm::dmat3 above = node.above != cage::kNone ? glm::dmat3(joints[node.above]) : glm::dmat3(1.0);
    const glm::dmat3 parent = above * node.between;
    const double volume = std::abs(glm::determinant(parent));
    if (!(volume > 1e-30) || !std::isfinite(volume)) {
        return node.rest;
    }
    glm::dmat3 local = glm::inverse(parent) * glm::dmat3(joints[node.joint]);
    for (int axis = 0; axis < 3; ++axis) { // a mirror would count as half a turn
        local[axis] *= node.signs[axis];
    }
    return tellsRotation(local) ? skinning::floatsOf(skinning::nearestRotation(local)) : node.rest;
}

void HostDrivers::takeOver(const HostDrivers& other, uint32_t count) {
    std::copy_n(other.turns_.begin(), count * hung_.size(), turns_.begin());
    std::copy_n(other.posed_.begin(), any() ? count : 0, posed_.begin());
}

void HostDrivers::drive(uint32_t instance, std::span<const float> weights) {
    if (!any()) {
        return;
    }
    const std::span<glm::vec4> own = std::span(weights_).subspan(instance * quads_, quads_);
    std::memcpy(own.data(), weights.data(), weights.size_bytes());
    if (posed_[instance]) {
        skinning::addDriven(table_->words, 0, turns(instance), own);
    }
}

} // namespace supple::runtime
