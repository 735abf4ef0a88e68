// What makes a character soft, as lines and dots over its picture: springs, colliders, painted weights.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "host/figure.h"
#include "host/picture.h"
#include "tools/supple/render_options.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::tools {

/// In the world. A dot ends where it begins.
struct Stroke {
    glm::vec3 from{0.0f}, to{0.0f};
    std::array<uint8_t, 3> color{};
};

/// What of a character tells what is soft of it. Kept by hosts, whose figures know it no more.
struct SoftFacts {
    cage::Skeleton skeleton;
    cage::Skin skin;
    cage::SpringBones springBones;
    std::vector<cage::PaintedWeight> jiggles, cloths; ///< per cage vertex, or none

    SoftFacts() = default;
    explicit SoftFacts(const cage::Character& character);
    /// Whether anything of the character moves by itself.
    [[nodiscard]] bool any() const { return !springBones.springs.empty() || !jiggles.empty() || !cloths.empty(); }
};

/// As the group was evaluated last, with what swings. Waits for the device and reads it.
[[nodiscard]] Result<std::vector<Stroke>> softStrokes(const SoftFacts& facts, const host::FigureGroup& group,
                                                      const SoftShown& shown);

/// Where a stroke lies in a picture, in fractions of it from its upper left.
struct PlacedStroke {
    glm::vec2 from{0.0f}, to{0.0f};
    std::array<uint8_t, 3> color{};

    [[nodiscard]] bool isDot() const { return from == to; }
};
/// Those before the eye and not far aside. `view`: from the world to clip space.
[[nodiscard]] std::vector<PlacedStroke> placeStrokes(const std::vector<Stroke>& strokes, const glm::mat4& view);

/// What the colors of strokes stand for; for what is shown, and only of what there is.
struct SoftKey {
    std::array<uint8_t, 3> color{};
    std::string text;
};
[[nodiscard]] std::vector<SoftKey> softKeys(const SoftFacts& facts, const SoftShown& shown);

/// Into a picture, with the keys in its upper left corner. `view`: from the world to clip space.
void drawStrokes(host::Picture& picture, const std::vector<Stroke>& strokes, const std::vector<SoftKey>& keys,
                 const glm::mat4& view);

} // namespace supple::tools
