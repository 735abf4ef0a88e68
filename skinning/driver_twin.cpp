#include "skinning/driver_twin.h"

#include "shaders/pose/affine.h"
#include "shaders/shared/pose.h"

namespace supple::twin {

using namespace shared;

namespace {

/// What GLSL has from drivers.comp.
struct DriverCode {
    const uint32_t* words = nullptr;
    std::span<const glm::vec4> rotations;

    [[nodiscard]] uvec4 table(uint i) const {
        const uint32_t* const w = words + 4 * size_t{i};
        return {w[0], w[1], w[2], w[3]};
    }
    [[nodiscard]] vec4 tableFloats(uint i) const {
        const uvec4 w = table(i);
        return {uintBitsToFloat(w.x), uintBitsToFloat(w.y), uintBitsToFloat(w.z), uintBitsToFloat(w.w)};
    }
    [[nodiscard]] vec4 nodeRotation(uint /*place*/, uint number) const { return rotations[number]; }
#include "shaders/pose/drivers.h"
};

} // namespace
} // namespace supple::twin

namespace supple::skinning {

void addDriven(std::span<const uint32_t> words, uint32_t drivers, std::span<const glm::vec4> rotations,
               std::span<glm::vec4> weights) {
    twin::DriverCode code{words.data(), rotations};
    const uint32_t quads = code.table(drivers).x;
    for (uint32_t i = 0; i < quads; ++i) {
        const glm::uvec4 quad = code.table(drivers + 1 + i);
        weights[quad.x] = weights[quad.x] + code.drivenWeights(quad);
    }
}

} // namespace supple::skinning
