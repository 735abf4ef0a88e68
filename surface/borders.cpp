#include "surface/borders.h"

namespace supple::surface {

uint32_t recordElements(const Tables& tables, PatchClass patchClass) {
    switch (patchClass) {
    case PatchClass::regular:
    case PatchClass::polar:
        return tables.cornerNormals ? 5 : 4;
    case PatchClass::perturbed:
        return tables.cornerNormals ? 9 : 8;
    default:
        return cornerCount(domainOf(patchClass));
    }
}

std::vector<BorderCurve> borderCurves(const uint32_t* record, PatchClass patchClass) {
    if (patchClass <= PatchClass::polar) {
        const auto g = [&](uint32_t i, uint32_t j) { return record[4 * j + i]; };
        return {{g(0, 0), g(1, 0), g(2, 0), g(3, 0)},
                {g(3, 0), g(3, 1), g(3, 2), g(3, 3)},
                {g(3, 3), g(2, 3), g(1, 3), g(0, 3)},
                {g(0, 3), g(0, 2), g(0, 1), g(0, 0)}};
    }
    std::vector<BorderCurve> curves;
    const uint32_t sides = cornerCount(domainOf(patchClass));
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t* corner = record + size_t{4} * i;
        const uint32_t* next = record + size_t{4} * ((i + 1) % sides);
        curves.push_back({corner[0], corner[1], corner[2], next[0]});
    }
    return curves;
}

} // namespace supple::surface
