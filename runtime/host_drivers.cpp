#include "runtime/host_drivers.h"

#include "skinning/driver_twin.h"
#include "skinning/rotation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_inverse.hpp>

namespace supple::runtime {

namespace {

glm::vec4 numbersOf(const glm::dquat& q) {
    return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w));
}

} // namespace

HostDrivers::HostDrivers(const cage::Character& character, uint32_t instanceCount) {
    const std::vector<cage::Node>& nodes = character.skeleton.nodes;
    const std::vector<uint32_t> noPlaces(nodes.size(), 0);
    table_ = skinning::buildDriverTable(character, noPlaces, 0);
    std::vector<uint32_t> joints(nodes.size(), cage::kNone); // the first of a node
    for (size_t j = character.skin.joints.size(); j-- > 0;) {
        joints[character.skin.joints[j]] = static_cast<uint32_t>(j);
    }
    for (const uint32_t node : table_.nodes) {
        Hung& own = hung_.emplace_back();
        own.joint = joints[node];
        own.rest = numbersOf(glm::dquat(nodes[node].rotation));
        uint32_t parent = nodes[node].parent;
        for (; parent != cage::kNone && joints[parent] == cage::kNone; parent = nodes[parent].parent) {
            const skinning::Transform rest = skinning::restTransform(nodes[parent]);
            own.between = glm::dmat3(skinning::localMatrix(nodes[parent], rest)) * own.between;
        }
        own.above = parent != cage::kNone ? joints[parent] : cage::kNone;
    }
    turns_.resize(instanceCount * table_.nodes.size());
    posed_.resize(any() ? instanceCount : 0, false);
    memory_.resize(any() ? (character.morphs.targets.size() + 3) / 4 : 0);
}

void HostDrivers::setBindPose(uint32_t instance) {
    if (any()) {
        posed_[instance] = false;
    }
}

void HostDrivers::setLocals(uint32_t instance, const skinning::Pose& pose) {
    for (size_t i = 0; i < table_.nodes.size(); ++i) {
        turns(instance)[i] = numbersOf(pose.locals[table_.nodes[i]].rotation);
        posed_[instance] = true;
    }
}

void HostDrivers::setLocals(uint32_t instance, const skinning::ClipTable& table,
                            std::span<const shared::Transform> locals) {
    for (size_t i = 0; i < table_.nodes.size(); ++i) {
        turns(instance)[i] = locals[table.places[table_.nodes[i]]].rotation;
        posed_[instance] = true;
    }
}

void HostDrivers::setJoints(uint32_t instance, std::span<const glm::mat4> joints) {
    for (size_t i = 0; i < table_.nodes.size(); ++i) {
        const Hung& own = hung_[i];
        glm::vec4 turn = own.rest;
        if (own.joint != cage::kNone) {
            const glm::dmat3 above = own.above != cage::kNone ? glm::dmat3(joints[own.above]) : glm::dmat3(1.0);
            const glm::dmat3 parent = above * own.between;
            const double flat = std::abs(glm::determinant(parent));
            if (flat > 1e-30 && std::isfinite(flat)) {
                turn = numbersOf(skinning::nearestRotation(glm::inverse(parent) * glm::dmat3(joints[own.joint])));
            }
        }
        turns(instance)[i] = turn;
        posed_[instance] = true;
    }
}

void HostDrivers::takeOver(const HostDrivers& other, uint32_t count) {
    std::copy_n(other.turns_.begin(), count * table_.nodes.size(), turns_.begin());
    std::copy_n(other.posed_.begin(), any() ? count : 0, posed_.begin());
}

std::span<const float> HostDrivers::shown(uint32_t instance, std::span<const float> weights) const {
    if (!any() || !posed_[instance] || weights.empty()) {
        return weights;
    }
    std::memcpy(memory_.data(), weights.data(), weights.size_bytes());
    const std::span<const glm::vec4> own =
        std::span(turns_).subspan(instance * table_.nodes.size(), table_.nodes.size());
    skinning::addDriven(table_.words, 0, own, memory_);
    return {&memory_[0].x, weights.size()};
}

} // namespace supple::runtime
