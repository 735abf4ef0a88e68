// A limb of a character with one joint turned, and what its skin makes of it: volume, thickness, faces turned over.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace supple::test {

struct Turn {
    enum class About { hinge, bone, given };
    std::string joint;
    double degrees = 0.0;
    About about = About::hinge; ///< hinge: across the bones above and below; bone: along the one below
    glm::dvec3 axis{0.0};       ///< if it is given
    double reach = 0.0; ///< faces so near to the joint are measured, in parts of the largest extent along an axis
};

class Bend {
public:
    /// In the bind pose, with the joint turned about its place there, and all below it.
    Bend(const cage::Character& character, const Turn& turn);

    [[nodiscard]] const std::vector<skinning::Affine>& palette() const { return palette_; }
    /// Of the faces near the joint, the holes closed towards their middles; 1: as in the bind pose.
    [[nodiscard]] double volume(std::span<const glm::dvec3> skinned) const;
    /// Distances from the nearer bone, in parts of those in the bind pose: at 5 and 95 % of the vertices.
    [[nodiscard]] std::array<double, 2> thickness(std::span<const glm::dvec3> skinned) const;
    /// Triangles whose side is turned over against the blended rotation of their corners.
    [[nodiscard]] uint32_t turnedOver(std::span<const glm::dvec3> skinned) const;

private:
    void findBones(uint32_t joint);
    void takeFaces(double radius);

    [[nodiscard]] double signedVolume(std::span<const glm::dvec3> points) const;
    [[nodiscard]] double weightBelow(size_t vertex) const;

    const cage::Character& character_;
    std::vector<glm::dvec3> rest_;
    std::vector<std::array<uint32_t, 3>> triangles_;
    std::vector<std::vector<uint32_t>> loops_; ///< the borders of the triangles
    std::vector<uint32_t> vertices_;           ///< of the triangles
    std::vector<skinning::Affine> palette_;
    std::vector<uint32_t> parents_; ///< by joint
    std::vector<bool> below_;       ///< by joint: it is the turned one, or hangs on it
    glm::dvec3 at_{0.0}, up_{0.0}, down_{0.0};
    glm::dmat3 rotation_{1.0};
    glm::dquat turned_{1.0, 0.0, 0.0, 0.0};
};

} // namespace supple::test
