// What Wren is made of: a material and a color for each part.
#pragma once

#include "modeller.h"

#include "cage/character.h"

namespace supple::creature::wren {

struct Swatch {
    uint32_t material = 0;
    Vec3 color{1};      // linear; multiplies the material's
    double density = 1; // of its textures: repeats a metre
};

constexpr uint32_t kFaceMaterial = 0;
Swatch swatch(Part part);
// What multiplies that color at one corner of a face; `uv` in metres.
Vec3 tint(const Face& face, const Point& point, const Vec2& uv);
// Where the face's picture shows a point, and back: the picture is the head from the front.
Vec2 facePlace(const Vec3& point);
Vec3 facePoint(const Vec2& place);
std::vector<cage::Material> materials();

} // namespace supple::creature::wren
