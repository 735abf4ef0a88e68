// What stands on the market place: houses, stalls, a fountain, goods. Boxes, cylinders, balls and gables.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace market {

/// A shape reaches from -1/2 to 1/2; shaders/prop.vert makes it.
enum class Shape : uint32_t { box, cylinder, ball, gable };
inline constexpr size_t kShapes = 4;

/// What is painted on it: shaders/prop.frag.
enum class Surface : uint32_t { plain, stripes, wood, timbered, tiles, water, stone, cloth };

/// shaders/prop.vert
struct Prop {
    glm::mat4 transform{1.0f};
    glm::vec4 color{1.0f}; ///< linear; w: Surface
    glm::vec4 size{1.0f};  ///< of the shape in the world; w: a number that differs from prop to prop, 0..1
};

struct Props {
    std::vector<Prop> all; ///< shape after shape
    struct Run {
        uint32_t first = 0, count = 0;
    };
    std::array<Run, kShapes> runs{};
};

[[nodiscard]] Props makeProps();

} // namespace market
