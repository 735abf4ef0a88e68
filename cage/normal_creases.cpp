#include "cage/normal_creases.h"

#include "cage/corner_normals.h"
#include "cage/topology.h"

#include <algorithm>
#include <map>
#include <utility>

namespace supple::cage {

uint32_t creaseSplitNormals(Cage& cage) {
    const Result<Topology> topology = buildTopology(cage);
    if (!topology) {
        return 0;
    }
    std::map<std::pair<uint32_t, uint32_t>, size_t> known;
    for (size_t i = 0; i < cage.creases.size(); ++i) {
        known.emplace(std::minmax(cage.creases[i].a, cage.creases[i].b), i);
    }
    uint32_t count = 0;
    for (const Topology::Edge& edge : topology->edges) {
        if (!hasSplitNormals(cage, *topology, edge)) {
            continue;
        }
        ++count;
        const uint32_t a = cage.faceVertices[edge.corner];
        const uint32_t b = cage.faceVertices[edge.twin];
        const auto crease = known.find(std::minmax(a, b));
        if (crease == known.end()) {
            cage.creases.push_back({a, b, kHardSharpness});
        } else {
            float& sharpness = cage.creases[crease->second].sharpness;
            sharpness = std::max(sharpness, kHardSharpness);
        }
    }
    return count;
}

} // namespace supple::cage
