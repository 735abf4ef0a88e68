// What the words of tangents say: suppleDecodeTangent of shaders/supple_surface.glsl in double.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace supple::test {

/// glTF's TANGENT.
inline glm::dvec4 decodeTangent(uint32_t word) {
    const double x = static_cast<int16_t>(word & 0xFFFFu) / 32767.0;
    const double y = (static_cast<int32_t>(word << 1) >> 17) / 16383.0;
    glm::dvec3 t(x, y, 1.0 - std::abs(x) - std::abs(y));
    if (t.z < 0.0) {
        const glm::dvec2 p(t);
        t.x = (1.0 - std::abs(p.y)) * (p.x >= 0.0 ? 1.0 : -1.0);
        t.y = (1.0 - std::abs(p.x)) * (p.y >= 0.0 ? 1.0 : -1.0);
    }
    return {glm::normalize(t), (word & 0x80000000u) != 0 ? -1.0 : 1.0};
}

} // namespace supple::test
