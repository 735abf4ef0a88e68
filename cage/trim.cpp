#include "cage/trim.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace supple::cage {
namespace {

/// Corner `corner` of a face of `sides` in the unit square.
glm::vec2 placeInTile(uint32_t corner, uint32_t sides) {
    if (sides == 4) {
        return {corner == 1 || corner == 2 ? 1.0f : 0.0f, corner >= 2 ? 1.0f : 0.0f};
    }
    // The first side is level: its ends lie half a step to either side of straight down.
    const double step = glm::two_pi<double>() / sides;
    const double angle = -glm::half_pi<double>() + (corner - 0.5) * step;
    return {static_cast<float>(0.5 + 0.5 * std::cos(angle)), static_cast<float>(0.5 + 0.5 * std::sin(angle))};
}

} // namespace

std::optional<Trim> trimOf(const Material& material) {
    if (material.trim || material.alphaMode != AlphaMode::mask || !material.baseColorTexture.exists()) {
        return material.trim;
    }
    Trim trim;
    trim.texture = material.baseColorTexture;
    trim.channel = 3;
    trim.cutoff = material.alphaCutoff;
    return trim;
}

bool hasTrimTiles(const Cage& cage) {
    return std::any_of(cage.faceTrimTiles.begin(), cage.faceTrimTiles.end(),
                       [](uint32_t tile) { return tile != kNone; });
}

std::vector<glm::vec2> tileCoordinates(const Cage& cage) {
    std::vector<glm::vec2> coordinates;
    coordinates.reserve(cage.cornerCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t tile = cage.faceTrimTiles[face];
        const float first = tile == kNone ? -2.0f : 2.0f * static_cast<float>(tile);
        for (uint32_t corner = 0; corner < cage.sides(face); ++corner) {
            const glm::vec2 place = placeInTile(corner, cage.sides(face));
            coordinates.emplace_back(first + place.x, place.y);
        }
    }
    return coordinates;
}

} // namespace supple::cage
