#include "surface/fans.h"

#include <algorithm>
#include <array>

namespace supple::surface {

uint32_t writeFanWeights(const FanWeights& weights, uint32_t flags, TableWriter& writer) {
    const size_t facets = weights.limitFace.size();
    const uint32_t first = writer.element();
    writer.put({static_cast<uint32_t>(facets) | flags, 0u, 0u, 0u});
    for (size_t k = 0; k < weights.cosines.size(); ++k) {
        // The last spoke of an open fan has no facet behind it: its diagonal counts nothing.
        const auto face = [&](const std::vector<double>& values) { return k < facets ? values[k] : 0.0; };
        writer.putFloats({weights.limitEdge[k], face(weights.limitFace), weights.e1Edge[k], face(weights.e1Face),
                          weights.e2Edge[k], face(weights.e2Face), weights.cosines[k], weights.sines[k]});
    }
    return first;
}

void RingWriter::add(uint32_t vertex, std::span<const uint32_t> spokes, bool open) {
    for (size_t k = 0; k < spokes.size(); ++k) {
        // The far end of an open fan's last spoke is in the facet before it.
        const bool last = open && k + 1 == spokes.size();
        const uint32_t corner = topology_.sectorCorners[last ? spokes[k - 1] : spokes[k]];
        const uint32_t facet = topology_.cornerFaces[corner], first = cage_.faceStarts[facet];
        const uint32_t sides = cage_.sides(facet);
        const auto wrapped = [&](uint32_t i) { return first + (i < sides ? i : i - sides); };
        const auto far = [&](uint32_t steps) {
            return last ? vertex : cage_.faceVertices[wrapped(corner - first + steps)];
        };
        const std::array<uint32_t, 4> vertices{vertex, topology_.spokeVertices[spokes[k]], far(2), far(sides - 2)};

        std::array<uint32_t, 4> places{};
        uint32_t element = records_[facet];
        for (size_t i = 0; i < 4 && element != cage::kNone; ++i) {
            const uint32_t begin = firstCorners_.empty() ? 0 : firstCorners_[facet];
            while (places[i] < std::min(sides, 4u) && points_[wrapped(begin + places[i])] != vertices[i]) {
                ++places[i];
            }
            if (places[i] == std::min(sides, 4u)) {
                element = cage::kNone;
            }
        }
        if (element == cage::kNone) {
            places = {0, 1, 2, 3};
            element = writer_.element();
            writer_.put(vertices);
        }
        words_.push_back(element << shared::kRingPlaceBits | places[0] | places[1] << 2 | places[2] << 4 |
                         places[3] << 6);
    }
}

uint32_t RingWriter::write() {
    const uint32_t first = 4 * writer_.element();
    writer_.put(words_);
    return first;
}

} // namespace supple::surface
