#include "surface/chains/fan_points.h"

namespace supple::surface::chains {

FanPoints::FanPoints(const RefinedMesh& mesh, const Corners& corners, std::span<const uint8_t> isNeeded)
    : mesh_(mesh), corners_(corners), points_(mesh), isClosed_(mesh.cage.vertexCount(), 0) {
    for (const FanRun& run : corners.runs()) {
        isClosed_[run.vertex] = run.closed ? 1 : 0;
    }
    groups_.groupOf.assign(isNeeded.size(), cage::kNone);
    groups_.starts.push_back(0);
    for (const FanRun& run : corners.runs()) {
        bits_.push_back(0);
        if (run.closed) {
            add(run, isNeeded);
        }
        groupOfRun_.push_back(bits_.back() == 0 ? cage::kNone : static_cast<uint32_t>(groups_.starts.size() - 1));
        if (bits_.back() == 0) {
            bits_.pop_back();
        } else {
            groups_.starts.push_back(static_cast<uint32_t>(groups_.rows.size()));
        }
    }
}

void FanPoints::add(const FanRun& run, std::span<const uint8_t> isNeeded) {
    const auto take = [&](uint32_t row, uint32_t bit, bool makes) {
        if (makes && isNeeded[row] != 0 && groups_.groupOf[row] == cage::kNone) {
            groups_.groupOf[row] = static_cast<uint32_t>(groups_.starts.size() - 1);
            groups_.rows.push_back(row);
            bits_.back() |= 1u << bit;
        }
    };
    const std::vector<uint32_t> spokes = corners_.spokesOf(run);
    const auto cornerOf = [&](uint32_t k) { return mesh_.topology.sectorCorners[spokes[k]]; };
    take(run.vertex, 0, true);
    for (uint32_t k = 0; k < run.faces; ++k) {
        take(points_.edgePoint(cornerOf(k)), shared::kFanEdges + k, makesEdge(run.vertex, cornerOf(k)));
    }
    for (uint32_t k = 0; k < run.faces; ++k) {
        const uint32_t face = points_.faceOf(cornerOf(k));
        take(points_.facePoint(face), shared::kFanFaces + k, makesFace(run.vertex, face));
    }
}

bool FanPoints::makesEdge(uint32_t vertex, uint32_t corner) const {
    const uint32_t first = mesh_.topology.edges[mesh_.topology.cornerEdges[corner]].corner,
                   from = points_.vertexAt(first);
    return vertex == (isClosed_[from] != 0 ? from : points_.vertexAt(points_.next(first)));
}

bool FanPoints::makesFace(uint32_t vertex, uint32_t face) const {
    for (uint32_t c = mesh_.cage.faceStarts[face]; c < mesh_.cage.faceStarts[face + 1]; ++c) {
        if (isClosed_[points_.vertexAt(c)] != 0) {
            return points_.vertexAt(c) == vertex;
        }
    }
    return false;
}

} // namespace supple::surface::chains
