// The limit of a subdivision over a posed cage, and what its surfaces have in common.
#pragma once

#include "cpu/limit_nets.h"
#include "surface/subdivision_rules.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cpu {

/// So far from a corner that is not regular derivatives are taken, in the parameters of a quad or a triangle.
inline constexpr double kBesideCorner = 0x1p-30;

/// What fragments draw is the limit but where a crease is semi-sharp or ends (a dart): there it hangs on their depth.
[[nodiscard]] inline Status checkFragments(const surface::subdivision::Mesh& mesh) {
    const auto semiSharp = [](float sharpness) { return sharpness > 0.0f && sharpness < surface::kInfiniteSharpness; };
    for (const surface::subdivision::Fragment& fragment : mesh.fragments) {
        const auto first = mesh.spokeSharpness.begin() + fragment.firstSpoke, end = first + fragment.spokes();
        const bool dart = fragment.kind == surface::subdivision::FragmentKind::vertex && !fragment.open &&
                          std::count_if(first, end, [](float sharpness) { return sharpness > 0.0f; }) == 1;
        if (dart || semiSharp(fragment.centreSharpness) || std::any_of(first, end, semiSharp)) {
            return Error{ErrorCode::asset,
                         "fragments with semi-sharp creases, or with creases that end inside, have no evaluator on the "
                         "CPU: take CATMULL_CLARK or LOOP"};
        }
    }
    return success();
}

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
