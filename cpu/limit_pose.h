// The limit of a subdivision over a posed cage, and what its surfaces have in common.
#pragma once

#include "cpu/limit_nets.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cpu {

/// So far from a corner that is not regular derivatives are taken, in the parameters of a quad or a triangle.
inline constexpr double kBesideCorner = 0x1p-30;

/// A LimitPose that takes the cage as hosts have it.
class PosedLimitOfCage {
public:
    explicit PosedLimitOfCage(const surface::subdivision::LimitShape& shape) : pose_(shape) {}

    [[nodiscard]] Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs) {
        positions_.assign(cage.begin(), cage.end());
        return pose_.build(positions_, runJobs);
    }
    [[nodiscard]] const surface::subdivision::LimitPose& pose() const { return pose_; }

private:
    std::vector<glm::dvec3> positions_;
    surface::subdivision::LimitPose pose_;
};

} // namespace supple::cpu
