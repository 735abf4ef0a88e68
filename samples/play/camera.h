// Where the room is seen from.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace play {

struct Camera {
    glm::vec3 eye{0.0f}, target{0.0f};
    float fieldOfView = 0.6f; ///< vertical, in radians

    [[nodiscard]] glm::mat4 viewProjection(float aspect) const {
        glm::mat4 projection = glm::perspectiveRH_ZO(fieldOfView, aspect, 0.1f, 60.0f);
        projection[1][1] = -projection[1][1]; // Vulkan's y points down
        return projection * glm::lookAt(eye, target, glm::vec3(0.0f, 1.0f, 0.0f));
    }
    /// Through a place of the picture: x and y from -1 to 1, y down.
    [[nodiscard]] glm::vec3 ray(glm::vec2 at, float aspect) const {
        const glm::vec4 far = glm::inverse(viewProjection(aspect)) * glm::vec4(at, 1.0f, 1.0f);
        return glm::normalize(glm::vec3(far) / far.w - eye);
    }
};

/// Beside the character, and a little above it.
[[nodiscard]] inline Camera cameraBeside(glm::vec3 middle, float distance) {
    constexpr glm::vec3 kFrom{0.40f, 0.27f, 0.88f};
    return {.eye = middle + distance * kFrom, .target = middle};
}

} // namespace play
