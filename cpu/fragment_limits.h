// Whether what fragments draw is the limit of the subdivision.
#pragma once

#include "base/result.h"
#include "surface/subdivision/mesh.h"
#include "surface/subdivision_rules.h"

#include <algorithm>

namespace supple::cpu {

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

} // namespace supple::cpu
