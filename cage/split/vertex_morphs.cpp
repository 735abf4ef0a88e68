#include "cage/split/vertex_morphs.h"

namespace supple::cage::split {

void VertexMorphs::append(size_t vertexCount, std::span<const std::pair<uint32_t, MorphDelta>> moved) {
    std::vector<uint32_t> next(vertexCount, 0);
    for (const auto& [vertex, delta] : moved) {
        ++next[vertex];
    }
    for (uint32_t& place : next) {
        const uint32_t count = place;
        place = starts_.back();
        starts_.push_back(starts_.back() + count);
    }
    deltas_.resize(starts_.back());
    for (const auto& [vertex, delta] : moved) {
        deltas_[next[vertex]++] = delta;
    }
}

} // namespace supple::cage::split
