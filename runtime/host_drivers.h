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
#include <span>
#include <vector>

namespace supple::runtime {

/// Driving allocates nothing.
class HostDrivers {
public:
    HostDrivers() = default;
    /// The character must outlive this.
    HostDrivers(const cage::Character& character, uint32_t instanceCount);

    [[nodiscard]] bool any() const { return table_.quads != 0; }

    // What the joints of an instance are turned by. Each says it for all of its drivers.
    void setBindPose(uint32_t instance);
    void setLocals(uint32_t instance, const skinning::Pose& pose);
    /// One transform for each place of the clip table.
    void setLocals(uint32_t instance, const skinning::ClipTable& table, std::span<const shared::Transform> locals);
    /// Matrices of joints in model space. What drivers look at that is no joint counts as at rest.
    void setJoints(uint32_t instance, std::span<const glm::mat4> joints);
    void takeOver(const HostDrivers& other, uint32_t count);

    /// The instance's weights with what drivers add, until the next call.
    [[nodiscard]] std::span<const float> shown(uint32_t instance, std::span<const float> weights) const;

private:
    [[nodiscard]] std::span<glm::vec4> turns(uint32_t instance) {
        return std::span(turns_).subspan(instance * table_.nodes.size(), table_.nodes.size());
    }

    /// How a node that drivers look at hangs on joints.
    struct Hung {
        uint32_t joint = cage::kNone; ///< that it is; kNone: it is none
        uint32_t above = cage::kNone; ///< the next joint above; kNone: there is none
        glm::dmat3 between{1.0};      ///< from there to its parent, at rest
        glm::vec4 rest{0.0f};         ///< its rotation
    };

    skinning::DriverTable table_;
    std::vector<Hung> hung_;       ///< by number of the node
    std::vector<glm::vec4> turns_; ///< a run an instance: local rotations of these nodes
    std::vector<bool> posed_;      ///< by instance: not in the bind pose
    mutable std::vector<glm::vec4> memory_;
};

} // namespace supple::runtime
