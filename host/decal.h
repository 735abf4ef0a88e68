// A picture on the surface of a character: a tattoo, a sticker, a wound. It is projected in the bind pose, once, onto
// the surface around a point. What comes out are points of the surface and patches between them, with texture
// coordinates of their own. A point set of these points has them where the character is posed, so the picture stays
// where it is, with all schemes, at every rate and level of detail.
#pragma once

#include "base/result.h"

#include <supple/supple.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::host {

/// Where a picture comes to lie. Lengths are those of the bind pose.
struct DecalDesc {
    SuppleSurfacePoint at{};        ///< the picture's middle
    glm::vec3 up{0.0f, 1.0f, 0.0f}; ///< where its top points, as far as the surface there lets it
    float rotation = 0.0f;          ///< radians, counter-clockwise as seen from outside
    glm::vec2 size{0.1f};           ///< its width and height
    /// The surface may lie as far above or below the tangent plane in the middle; 0: half of the picture's diagonal.
    float depth = 0.0f;
    /// Degrees between the surface and that plane: the picture fades out between them. At most 80.
    float fadeBegin = 50.0f, fadeEnd = 75.0f;
    uint32_t segments = 24; ///< along the longer side: 2 to 128
};

/// What a picture covers of a surface. It depends on the bind pose and the scheme alone.
struct Decal {
    /// Corners, as numbers of points: counter-clockwise from outside. A triangle has the third one twice.
    using Patch = std::array<uint32_t, 4>;
    /// What a point of the picture has: u and v, which begin at the upper left; how much of the picture is left, 0 to
    /// 1; and how far patches at the point may lie below the surface, as they are flat.
    struct Place {
        float u = 0.0f, v = 0.0f, opacity = 0.0f, sag = 0.0f;
    };

    std::vector<SuppleSurfacePoint> points; ///< SupplePointSetDesc::points
    std::vector<glm::vec3> tangents;        ///< SupplePointSetDesc::tangents: where u grows
    std::vector<Place> places;              ///< one per point
    std::vector<Patch> patches;
    /// How much the surface bends over a face, as second derivatives: drawn with n segments along the edges of faces,
    /// it lies about bend / (8 n^2) beside itself.
    float bend = 0.0f;

    /// How far the drawn surface may lie before its points, if it has so many segments along an edge of the cage: poses
    /// bend it more than the bind pose does. What is drawn is moved by this much, and by its sag, towards the eye.
    [[nodiscard]] float lift(uint32_t segments) const {
        return segments > 0 ? bend / (4.0f * static_cast<float>(segments * segments)) : 0.0f;
    }
    /// Two triangles a patch.
    [[nodiscard]] std::vector<uint32_t> indices() const;
};

/// Projects a picture along the normal in its middle. It covers what faces that way, step by step from the middle on,
/// so it does not come through to the other side, nor onto an arm before it. It casts
/// about two rays a patch, in a few dozen calls of suppleFindPoints.
///
/// Errors: a size, a depth or angles that are out of range; what suppleFindPoints refuses, such as a point that does
/// not exist; a middle without a tangent plane; a surface that is smaller than a patch.
[[nodiscard]] Result<Decal> projectDecal(SuppleContext context, SuppleGroup group, const DecalDesc& desc);

} // namespace supple::host
