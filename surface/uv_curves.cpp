#include "surface/uv_curves.h"

#include "shaders/shared/pm.h"
#include "shaders/shared/prep.h"
#include "surface/smooth_uvs.h"

#include <array>
#include <bit>
#include <functional>
#include <glm/glm.hpp>

namespace supple::surface {

namespace {

/// As evaluate/edge.comp has positions: a cubic, and two coefficients of the perturbation.
struct UvCurve {
    std::array<glm::vec2, 6> along{}, across{};
};
using UvCoefficient = std::function<glm::vec2(uint32_t)>;

UvCurve sectorUvCurve(const UvCoefficient& c, uint32_t sides, uint32_t side) {
    const uint32_t own = 1 + 6 * side, next = 1 + 6 * ((side + 1) % sides);
    const uint32_t last = 1 + 6 * ((side + sides - 1) % sides);
    const glm::vec2 t0 = c(own + 1), t1 = c(own + 2), chord = c(next) - c(own);
    const auto ray = static_cast<float>(SUPPLE_PM_RAY_SIDE(sides));
    UvCurve curve;
    curve.along = {c(own), c(own) + t0, c(next) + t1, c(next)};
    curve.across = {0.75f * ray * (t0 + c(last + 2)), c(own + 3) - 0.75f * t0, c(own + 4) + 0.5f * (chord - (t0 + t1)),
                    0.75f * (ray * (t1 + c(next + 1)) - t1)};
    return curve;
}

UvCurve bicubicUvCurve(const UvCoefficient& c, PatchClass patchClass, uint32_t side) {
    const bool polar = patchClass == PatchClass::polar; // its row 3 is the apex
    const auto net = [&](uint32_t i, uint32_t j) { return c(polar ? std::min(4 * j + i, 12u) : 4 * j + i); };
    const uint32_t quadSide = polar && side == 2 ? 3 : side;
    UvCurve curve;
    std::array<glm::vec2, 4> a;
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t borderI[4] = {k, 3, 3 - k, 0}, borderJ[4] = {0, k, 3, 3 - k};
        const uint32_t insideI[4] = {k, 2, 3 - k, 1}, insideJ[4] = {1, k, 2, 3 - k};
        curve.along[k] = net(borderI[quadSide], borderJ[quadSide]);
        a[k] = net(insideI[quadSide], insideJ[quadSide]) - curve.along[k];
    }
    if (polar && side == 1) { // without the factor that is the distance to the apex
        a = {a[0], a[0] * (1.0f / 3.0f) + a[1], a[1] + a[2], 3.0f * a[2]};
    } else if (polar && side == 2) {
        a = {3.0f * a[1], a[1] + a[2], a[3] * (1.0f / 3.0f) + a[2], a[3]};
    }
    std::copy(a.begin(), a.end(), curve.across.begin());
    std::array<glm::vec2, 4> h{};
    for (uint32_t k = 0; k < 16 && patchClass == PatchClass::perturbed; ++k) {
        if (const uint32_t place = SUPPLE_PREP_FACE_EDGE(k); place / 4 == side) {
            h[place % 4] = c(16 + k);
        }
    }
    curve.along[4] = h[0];
    curve.along[5] = h[1];
    curve.across[4] = h[2] - h[0];
    curve.across[5] = h[3] - h[1];
    return curve;
}

} // namespace

uint32_t uvElement(const Tables& tables, uint32_t patch, uint32_t set) {
    const PatchRange& range = tables.rangeOf(patch);
    const uint32_t each = uvElements(tables, range.patchClass);
    return range.smoothUvs + each * (tables.uvSets * (patch - range.firstPatch) + set);
}

void writeUvCurves(const Tables& tables, uint32_t patch, uint32_t side, TableWriter& writer) {
    const PatchClass patchClass = tables.rangeOf(patch).patchClass;
    for (uint32_t set = 0; set < tables.uvSets; ++set) {
        const uint32_t element = uvElement(tables, patch, set);
        const auto c = [&](uint32_t k) {
            const uint32_t* words = &tables.words[size_t{4} * element + size_t{2} * k];
            return glm::vec2(std::bit_cast<float>(words[0]), std::bit_cast<float>(words[1]));
        };
        const UvCurve curve = rowOf(patchClass).hasSectors() ? sectorUvCurve(c, cornerCount(domainOf(patchClass)), side)
                                                             : bicubicUvCurve(c, patchClass, side);
        for (const std::array<glm::vec2, 6>* half : {&curve.along, &curve.across}) {
            for (const glm::vec2& p : *half) {
                writer.putFloats({p.x, p.y});
            }
        }
    }
}

} // namespace supple::surface
