// The numbers that SUPPLE_deformers has of what jiggles and what is cloth: for files, and for supple inspect.
#pragma once

#include "cage/character.h"

#include <nlohmann/json.hpp>

namespace supple::cage::gltf {

/// {frequency, damping, limit}: all but the weights.
[[nodiscard]] inline nlohmann::ordered_json softNumbers(const Jiggle& jiggle) {
    return {{"frequency", jiggle.frequency}, {"damping", jiggle.damping}, {"limit", jiggle.limit}};
}

/// {stretch, shear, bend, ..}: all but the weights and the colliders.
[[nodiscard]] inline nlohmann::ordered_json softNumbers(const Cloth& cloth) {
    return {{"stretch", cloth.stretch},  {"shear", cloth.shear},     {"bend", cloth.bend},
            {"volume", cloth.volume},    {"tether", cloth.tether},   {"drag", cloth.drag},
            {"air", cloth.air},          {"gravity", cloth.gravity}, {"hitRadius", cloth.hitRadius},
            {"substeps", cloth.substeps}};
}

} // namespace supple::cage::gltf
