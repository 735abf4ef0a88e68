#include "cpu/sectors.h"

#include "cpu/affine.h"

#include <array>

namespace supple::cpu {
namespace {

SectorPlace inSector(uint32_t sector, const Affine& second, const Affine& middle, const Place& place) {
    SectorPlace out{{0.0, second.at(place.x, place.y), middle.at(place.x, place.y)}, place};
    out.weights.x = (1.0 - out.weights.y) - out.weights.z;
    out.place.sector = sector;
    out.place.xSlope = second.slope.x * place.xSlope + second.slope.y * place.ySlope;
    out.place.ySlope = middle.slope.x * place.xSlope + middle.slope.y * place.ySlope;
    return out;
}

/// x and y: the weights of corners 1 and 2. The smallest weight is that of the corner opposite.
SectorPlace sectorOfTriangle(const Place& place) {
    const std::array<Affine, 3> weights{(kOne - kFirst) - kSecond, kFirst, kSecond};
    uint32_t least = 0;
    for (uint32_t r = 1; r < 3; ++r) {
        least = weights[r].at(place.x, place.y) < weights[least].at(place.x, place.y) ? r : least;
    }
    const Affine& low = weights[least];
    return inSector((least + 1) % 3, weights[(least + 2) % 3] - low, 3.0 * low, place);
}

/// The diagonals part the square.
SectorPlace sectorOfQuad(const Place& place) {
    const bool below = place.y <= place.x, left = place.x + place.y <= 1.0, right = place.x + place.y >= 1.0;
    if (below && left) {
        return inSector(0, kFirst - kSecond, 2.0 * kSecond, place);
    }
    if (below) {
        return inSector(1, kSecond - (kOne - kFirst), 2.0 * (kOne - kFirst), place);
    }
    if (right) {
        return inSector(2, kSecond - kFirst, 2.0 * (kOne - kSecond), place);
    }
    return inSector(3, (kOne - kFirst) - kSecond, 2.0 * kFirst, place);
}

} // namespace

SectorPlace sectorPlace(uint32_t sides, const Place& place) {
    return sides == 3   ? sectorOfTriangle(place)
           : sides == 4 ? sectorOfQuad(place)
                        : inSector(place.sector, kFirst, kSecond, place);
}

} // namespace supple::cpu
