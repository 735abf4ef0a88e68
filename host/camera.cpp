#include "host/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::host {

namespace {

/// Columns: right, up, towards the viewer.
glm::mat3 axes(float yaw, float pitch, float roll = 0.0f) {
    const glm::vec3 back(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
    const glm::vec3 level(std::cos(yaw), 0.0f, -std::sin(yaw));
    if (roll == 0.0f)
        return {level, glm::cross(back, level), back};
    const glm::vec3 right = std::cos(roll) * level + std::sin(roll) * glm::cross(back, level);
    return {right, glm::cross(back, right), back};
}

} // namespace

Bounds boundsOf(std::span<const glm::vec3> points) {
    Bounds bounds;
    for (const glm::vec3& point : points)
        bounds.add(point);
    return bounds;
}

glm::vec3 Camera::eye() const {
    return target + axes(yaw, pitch)[2] * distance;
}

glm::mat4 Camera::view() const {
    const glm::mat3 world = axes(yaw, pitch, roll);
    return glm::translate(glm::mat4(glm::transpose(world)), -eye());
}

glm::vec3 Camera::directionThrough(const glm::vec2& place, float aspect) const {
    const float half = std::tan(0.5f * fieldOfView);
    const glm::vec3 ahead(half * aspect * (2.0f * place.x - 1.0f), half * (1.0f - 2.0f * place.y), -1.0f);
    return glm::transpose(glm::mat3(view())) * ahead;
}

glm::mat4 Camera::projection(float aspect, float sceneRadius) const {
    const float nearest = std::max(distance - sceneRadius * 2.0f, std::max(distance, sceneRadius) * 0.005f);
    const float farthest = distance + sceneRadius * 14.0f;
    return glm::perspectiveRH_ZO(fieldOfView, aspect, nearest, farthest);
}

Camera lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up) {
    const glm::vec3 back = glm::normalize(eye - target);
    Camera camera;
    camera.target = target;
    camera.distance = glm::distance(eye, target);
    camera.pitch = std::asin(std::clamp(back.y, -1.0f, 1.0f));
    // Straight from above or below no direction is level; any yaw will do, and roll makes up for it.
    camera.yaw = back.x == 0.0f && back.z == 0.0f ? 0.0f : std::atan2(back.x, back.z);
    const glm::mat3 level = axes(camera.yaw, camera.pitch);
    const glm::vec3 right = glm::cross(up, back);
    camera.roll = std::atan2(glm::dot(right, level[1]), glm::dot(right, level[0]));
    return camera;
}

Camera frameCamera(std::span<const glm::vec3> points, float yaw, float pitch, float aspect, float margin) {
    Camera camera;
    camera.yaw = yaw;
    camera.pitch = pitch;
    if (points.empty())
        return camera;

    // In the camera's axes an eye at (x0, y0, d) sees p when |p.x - x0| <= tx (d - p.z), and so in y: four half spaces,
    // each as far out as its farthest point. Opposite pairs meet where the eye can stand; the farther of the two is d.
    const glm::mat3 toCamera = glm::transpose(axes(yaw, pitch));
    const float ty = std::tan(camera.fieldOfView * 0.5f) * (1.0f - 2.0f * margin);
    const float tx = ty * aspect;
    float left = std::numeric_limits<float>::lowest();
    float right = left;
    float low = left;
    float high = left;
    float nearest = left;
    float farthest = std::numeric_limits<float>::max();
    for (const glm::vec3& point : points) {
        const glm::vec3 p = toCamera * point;
        left = std::max(left, tx * p.z - p.x);
        right = std::max(right, tx * p.z + p.x);
        low = std::max(low, ty * p.z - p.y);
        high = std::max(high, ty * p.z + p.y);
        nearest = std::max(nearest, p.z);
        farthest = std::min(farthest, p.z);
    }
    const float size = boundsOf(points).radius();
    const float stand = std::max({(left + right) / (2.0f * tx), (low + high) / (2.0f * ty), nearest + size * 0.05f});
    const float middle = (nearest + farthest) * 0.5f;
    camera.target = axes(yaw, pitch) * glm::vec3((right - left) * 0.5f, (high - low) * 0.5f, middle);
    camera.distance = stand - middle;
    return camera;
}

} // namespace supple::host
