#include "tests/support/dual_quaternion_reference.h"

#include <glm/gtc/quaternion.hpp>

namespace supple::test {

namespace {

struct Joint {
    glm::dmat3 rotation{1.0};
    glm::dmat3 stretch{1.0}; ///< matrix = rotation * stretch
    glm::dvec3 translation{0.0};
};

Joint split(const skinning::Affine& affine) {
    glm::dmat3 matrix;
    Joint joint;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            matrix[column][row] = static_cast<double>(affine.rows[row][column]);
        }
        joint.translation[row] = static_cast<double>(affine.rows[row].w);
    }
    // Newton's iteration for the orthogonal polar factor; a reflection goes into the stretch.
    joint.rotation = glm::determinant(matrix) < 0.0 ? -matrix : matrix;
    for (int i = 0; i < 60; ++i) {
        joint.rotation = 0.5 * (joint.rotation + glm::transpose(glm::inverse(joint.rotation)));
    }
    joint.stretch = glm::transpose(joint.rotation) * matrix;
    return joint;
}

struct DualQuaternion {
    glm::dquat real{0.0, 0.0, 0.0, 0.0};
    glm::dquat dual{0.0, 0.0, 0.0, 0.0};
};

} // namespace

std::vector<glm::dvec3> skinWithDualQuaternions(std::span<const glm::dvec3> positions, const cage::SkinWeights& weights,
                                                std::span<const skinning::Affine> palette,
                                                const glm::dmat4& transform) {
    std::vector<Joint> joints;
    for (const skinning::Affine& affine : palette) {
        joints.push_back(split(affine));
    }
    std::vector<glm::dvec3> skinned;
    for (size_t v = 0; v < positions.size(); ++v) {
        const glm::dvec3& p = positions[v];
        const std::span<const cage::Influence> influences =
            std::span(weights.influences).subspan(weights.starts[v], weights.starts[v + 1] - weights.starts[v]);
        cage::Influence heaviest = influences[0];
        for (const cage::Influence& i : influences) {
            heaviest = i.weight > heaviest.weight ? i : heaviest;
        }
        const glm::dquat side = glm::quat_cast(joints[heaviest.joint].rotation);
        DualQuaternion blend;
        for (const cage::Influence& i : influences) {
            const Joint& joint = joints[i.joint];
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
