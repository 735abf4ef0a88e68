// The ground of the room: a height for every place. A game would ask its physics.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace play {

/// Places are x and z of the world; +Y is up.
[[nodiscard]] float heightAt(glm::vec2 place);
[[nodiscard]] glm::vec3 normalAt(glm::vec2 place);
[[nodiscard]] inline glm::vec2 placeOf(glm::vec3 point) {
    return {point.x, point.z};
}
[[nodiscard]] inline glm::vec3 onGround(glm::vec2 place) {
    return {place.x, heightAt(place), place.y};
}

/// The nearest place that is in the room.
[[nodiscard]] glm::vec2 withinRoom(glm::vec2 place);

/// Where a ray comes to the ground, within 30 units.
[[nodiscard]] std::optional<glm::vec3> meetGround(glm::vec3 from, glm::vec3 direction);

/// What a foot stands on: a plane.
struct Footing {
    glm::vec3 point{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};
};
/// Under a sole from heel to toes. Over the edge of a step it is the level of the higher side, so that no foot hangs in
/// the edge.
[[nodiscard]] Footing footingUnder(glm::vec3 ankle, glm::vec3 toes);

/// The ground as triangles.
struct GroundMesh {
    struct Vertex {
        glm::vec4 position; ///< w is not used
        glm::vec4 normal;   ///< w: the part of the sky that is seen from there
    };
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
};
[[nodiscard]] GroundMesh makeGroundMesh();

} // namespace play
