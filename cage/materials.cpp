#include "cage/materials.h"

#include <cmath>

namespace supple::cage {

namespace {

MapFrame frameOfTexture(const Texture& map) {
    // The second row of KHR_texture_transform's matrix, and the sign of its determinant.
    const glm::vec2 row(-std::sin(map.rotation) * map.scale.x, std::cos(map.rotation) * map.scale.y);
    const float length = std::hypot(row.x, row.y), area = map.scale.x * map.scale.y;
    return {map.uvSet, length > 0.0f ? row / length : glm::vec2(0.0f), area > 0.0f ? 1.0f : area < 0.0f ? -1.0f : 0.0f};
}

} // namespace

std::vector<MapFrame> mapFramesOf(const Character& character) {
    const MapFrame kAsItIs, kNone{0, glm::vec2(0.0f), 0.0f};
    const std::vector<glm::vec2>* sets[2] = {&character.cage.cornerUvs, &character.cage.cornerUvs1};
    std::vector<MapFrame> frames;
    for (const Material& material : character.materials) {
        const Texture& map = material.normalTexture;
        const bool known = map.exists() && !sets[std::min(map.uvSet, 1u)]->empty();
        frames.push_back(!map.exists() ? kAsItIs : known ? frameOfTexture(map) : kNone);
    }
    if (std::count(frames.begin(), frames.end(), kAsItIs) == static_cast<ptrdiff_t>(frames.size())) {
        frames.clear();
    }
    return frames;
}

std::vector<glm::vec2> mapUvs(const Cage& cage, std::span<const MapFrame> frames) {
    if (frames.empty() || cage.faceMaterials.empty()) {
        return cage.cornerUvs;
    }
    const bool any = !cage.cornerUvs.empty() || !cage.cornerUvs1.empty();
    std::vector<glm::vec2> uvs(any ? cage.cornerCount() : 0, glm::vec2(0.0f));
    for (uint32_t face = 0; face < cage.faceCount() && any; ++face) {
        const MapFrame frame = mapFrameOf(frames, cage.faceMaterials[face]);
        const std::vector<glm::vec2>& set = frame.uvSet == 1 ? cage.cornerUvs1 : cage.cornerUvs;
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1] && !set.empty(); ++corner) {
            uvs[corner] = frame.turn(set[corner]);
        }
    }
    return uvs;
}

} // namespace supple::cage
