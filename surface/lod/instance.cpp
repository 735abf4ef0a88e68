#include "surface/lod/instance.h"

#include "cage/topology.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace supple::surface::lod {

namespace {

/// What lies opposite spoke k of a vertex: the spoke in between the two that are, at odd valences; at boundaries the
/// other boundary edge, and the vertex itself for what runs inwards.
glm::vec3 beyond(const cage::Cage& cage, const cage::Topology& topology, uint32_t vertex, uint32_t k) {
    const uint32_t first = topology.spokeStarts[vertex], count = topology.spokeCount(vertex);
    const auto end = [&](uint32_t spoke) { return cage.positions[topology.spokeVertices[first + spoke]]; };
    if (topology.boundary[vertex] != 0) {
        return k == 0 ? end(count - 1) : k == count - 1 ? end(0) : cage.positions[vertex];
    }
    return 0.5f * (end((k + count / 2) % count) + end((k + (count + 1) / 2) % count));
}

} // namespace

InstanceMeasure measureInstance(const cage::Cage& cage, uint32_t halvings, float uneven, const cage::Cage* whole) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology || cage.positions.empty()) {
        return {};
    }
    const std::vector<glm::vec3>& inBox = whole != nullptr ? whole->positions : cage.positions;
    glm::vec3 low = inBox.front(), high = low;
    for (const glm::vec3& p : inBox) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    InstanceMeasure measure;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        for (uint32_t k = 0; k < topology->spokeCount(v); ++k) {
            const glm::vec3 own = cage.positions[v];
            const glm::vec3 end = cage.positions[topology->spokeVertices[topology->spokeStarts[v] + k]];
            const glm::vec3 other = beyond(cage, *topology, v, k);
            measure.longest = std::max(measure.longest, glm::length(end - own));
            measure.bend = std::max(measure.bend, glm::length((end - own) + (other - own)) / 6.0f);
        }
    }
    const float diagonal = glm::length(high - low);
    if (diagonal <= 0.0f) {
        return {};
    }
    const float part = 1.0f / static_cast<float>(1u << halvings); // of an edge; second differences shrink by its square
    return {measure.longest * part / diagonal, uneven * measure.bend * part * part / diagonal};
}

} // namespace supple::surface::lod
