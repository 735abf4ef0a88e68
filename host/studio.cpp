#include "host/studio.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::host {

namespace {

constexpr float kGoldenAngle = 2.39996323f;
/// Directions are blurred into cones of equal areas that just overlap.
constexpr float kConeOverlap = 1.2f;

const glm::vec3 kKeyColor = glm::vec3(1.0f, 0.89f, 0.76f) * 1.0f;
const glm::vec3 kRimColor = glm::vec3(0.70f, 0.85f, 1.0f) * 1.5f;
const glm::vec3 kSkyZenith(0.44f, 0.50f, 0.60f);
const glm::vec3 kSkyHorizon(0.38f, 0.37f, 0.36f);

/// A surface that faces the key is shown about in its base color.
constexpr float kBaseExposure = 0.84f;
/// Luminance of the albedo that is shown as it is.
constexpr float kMiddleAlbedo = 0.28f;

/// The rig's directions that one pass takes: every `passes`-th of a fixed even distribution.
struct Sampling {
    uint32_t pass;
    uint32_t passes;

    [[nodiscard]] float index(uint32_t i) const { return static_cast<float>(i * passes + pass); }
    [[nodiscard]] float fraction(uint32_t i, uint32_t count) const {
        return (index(i) + 0.5f) / static_cast<float>(count * passes);
    }
};

struct Sphere {
    glm::vec3 center;
    float radius;
};

glm::vec3 direction(float azimuth, float elevation) {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

/// World to the shadow map of a light far away: a parallel projection that just holds the sphere.
glm::mat4 shadowMatrix(glm::vec3 towardsLight, const Sphere& sphere) {
    const float radius = sphere.radius;
    const glm::vec3 up = std::abs(towardsLight.y) > 0.95f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::mat4 view = glm::lookAtRH(sphere.center + towardsLight * radius * 2.0f, sphere.center, up);
    return glm::orthoRH_ZO(-radius, radius, -radius, radius, radius * 0.9f, radius * (0.9f + kShadowDepth)) * view;
}

shared::Light makeLight(glm::vec3 towards, float cone, glm::vec3 color, uint32_t part, const Sphere& sphere) {
    return {glm::vec4(towards, cone), glm::vec4(color, static_cast<float>(part)), shadowMatrix(towards, sphere)};
}

/// `count` directions spread evenly over a disc of `spread` radians about the middle direction.
void addSoftLight(std::vector<shared::Light>& lights, uint32_t count, const Sampling& sampling, glm::vec3 middle,
                  float spread, glm::vec3 color, uint32_t part, const Sphere& sphere) {
    const glm::vec3 side = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), middle));
    const glm::vec3 above = glm::cross(middle, side);
    const float cone = kConeOverlap * spread / std::sqrt(static_cast<float>(count * sampling.passes));
    for (uint32_t i = 0; i < count; ++i) {
        const float reach = spread * std::sqrt(sampling.fraction(i, count));
        const float angle = kGoldenAngle * sampling.index(i);
        const glm::vec3 offset = side * (reach * std::cos(angle)) + above * (reach * std::sin(angle));
        lights.push_back(
            makeLight(glm::normalize(middle + offset), cone, color / static_cast<float>(count), part, sphere));
    }
}

} // namespace

StudioMiddle studioMiddle(float yaw) {
    return {direction(yaw - 0.75f, 0.72f), kKeyColor, direction(yaw + 2.55f, 0.50f), kRimColor};
}

std::vector<shared::Light> studioLights(const StudioQuality& quality, uint32_t pass, float yaw, glm::vec3 center,
                                        float radius) {
    const StudioMiddle middle = studioMiddle(yaw);
    const Sampling sampling{pass, std::max(quality.passes, 1u)};
    const Sphere sphere{center, radius};
    std::vector<shared::Light> lights;
    lights.reserve(quality.lightCount());
    addSoftLight(lights, quality.key, sampling, middle.keyDirection, 0.2f, middle.keyColor, shared::kLightKey, sphere);
    addSoftLight(lights, quality.rim, sampling, middle.rimDirection, 0.16f, middle.rimColor, shared::kLightRim, sphere);
    // Equal areas of the upper half sphere; a surface that faces straight up gathers the sky's color once.
    const float scale = 2.0f / static_cast<float>(std::max(quality.sky, 1u));
    // A few directions keep to the top: low ones would each throw a long shadow of its own.
    const float reach = quality.sky * sampling.passes >= 8 ? 0.96f : 0.55f;
    const float cone = kConeOverlap * std::sqrt(2.0f * reach / static_cast<float>(quality.sky * sampling.passes));
    for (uint32_t i = 0; i < quality.sky; ++i) {
        const float height = 1.0f - sampling.fraction(i, quality.sky) * reach;
        const glm::vec3 towards = direction(yaw + kGoldenAngle * sampling.index(i), std::asin(height));
        const glm::vec3 color = glm::mix(kSkyHorizon, kSkyZenith, height) * scale;
        lights.push_back(makeLight(towards, cone, color, shared::kLightSky, sphere));
    }
    return lights;
}

glm::vec3 studioOpenSky() {
    // Twice the mean of color times height over the half sphere: all heights are equally likely.
    return (kSkyHorizon + 2.0f * kSkyZenith) / 3.0f;
}

glm::vec2 studioJitter(const StudioQuality& quality, uint32_t pass) {
    if (quality.passes <= 1)
        return glm::vec2(0.0f);
    // The plane's most even sequence (Roberts, 2018), centered on the pixel. Multisampling covers what lies between.
    const auto n = static_cast<float>(pass + 1);
    const glm::vec2 at = glm::fract(glm::vec2(0.75487767f, 0.56984029f) * n + 0.5f) - 0.5f;
    return quality.multisample ? at * 0.5f : at;
}

float studioExposure(float averageAlbedo) {
    return kBaseExposure * std::clamp(std::pow(kMiddleAlbedo / std::max(averageAlbedo, 1e-3f), 0.3f), 0.88f, 1.5f);
}

} // namespace supple::host
