#include "surface/ring_writer.h"

#include <algorithm>

namespace supple::surface {

void RingWriter::add(const std::array<uint32_t, 4>& vertices, uint32_t facet, std::span<const uint32_t> points) {
    const auto inElement = points.first(std::min<size_t>(points.size(), 4));
    uint32_t element = elements_[facet];
    std::array<uint32_t, 4> places{0, 1, 2, 3};
    for (size_t i = 0; i < 4; ++i) {
        const auto found = std::find(inElement.begin(), inElement.end(), vertices[i]);
        if (found == inElement.end()) {
            element = cage::kNone;
        } else {
            places[i] = static_cast<uint32_t>(found - inElement.begin());
        }
    }
    if (element == cage::kNone) {
        places = {0, 1, 2, 3};
        element = writer_.element();
        writer_.put({vertices[0], vertices[1], vertices[2], vertices[3]});
    }
    words_.push_back(element << shared::kRingPlaceBits | places[0] | places[1] << 2 | places[2] << 4 | places[3] << 6);
}

uint32_t RingWriter::write() {
    const uint32_t first = 4 * writer_.element();
    for (const uint32_t word : words_) {
        writer_.put({word});
    }
    return first;
}

} // namespace supple::surface
