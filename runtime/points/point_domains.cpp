#include "runtime/points/point_domains.h"

#include "runtime/cpu_group.h"

namespace supple::runtime {

std::vector<PointDomain> pointDomains(const CpuGroup& group) {
    std::vector<PointDomain> domains;
    const cage::Cage& cage = group.cage();
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t sides = cage.sides(face);
        if (group.find({face, 0, 0.25f, 0.25f}).place.fault != nullptr) {
            continue; // a hole
        }
        for (uint32_t side = 0; side < (sides > 4 ? sides : 1); ++side) {
            domains.push_back({face, side, sides == 4});
        }
    }
    return domains;
}

std::vector<Cell> cellsOf(bool isQuad, uint32_t along) {
    const double width = 1.0 / along;
    std::vector<Cell> cells;
    for (uint32_t j = 0; j < along; ++j) {
        for (uint32_t i = 0; i < (isQuad ? along : along - j); ++i) {
            const glm::dvec2 origin(i * width, j * width), x(width, 0.0), y(0.0, width);
            cells.push_back({origin, x, y});
            if (!isQuad && i + j + 1 < along) { // the one that is turned
                cells.push_back({origin + x + y, -x, -y});
            }
        }
    }
    return cells;
}

} // namespace supple::runtime
