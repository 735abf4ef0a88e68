// Pose drivers of instances whose poses the host sets: what they add to morph weights, on the CPU, where such poses
// are.
#pragma once

#include "cage/character.h"
#include "shaders/pose/affine.h"
#include "skinning/clip_table.h"
#include "skinning/driver_table.h"
#include "skinning/pose.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace supple::runtime {

/// Driving allocates nothing.
class HostDrivers {
public:
    HostDrivers() = default; ///< there are none
    /// `table`: of the character's drivers, by themselves.
    HostDrivers(const cage::Character& character, std::shared_ptr<const skinning::DriverTable> table,
                uint32_t instanceCount);

    [[nodiscard]] bool any() const { return table_ != nullptr && table_->quads != 0; }

    // What the joints of an instance are turned by. Each says it for all of its drivers.
    void setBindPose(uint32_t instance);
    void setLocals(uint32_t instance, const skinning::Pose& pose);
    /// One transform for each place of the clip table.
    void setLocals(uint32_t instance, const skinning::ClipTable& table, std::span<const shared::Transform> locals);
    /// Matrices of joints in model space. What drivers look at that is no joint counts as at rest.
    void setJoints(uint32_t instance, std::span<const glm::mat4> joints);
    void takeOver(const HostDrivers& other, uint32_t count);

    /// Takes the instance's weights, one a morph target, and adds what drivers do.
    void drive(uint32_t instance, std::span<const float> weights);
    /// What drive() has made of them.
    [[nodiscard]] std::span<const float> weights(uint32_t instance) const {
        return {&weights_[instance * quads_].x, targetCount_};
    }

private:
    [[nodiscard]] std::span<const uint32_t> nodes() const {
        return table_ != nullptr ? std::span<const uint32_t>(table_->nodes) : std::span<const uint32_t>();
    }
    [[nodiscard]] std::span<glm::vec4> turns(uint32_t instance) {
        return std::span(turns_).subspan(instance * hung_.size(), hung_.size());
    }

    /// How a node that drivers look at hangs on joints.
    struct Hung {
        uint32_t joint = cage::kNone; ///< that it is; kNone: it is none
        uint32_t above = cage::kNone; ///< the next joint above; kNone: there is none
        glm::dmat3 between{1.0};      ///< from there to its parent, at rest
        glm::vec4 rest{0.0f};         ///< its rotation
        glm::dvec3 signs{1.0};        ///< of its scale at rest
    };
    /// The rotation of a node whose joints have these matrices.
    [[nodiscard]] static glm::vec4 turnOf(const Hung& node, std::span<const glm::mat4> joints);

    std::shared_ptr<const skinning::DriverTable> table_;
    size_t targetCount_ = 0, quads_ = 0; ///< of morph targets, and of four of these
    std::vector<Hung> hung_;             ///< by number of the node
    std::vector<glm::vec4> turns_;       ///< a run an instance: local rotations of these nodes
    std::vector<bool> posed_;            ///< by instance: not in the bind pose
    std::vector<glm::vec4> weights_;     ///< a run an instance: with what drivers add
};

} // namespace supple::runtime
