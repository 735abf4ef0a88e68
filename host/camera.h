// Where the viewer stands, and how to stand so that a figure fills the picture.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <span>

namespace supple::host {

struct Bounds {
    glm::vec3 min{std::numeric_limits<float>::max()};
    glm::vec3 max{std::numeric_limits<float>::lowest()};

    void add(glm::vec3 point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    [[nodiscard]] bool empty() const { return min.x > max.x; }
    [[nodiscard]] glm::vec3 center() const { return empty() ? glm::vec3(0.0f) : (min + max) * 0.5f; }
    /// The radius of the sphere round the box, which may be of any size; never 0.
    [[nodiscard]] float radius() const {
        const auto half = static_cast<float>(glm::length(glm::dvec3(max - min)) * 0.5);
        return empty() ? 1.0f : half > 0.0f ? half : 1e-6f;
    }
};
[[nodiscard]] Bounds boundsOf(std::span<const glm::vec3> points);

/// Looks at `target` from `distance`. Yaw 0 stands in front (at +Z), positive yaw goes round towards +X, positive pitch
/// looks down, positive roll turns the camera counter-clockwise, and so the picture clockwise. Radians.
struct Camera {
    glm::vec3 target{0.0f};
    float yaw = 0.0f;
    float pitch = 0.0f;
    float roll = 0.0f;
    float distance = 1.0f;
    float fieldOfView = 0.47f; ///< vertical

    bool operator==(const Camera&) const = default;

    [[nodiscard]] glm::vec3 eye() const;
    [[nodiscard]] glm::mat4 view() const;
    /// The direction, of any length, from the eye through a place of the picture: 0, 0 is its upper left corner, 1, 1
    /// its lower right one.
    [[nodiscard]] glm::vec3 directionThrough(const glm::vec2& place, float aspect) const;
    /// Right-handed, depth 0..1, y up (draw with a flipped viewport). Near and far enclose a sphere round the target.
    [[nodiscard]] glm::mat4 projection(float aspect, float sceneRadius) const;
};

/// The camera at `eye` that looks at `target`, with `up` towards the upper edge of the picture. `eye` is not `target`.
[[nodiscard]] Camera lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up);

/// The camera of this direction from which the points just fit into the picture, with `margin` (a fraction of its size)
/// left free on every side.
[[nodiscard]] Camera frameCamera(std::span<const glm::vec3> points, float yaw, float pitch, float aspect, float margin);

} // namespace supple::host
