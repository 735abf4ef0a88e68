// Things that move, compared with the chord between two times: skinning/clip_bounds.h has the derivation.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// A bound for the largest singular value; exact for rotations times a scale.
[[nodiscard]] double normOf(const glm::dmat3& matrix);

/// A matrix at both ends of an interval, and how far it may be from its chord in between (operator norm).
struct ChordMatrix {
    glm::dmat3 ends[2]{glm::dmat3(1.0), glm::dmat3(1.0)};
    double error = 0.0;
    double size = 1.0;   ///< norm, the larger of both ends
    double change = 0.0; ///< norm of the difference of the ends
};
[[nodiscard]] ChordMatrix chordMatrix(const glm::dmat3& first, const glm::dmat3& last, double error);
[[nodiscard]] ChordMatrix operator*(const ChordMatrix& a, const ChordMatrix& b);

/// The same of a vector.
struct ChordVector {
    glm::dvec3 ends[2]{glm::dvec3(0.0), glm::dvec3(0.0)};
    double error = 0.0;
};
[[nodiscard]] ChordVector operator*(const ChordMatrix& a, const ChordVector& x);
[[nodiscard]] ChordVector operator+(const ChordVector& a, const ChordVector& b);

/// A node's transform: its place in model space.
struct ChordNode {
    ChordMatrix linear;
    ChordVector translation;
    ChordMatrix rotation; ///< of `linear`, if that is a rotation times a positive number
    bool turns = true;    ///< whether it is
};

/// All nodes in model space, and the weights of morph targets.
struct ChordPose {
    std::vector<ChordNode> nodes;
    std::vector<double> weights[2], weightErrors;
};

/// Follows a character through a clip.
class ChordPoser {
public:
    /// `clip` null: the rest pose.
    ChordPoser(const cage::Character& character, const cage::Clip* clip);
    /// Between two times without a key in between. Right behind `first`, right before `last`.
    void pose(double first, double last, ChordPose& pose);

private:
    /// How far the channels of a node may be from their chords.
    struct NodeErrors {
        double translation = 0.0, rotation = 0.0, scale = 0.0;
    };
    void findErrors(double first, double last, ChordPose& pose);
    [[nodiscard]] ChordNode local(uint32_t node) const;

    const cage::Character& character_;
    const cage::Clip* clip_;
    std::vector<bool> turns_; ///< by node: its scale is one positive number at all times
    Pose ends_[2];
    std::vector<NodeErrors> errors_;
};

} // namespace supple::skinning
