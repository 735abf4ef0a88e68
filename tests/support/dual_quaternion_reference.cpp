#include "tests/support/dual_quaternion_reference.h"

#include "tests/support/joint_factors.h"

#include <glm/gtc/quaternion.hpp>

namespace supple::test {

namespace {

struct DualQuaternion {
    glm::dquat real{0.0, 0.0, 0.0, 0.0};
    glm::dquat dual{0.0, 0.0, 0.0, 0.0};
};

} // namespace

std::vector<glm::dvec3> skinWithDualQuaternions(std::span<const glm::dvec3> positions, const cage::SkinWeights& weights,
                                                std::span<const skinning::Affine> palette,
                                                const glm::dmat4& transform) {
    const std::vector<JointFactors> joints = factorsOf(palette);
    std::vector<glm::dvec3> skinned;
    for (size_t v = 0; v < positions.size(); ++v) {
        const glm::dvec3& p = positions[v];
        const VertexInfluences influences(weights, v);
        const glm::dquat side = glm::quat_cast(joints[influences.heaviest.joint].rotation);
        DualQuaternion blend;
        for (const cage::Influence& i : influences.all) {
            const JointFactors& joint = joints[i.joint];
            // Stretched about itself the vertex stays; this translation and the rotation then take it where the joint
            // does.
            const glm::dvec3 translation = joint.translation + joint.rotation * (joint.stretch * p - p);
            const glm::dquat real = glm::quat_cast(joint.rotation);
            const glm::dquat dual = 0.5 * (glm::dquat(0.0, translation.x, translation.y, translation.z) * real);
            const double weight = static_cast<double>(i.weight) * (glm::dot(real, side) < 0.0 ? -1.0 : 1.0);
            blend.real = blend.real + weight * real;
            blend.dual = blend.dual + weight * dual;
        }
        const double length = glm::length(blend.real);
        const glm::dquat real = blend.real / length, dual = blend.dual / length;
        const glm::dvec3 a(real.x, real.y, real.z), b(dual.x, dual.y, dual.z);
        const glm::dvec3 moved = 2.0 * (real.w * b - dual.w * a + glm::cross(a, b));
        const glm::dvec3 result = p + 2.0 * glm::cross(a, glm::cross(a, p) + real.w * p) + moved;
        skinned.emplace_back(transform * glm::dvec4(result, 1.0));
    }
    return skinned;
}

} // namespace supple::test
