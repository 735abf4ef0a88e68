// Wren's pictures.
#pragma once

#include "cage/character.h"

#include <vector>

namespace supple::creature::wren {

// In the order of the images.
enum class Picture : uint32_t {
    Face,
    Eye,
    Weave,
    WeaveNormal,
    Band,
    BandNormal,
    Grain,
    GrainNormal,
    Strap,
    StrapNormal,
    Strands,
    StrandsNormal,
    Worn,
    WornNormal,
    FaceRoughness,
    SkinNormal,
    IrisNormal,
    CorneaNormal
};
std::vector<cage::Image> pictures();

} // namespace supple::creature::wren
