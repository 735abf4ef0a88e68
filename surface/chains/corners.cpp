#include "surface/chains/corners.h"

#include <algorithm>

namespace supple::surface::chains {
namespace {

bool endless(float sharpness) {
    return sharpness >= kInfiniteSharpness;
}
bool semiSharp(float sharpness) {
    return sharpness > 0.0f && !endless(sharpness);
}

uint32_t netPlace(uint32_t corner, uint32_t i, uint32_t j) {
    using shared::kNetSide;
    return SUPPLE_QUAD_NET_PLACE(corner, i, j);
}

} // namespace

VertexKind vertexKind(std::span<const float> spokes, bool open, float vertexSharpness) {
    // Two of them alone are one crease, as round a corner of a chart (cage::UvMode::none).
    const bool corner = spokes.size() > 2 || endless(vertexSharpness);
    if (corner && std::all_of(spokes.begin(), spokes.end(), endless)) {
        return VertexKind::plain;
    }
    if (vertexSharpness > 0.0f) {
        return VertexKind::chain;
    }
    if (open) {
        return spokes.size() != 3 ? VertexKind::chain : semiSharp(spokes[1]) ? VertexKind::tensor : VertexKind::plain;
    }
    if (spokes.size() != 4 || spokes[0] != spokes[2] || spokes[1] != spokes[3]) {
        return VertexKind::chain;
    }
    const int semi = (semiSharp(spokes[0]) ? 1 : 0) + (semiSharp(spokes[1]) ? 1 : 0);
    return semi == 0 ? VertexKind::plain : semi == 1 ? VertexKind::tensor : VertexKind::chain;
}

Corners::Corners(const RefinedMesh& mesh) : mesh_(mesh), runOfSector_(mesh.topology.spokeVertices.size(), cage::kNone) {
    std::vector<float> spokes;
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        spokes.clear();
        for (uint32_t s = mesh.topology.spokeStarts[v]; s < mesh.topology.spokeStarts[v + 1]; ++s) {
            spokes.push_back(mesh.edgeSharpness[cage::spokeEdge(mesh.cage, mesh.topology, s)]);
        }
        kinds_.push_back(vertexKind(spokes, mesh.topology.boundary[v] != 0, mesh.vertexSharpness[v]));
        if (kinds_.back() == VertexKind::plain) {
            addRuns(v, spokes);
        }
    }
}

void Corners::addRuns(uint32_t vertex, std::span<const float> spokes) {
    const uint32_t first = mesh_.topology.spokeStarts[vertex], sectors = mesh_.topology.sectorCount(vertex);
    std::vector<uint32_t> sharp;
    for (uint32_t k = 0; k < sectors; ++k) {
        if (endless(spokes[k])) {
            sharp.push_back(k);
        }
    }
    const auto add = [&](FanRun run) {
        for (uint32_t k = 0; k < run.faces; ++k) {
            runOfSector_[first + (run.firstSpoke + k) % sectors] = static_cast<uint32_t>(runs_.size());
        }
        runs_.push_back(run);
    };
    if (sharp.empty()) {
        add({vertex, 0, sectors, true});
        return;
    }
    for (size_t i = 0; i < sharp.size(); ++i) { // an open fan begins with its border
        const uint32_t end = i + 1 < sharp.size() ? sharp[i + 1] : sharp[0] + sectors;
        add({vertex, sharp[i], end - sharp[i], false});
    }
}

std::vector<uint32_t> Corners::spokesOf(const FanRun& run) const {
    const uint32_t first = mesh_.topology.spokeStarts[run.vertex], count = mesh_.topology.spokeCount(run.vertex);
    std::vector<uint32_t> spokes;
    for (uint32_t k = 0; k < run.spokes(); ++k) {
        spokes.push_back(first + (run.firstSpoke + k) % count);
    }
    return spokes;
}

uint32_t Corners::chainsFrom(uint32_t face, uint32_t first) const {
    uint32_t chains = 0;
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t vertex = mesh_.cage.faceVertices[cornerOf(face, first + i)];
        chains |= kinds_[vertex] == VertexKind::chain ? 1u << i : 0u;
    }
    return chains;
}

uint8_t Corners::firstCorner(uint32_t face) const {
    uint8_t best = 0;
    for (uint8_t first = 1; first < 4; ++first) {
        best = chainsFrom(face, first) < chainsFrom(face, best) ? first : best;
    }
    return best;
}

uint32_t Corners::chainsOf(uint32_t face) const {
    return chainsFrom(face, firstCorner(face));
}

QuadNet Corners::netOf(uint32_t face, uint32_t first, const StepPoints& points) const {
    const cage::Topology& topology = mesh_.topology;
    std::array<bool, std::tuple_size_v<QuadNet>> read{};
    QuadNet net{};
    net.fill(points.facePoint(face));
    for (uint32_t c = 0; c < 4; ++c) {
        const uint32_t corner = cornerOf(face, first + c);
        net[netPlace(c, 1, 1)] = points.vertexAt(corner);
        net[netPlace(c, 2, 1)] = points.edgePoint(corner);
        if (const uint32_t twin = topology.twins[corner]; twin != cage::kNone) {
            const uint32_t onward = points.next(twin), across = topology.twins[onward];
            net[netPlace(c, 1, 0)] = points.edgePoint(onward);
            net[netPlace(c, 2, 0)] = points.facePoint(points.faceOf(twin));
            net[netPlace(c, 3, 0)] = points.edgePoint(points.previous(twin));
            if (across != cage::kNone) { // of four faces the one across the corner
                net[netPlace(c, 0, 0)] = points.facePoint(points.faceOf(across));
            }
        }
        for (uint32_t i = 1; i < 4; ++i) { // the middle of the side
            read[netPlace(c, i, 0)] = read[netPlace(c, i, 1)] = true;
        }
        for (uint32_t k = 0; k < 16 && kinds_[points.vertexAt(corner)] != VertexKind::chain; ++k) {
            read[netPlace(c, k % 4, k / 4)] = true;
        }
    }
    for (size_t k = 0; k < net.size(); ++k) {
        net[k] = read[k] ? net[k] : points.facePoint(face);
    }
    return net;
}

} // namespace supple::surface::chains
