// Who is on the market place: where everybody stands or walks, in which clip, and in which colors.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace market {

/// The files of samples/assets that figures are made from.
enum class Kind : uint8_t { wren, pip, pipQuads };
inline constexpr size_t kKinds = 3;

/// What materials are tinted by: the place of a tint in Figure::tints.
enum class Tint : uint8_t { cloth, hair, leather, skin, none };
inline constexpr size_t kTints = 4;

struct Figure {
    Kind kind = Kind::wren;
    const char* clip = "idle";
    float phase = 0.0f; ///< where in the clip it begins, 0..1
    float speed = 1.0f; ///< of the clip
    float size = 1.0f;
    glm::vec2 place{0.0f}; ///< x and z; of those that walk: the middle of their circle
    float heading = 0.0f;  ///< radians from +Z towards +X; of those that walk: where on the circle they begin
    float radius = 0.0f;   ///< of the circle; 0: stands
    float turn = 1.0f;     ///< 1: counter-clockwise as seen from above
    float stride = 0.0f;   ///< units a second that the clip's ground passes under the feet, at size 1
    bool armed = false;    ///< with sword and gear
    bool scarf = true;
    /// Each turns a color round the grey axis by x (radians), multiplies its distance from grey by y and all of it by
    /// z.
    std::array<glm::vec4, kTints> tints{};
};

inline constexpr uint32_t kMostFigures = 60;

/// The first `count` of them. They are in an order in which the place fills up evenly.
[[nodiscard]] std::vector<Figure> makeCast(uint32_t count);

/// Where it is at a time, in seconds.
[[nodiscard]] glm::mat4 transformOf(const Figure& figure, double time);

} // namespace market
