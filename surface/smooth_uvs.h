// Smooth texture coordinates of patches: coefficients of the same form as the surface's, of two coordinates. They
// depend on no pose (docs/smooth_uvs.md). Private to surface/.
#pragma once

#include "cage/uv_channel.h"
#include "surface/recipe.h"
#include "surface/table_writer.h"

#include <array>
#include <functional>
#include <glm/glm.hpp>

namespace supple::surface {

/// A patch's coefficients in one UV set, as its scheme's document orders them. Perturbed patches: 16 g_ij, row by row
/// in v, then four of every edge of the face: its local (2,0), (3,0), (2,1), (3,1).
struct UvPatch {
    std::array<glm::dvec2, 32> c{};
    uint32_t singularCorners = 0; ///< P_m: a bit a corner at which the surface's derivatives are parallel
};

/// Table elements of a patch and UV set; 0 of classes that have no such coefficients.
[[nodiscard]] uint32_t uvElements(PatchClass patchClass);
/// The same of tables, which may have leaves of texture coordinates (Tables::uvLeaves).
[[nodiscard]] uint32_t uvElements(const Tables& tables, PatchClass patchClass);

/// Whether triangles of leaves may have semi-sharp creases in their texture coordinates. All of them have the sharpness
/// of their sides in their records then.
[[nodiscard]] bool haveSharpUvs(const Tables& tables);

/// The UV sets that a cage has: one entry per corner each.
[[nodiscard]] std::vector<const std::vector<glm::vec2>*> uvSetsOf(const cage::Cage& cage);

/// Writes all patches' coefficients behind the corner attributes, in device order, if the recipe asks for smooth
/// texture coordinates and the cage has any. `makeSet`: what gives the coefficients of a patch in a UV set.
using UvPatches = std::function<UvPatch(const DraftPatch&)>;
[[nodiscard]] Status writeSmoothUvs(const Recipe& recipe, const cage::Cage& cage,
                                    const std::vector<DraftPatch>& patches,
                                    const std::function<Result<UvPatches>(const std::vector<glm::vec2>&)>& makeSet,
                                    TableWriter& writer, Tables& tables);

} // namespace supple::surface
