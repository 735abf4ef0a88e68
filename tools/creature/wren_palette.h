// What Wren is made of: a material and a colour for each part.
#pragma once

#include "modeller.h"

#include "cage/character.h"

namespace supple::creature::wren {

struct Swatch {
    uint32_t material = 0;
    Vec3 colour{1}; // linear; multiplies the material's
    double density = 1; // of its textures: repeats a metre
};

Swatch swatch(Part part);
std::vector<cage::Material> materials();
std::vector<cage::Image> images();

} // namespace supple::creature::wren
