// Where the show is seen from, and where the sun stands.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace engine {

struct Camera {
    glm::vec3 eye{};
    glm::mat4 viewProjection{1.0f};
};

/// Swings slowly about the stage.
inline Camera cameraAt(double time, float aspect) {
    const auto t = static_cast<float>(time);
    const float around = 0.35f * std::sin(0.25f * t);
    const glm::vec3 target{0.0f, 0.72f, 0.0f};
    Camera camera;
    camera.eye = target + 6.4f * glm::vec3(std::sin(around), 0.22f + 0.03f * std::sin(0.17f * t), std::cos(around));
    glm::mat4 projection = glm::perspectiveRH_ZO(glm::radians(30.0f), aspect, 0.5f, 60.0f);
    projection[1][1] = -projection[1][1]; // Vulkan's y points down
    camera.viewProjection = projection * glm::lookAt(camera.eye, target, glm::vec3(0.0f, 1.0f, 0.0f));
    return camera;
}

struct Sun {
    glm::vec3 direction{};
    glm::mat4 viewProjection{1.0f};
    float width = 0.0f; ///< of the map, in the world
    float depth = 0.0f;
};

inline Sun sunOverStage() {
    constexpr float kHalf = 3.0f;
    constexpr float kDepth = 14.0f;
    Sun sun{.direction = glm::normalize(glm::vec3(0.55f, 0.95f, 0.62f)), .width = 2.0f * kHalf, .depth = kDepth};
    const glm::vec3 middle{0.0f, 0.5f, 0.0f};
    sun.viewProjection = glm::orthoRH_ZO(-kHalf, kHalf, -kHalf, kHalf, 0.0f, kDepth) *
                         glm::lookAt(middle + sun.direction * (0.5f * kDepth), middle, glm::vec3(0.0f, 1.0f, 0.0f));
    return sun;
}

} // namespace engine
