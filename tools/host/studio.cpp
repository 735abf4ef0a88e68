#include "tools/host/studio.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::host {

namespace {

constexpr float kGoldenAngle = 2.39996323f;

const glm::vec3 kKeyColor = glm::vec3(1.0f, 0.90f, 0.78f) * 0.95f;
const glm::vec3 kRimColor = glm::vec3(0.70f, 0.85f, 1.0f) * 1.5f;
const glm::vec3 kSkyZenith(0.50f, 0.56f, 0.66f);
const glm::vec3 kSkyHorizon(0.44f, 0.43f, 0.42f);

glm::vec3 direction(float azimuth, float elevation) {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

/// World to the shadow map of a light far away: a parallel projection that just holds the sphere.
glm::mat4 shadowMatrix(glm::vec3 towardsLight, glm::vec3 center, float radius) {
    const glm::vec3 up = std::abs(towardsLight.y) > 0.95f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::mat4 view = glm::lookAtRH(center + towardsLight * radius * 2.0f, center, up);
    return glm::orthoRH_ZO(-radius, radius, -radius, radius, radius * 0.9f, radius * 3.1f) * view;
}

shared::Light makeLight(glm::vec3 towards, glm::vec3 color, uint32_t part, glm::vec3 center, float radius) {
    return {glm::vec4(towards, 0.0f), glm::vec4(color, static_cast<float>(part)),
            shadowMatrix(towards, center, radius)};
}

/// `count` directions spread evenly over a disc of `spread` radians about the middle direction.
void addSoftLight(std::vector<shared::Light>& lights, uint32_t count, glm::vec3 middle, float spread, glm::vec3 color,
                  uint32_t part, glm::vec3 center, float radius) {
    const glm::vec3 side = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), middle));
    const glm::vec3 above = glm::cross(middle, side);
    for (uint32_t i = 0; i < count; ++i) {
        const float r = spread * std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
        const float angle = kGoldenAngle * static_cast<float>(i);
        const float reach = count > 1 ? r : 0.0f;
        const glm::vec3 towards =
            glm::normalize(middle + side * reach * std::cos(angle) + above * reach * std::sin(angle));
        lights.push_back(makeLight(towards, color / static_cast<float>(count), part, center, radius));
    }
}

} // namespace

std::vector<shared::Light> studioLights(const StudioQuality& quality, float yaw, glm::vec3 center, float radius) {
    std::vector<shared::Light> lights;
    lights.reserve(quality.lightCount());
    addSoftLight(lights, quality.key, direction(yaw - 0.75f, 0.72f), 0.16f, kKeyColor, shared::kLightKey, center,
                 radius);
    addSoftLight(lights, quality.rim, direction(yaw + 2.55f, 0.50f), 0.12f, kRimColor, shared::kLightRim, center,
                 radius);
    // Equal areas of the upper half sphere; a surface that faces straight up gathers the sky's color once.
    const float scale = 2.0f / static_cast<float>(std::max(quality.sky, 1u));
    for (uint32_t i = 0; i < quality.sky; ++i) {
        const float height = 1.0f - (static_cast<float>(i) + 0.5f) / static_cast<float>(quality.sky) * 0.96f;
        const glm::vec3 towards = direction(yaw + kGoldenAngle * static_cast<float>(i), std::asin(height));
        lights.push_back(
            makeLight(towards, glm::mix(kSkyHorizon, kSkyZenith, height) * scale, shared::kLightSky, center, radius));
    }
    return lights;
}

} // namespace supple::host
