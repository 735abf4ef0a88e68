// The polar factors of joint matrices, in double, by a way of their own.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::test {

/// matrix = rotation * stretch
struct JointFactors {
    glm::dmat3 rotation{1.0};
    glm::dmat3 stretch{1.0};
    glm::dvec3 translation{0.0};
};

inline JointFactors factorsOf(const skinning::Affine& affine) {
    glm::dmat3 matrix;
    JointFactors joint;
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

inline std::vector<JointFactors> factorsOf(std::span<const skinning::Affine> palette) {
    std::vector<JointFactors> joints;
    for (const skinning::Affine& affine : palette) {
        joints.push_back(factorsOf(affine));
    }
    return joints;
}

/// The joints that move a vertex, and the one that moves it most: the first, if several do.
struct VertexInfluences {
    VertexInfluences(const cage::SkinWeights& weights, size_t vertex)
        : all(std::span(weights.influences)
                  .subspan(weights.starts[vertex], weights.starts[vertex + 1] - weights.starts[vertex])),
          heaviest(all[0]) {
        for (const cage::Influence& i : all) {
            heaviest = i.weight > heaviest.weight ? i : heaviest;
        }
    }

    std::span<const cage::Influence> all;
    cage::Influence heaviest;
};

} // namespace supple::test
