#include "surface/grid.h"

#include <cstddef>

namespace supple::surface {

std::vector<uint16_t> quadGridIndices(uint32_t rate) {
    std::vector<uint16_t> indices;
    indices.reserve(6 * std::size_t{rate} * rate);
    const uint32_t side = rate + 1;
    for (uint32_t j = 0; j < rate; ++j) {
        for (uint32_t i = 0; i < rate; ++i) {
            const auto a = static_cast<uint16_t>(j * side + i);
            const auto b = static_cast<uint16_t>(a + 1);
            const auto c = static_cast<uint16_t>(a + side + 1);
            const auto d = static_cast<uint16_t>(a + side);
            indices.insert(indices.end(), {a, b, c, a, c, d});
        }
    }
    return indices;
}

std::vector<float> parameterPairs() {
    std::vector<float> pairs;
    for (uint32_t rate = 1; rate <= kMaxRate; ++rate) {
        for (uint32_t k = 0; k <= rate; ++k) {
            pairs.push_back(static_cast<float>(k) / static_cast<float>(rate));
            pairs.push_back(static_cast<float>(rate - k) / static_cast<float>(rate));
        }
    }
    return pairs;
}

} // namespace supple::surface
