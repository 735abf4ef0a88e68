#include "surface/subdivision.h"

#include "cage/features.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace supple::surface {
namespace {

using cage::Cage;
using cage::Topology;

float markedInfinite(float sharpness) {
    return sharpness >= cage::kHardSharpness ? kInfiniteSharpness : sharpness;
}

/// Writes stencil rows of a level from combinations of its parent's points.
class RowWriter {
public:
    RowWriter(const Stencils& parent, uint32_t vertices, Stencils& out)
        : parent_(parent), out_(out), sums_(vertices, 0.0), met_(vertices, 0) {
        out_.starts.push_back(0);
    }

    void add(uint32_t parentPoint, double weight) {
        for (uint32_t i = parent_.starts[parentPoint]; i < parent_.starts[parentPoint + 1]; ++i) {
            const uint32_t v = parent_.vertices[i];
            if (met_[v] == 0) {
                met_[v] = 1;
                touched_.push_back(v);
            }
            sums_[v] += weight * parent_.weights[i];
        }
    }

    void close() {
        std::sort(touched_.begin(), touched_.end());
        for (const uint32_t v : touched_) {
            out_.vertices.push_back(v);
            out_.weights.push_back(sums_[v]);
            sums_[v] = 0.0;
            met_[v] = 0;
        }
        touched_.clear();
        out_.starts.push_back(static_cast<uint32_t>(out_.vertices.size()));
    }

private:
    const Stencils& parent_;
    Stencils& out_;
    std::vector<double> sums_; ///< per vertex of the cage
    std::vector<uint8_t> met_;
    std::vector<uint32_t> touched_;
};

class Refiner {
public:
    Refiner(const Level& parent, Subdivision subdivision, uint32_t cageVertices)
        : parent_(parent), subdivision_(subdivision), rows_(parent.stencils, cageVertices, child_.stencils) {}

    Level run() {
        for (uint32_t v = 0; v < parent_.cage.vertexCount(); ++v) {
            addVertexPoint(v);
        }
        for (uint32_t e = 0; e < parent_.topology.edges.size(); ++e) {
            addEdgePoint(e);
        }
        child_.cage.faceStarts.push_back(0);
        for (uint32_t f = 0; f < parent_.cage.faceCount(); ++f) {
            if (subdivision_ == Subdivision::catmullClark) {
                addFacePoint(f);
            }
        }
        for (uint32_t f = 0; f < parent_.cage.faceCount(); ++f) {
            if (subdivision_ == Subdivision::catmullClark) {
                addQuads(f);
            } else {
                addTriangles(f);
            }
        }
        return std::move(child_);
    }

private:
    /// What a corner of a child face is made of: corners of the parent face, all with the same weight.
    struct ChildCorner {
        uint32_t vertex = 0;
        uint32_t first = 0; ///< parent corners; first == second at a vertex point
        uint32_t second = 0;
        bool mean = false; ///< of the whole face instead
    };

    [[nodiscard]] uint32_t vertexAt(uint32_t corner) const { return parent_.cage.faceVertices[corner]; }
    [[nodiscard]] uint32_t faceOf(uint32_t corner) const { return parent_.topology.cornerFaces[corner]; }
    [[nodiscard]] uint32_t next(uint32_t corner) const {
        return cage::nextCorner(parent_.cage, faceOf(corner), corner);
    }
    [[nodiscard]] uint32_t previous(uint32_t corner) const {
        return cage::previousCorner(parent_.cage, faceOf(corner), corner);
    }

    void addVertexPoint(uint32_t v) {
        const Topology& topology = parent_.topology;
        const uint32_t base = topology.spokeStarts[v];
        sharpness_.clear();
        for (uint32_t k = 0; k < topology.spokeCount(v); ++k) {
            sharpness_.push_back(parent_.edgeSharpness[cage::spokeEdge(parent_.cage, topology, base + k)]);
        }
        const CentreStep step = centreStep(sharpness_, parent_.vertexSharpness[v]);
        if (step.smooth > 0.0) {
            addSmoothVertex(v, step.smooth);
        }
        if (step.crease > 0.0) {
            rows_.add(v, 0.75 * step.crease);
            rows_.add(topology.spokeVertices[base + step.first], 0.125 * step.crease);
            rows_.add(topology.spokeVertices[base + step.second], 0.125 * step.crease);
        }
        if (step.corner > 0.0) {
            rows_.add(v, step.corner);
        }
        rows_.close();
    }

    void addSmoothVertex(uint32_t v, double share) {
        const Topology& topology = parent_.topology;
        const double k = topology.sectorCount(v);
        const bool quads = subdivision_ == Subdivision::catmullClark;
        const CentreWeights loop = refineWeights(Subdivision::loop, topology.sectorCount(v));
        const double spoke = quads ? 1.0 / (k * k) : loop.spoke;
        rows_.add(v, share * (quads ? (k - 2.0) / k : loop.centre));
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            rows_.add(topology.spokeVertices[s], share * spoke);
            if (quads) {
                addFaceMean(faceOf(topology.sectorCorners[s]), share / (k * k));
            }
        }
    }

    void addFaceMean(uint32_t face, double weight) {
        for (uint32_t c = parent_.cage.faceStarts[face]; c < parent_.cage.faceStarts[face + 1]; ++c) {
            rows_.add(vertexAt(c), weight / parent_.cage.sides(face));
        }
    }

    void addEdgePoint(uint32_t e) {
        const auto [corner, twin] = parent_.topology.edges[e];
        const double sharp = std::clamp(static_cast<double>(parent_.edgeSharpness[e]), 0.0, 1.0);
        if (sharp > 0.0) {
            rows_.add(vertexAt(corner), 0.5 * sharp);
            rows_.add(vertexAt(next(corner)), 0.5 * sharp);
        }
        if (sharp < 1.0) {
            for (const uint32_t c : {corner, twin}) {
                if (subdivision_ == Subdivision::catmullClark) {
                    rows_.add(vertexAt(c), 0.25 * (1.0 - sharp));
                    addFaceMean(faceOf(c), 0.25 * (1.0 - sharp));
                } else {
                    rows_.add(vertexAt(c), 0.375 * (1.0 - sharp));
                    rows_.add(vertexAt(previous(c)), 0.125 * (1.0 - sharp));
                }
            }
        }
        rows_.close();
    }

    void addFacePoint(uint32_t f) {
        addFaceMean(f, 1.0);
        rows_.close();
    }

    [[nodiscard]] ChildCorner vertexPoint(uint32_t corner) const { return {vertexAt(corner), corner, corner, false}; }
    [[nodiscard]] ChildCorner edgePoint(uint32_t corner) const {
        return {parent_.cage.vertexCount() + parent_.topology.cornerEdges[corner], corner, next(corner), false};
    }
    [[nodiscard]] ChildCorner facePoint(uint32_t face) const {
        const auto edges = static_cast<uint32_t>(parent_.topology.edges.size());
        return {parent_.cage.vertexCount() + edges + face, 0, 0, true};
    }

    void addQuads(uint32_t f) {
        for (uint32_t c = parent_.cage.faceStarts[f]; c < parent_.cage.faceStarts[f + 1]; ++c) {
            addFace(f, std::array{vertexPoint(c), edgePoint(c), facePoint(f), edgePoint(previous(c))});
        }
    }

    void addTriangles(uint32_t f) {
        const uint32_t first = parent_.cage.faceStarts[f];
        for (uint32_t c = first; c < first + 3; ++c) {
            addFace(f, std::array{vertexPoint(c), edgePoint(c), edgePoint(previous(c))});
        }
        addFace(f, std::array{edgePoint(first), edgePoint(first + 1), edgePoint(first + 2)});
    }

    void addFace(uint32_t f, std::span<const ChildCorner> corners) {
        for (const ChildCorner& corner : corners) {
            child_.cage.faceVertices.push_back(corner.vertex);
            forEachCornerAttribute(parent_.cage, child_.cage, [&](const auto& from, auto& to) {
                if (!from.empty()) {
                    to.push_back(corner.mean ? faceMean(from, f) : (from[corner.first] + from[corner.second]) * 0.5f);
                }
            });
        }
        closeFace(child_, parent_, f);
    }

    template <class Value>
    [[nodiscard]] Value faceMean(const std::vector<Value>& values, uint32_t f) const {
        Value sum(0.0f);
        for (uint32_t c = parent_.cage.faceStarts[f]; c < parent_.cage.faceStarts[f + 1]; ++c) {
            sum += values[c];
        }
        return sum / static_cast<float>(parent_.cage.sides(f));
    }

    const Level& parent_;
    Subdivision subdivision_;
    Level child_;
    RowWriter rows_;
    std::vector<float> sharpness_; ///< of the vertex at work
};

void placeVertices(Level& level, const std::vector<glm::vec3>& positions) {
    const Stencils& stencils = level.stencils;
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        glm::dvec3 sum(0.0);
        for (uint32_t i = stencils.starts[row]; i < stencils.starts[row + 1]; ++i) {
            sum += stencils.weights[i] * glm::dvec3(positions[stencils.vertices[i]]);
        }
        level.cage.positions.emplace_back(sum);
    }
}

} // namespace

void closeFace(Level& to, const Level& from, uint32_t face) {
    to.cage.faceStarts.push_back(to.cage.cornerCount());
    to.sourceFaces.push_back(from.sourceFaces[face]);
    to.holes.push_back(from.holes[face]);
    if (!from.cage.faceMaterials.empty()) {
        to.cage.faceMaterials.push_back(from.cage.faceMaterials[face]);
    }
}

Level givenLevel(const Cage& cage) {
    Level level;
    level.cage = cage;
    level.cage.creases.clear();
    level.cage.sharpVertices.clear();
    level.cage.creaseScalars.clear();
    level.cage.holes.clear();
    level.cage.sourceVertices.clear(); // a child's vertices come from no file
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        level.sourceFaces.push_back(f);
    }
    level.holes.assign(cage.faceCount(), 0);
    for (const uint32_t f : cage.holes) {
        if (f < cage.faceCount()) {
            level.holes[f] = 1;
        }
    }
    return level;
}

void beginLevel(Level& level, const Cage& cage, std::vector<std::string>& notes) {
    Cage featured;
    featured.positions.resize(cage.positions.size());
    featured.faceStarts = level.cage.faceStarts;
    featured.faceVertices = level.cage.faceVertices;
    featured.creases = cage.creases;
    featured.sharpVertices = cage.sharpVertices;
    const cage::Features features = cage::buildFeatures(featured, level.topology);
    notes.insert(notes.end(), features.unused.begin(), features.unused.end());
    if (!cage.creaseScalars.empty()) {
        notes.push_back(std::to_string(cage.creaseScalars.size()) +
                        " crease scalars: not used, they are for P_m alone");
    }
    for (const float sharpness : features.edgeSharpness) {
        level.edgeSharpness.push_back(markedInfinite(sharpness));
    }
    for (uint32_t v = 0; v < level.cage.vertexCount(); ++v) {
        const bool tip = level.topology.boundary[v] != 0 && level.topology.sectorCount(v) == 1;
        level.vertexSharpness.push_back(tip ? kInfiniteSharpness : markedInfinite(features.vertexSharpness[v]));
        level.stencils.starts.push_back(v);
        level.stencils.vertices.push_back(v);
        level.stencils.weights.push_back(1.0);
    }
    level.stencils.starts.push_back(level.cage.vertexCount());
}

Level refine(const Level& parent, Subdivision subdivision, const std::vector<glm::vec3>& cagePositions) {
    Level child = Refiner(parent, subdivision, static_cast<uint32_t>(cagePositions.size())).run();
    placeVertices(child, cagePositions);
    return child;
}

std::optional<Error> equip(Level& child, const Level& parent) {
    Result<Topology> topology = cage::buildTopology(child.cage);
    if (!topology.ok()) {
        return topology.error();
    }
    child.topology = std::move(*topology);
    child.edgeSharpness.assign(child.topology.edges.size(), 0.0f);
    child.vertexSharpness.assign(child.cage.vertexCount(), 0.0f);
    for (uint32_t v = 0; v < parent.cage.vertexCount(); ++v) {
        child.vertexSharpness[v] = softened(parent.vertexSharpness[v], 1);
    }
    for (uint32_t c = 0; c < parent.cage.cornerCount(); ++c) {
        const float sharpness = softened(parent.edgeSharpness[parent.topology.cornerEdges[c]], 1);
        const EdgeHalves halves = edgeHalves(child, parent, c);
        child.edgeSharpness[halves.first] = sharpness;
        child.edgeSharpness[halves.second] = sharpness;
    }
    return std::nullopt;
}

EdgeHalves edgeHalves(const Level& child, const Level& parent, uint32_t corner) {
    // The quad of the corner begins with the first half of its edge; the quad of the next corner ends with the second.
    const uint32_t next = cage::nextCorner(parent.cage, parent.topology.cornerFaces[corner], corner);
    return {child.topology.cornerEdges[4 * corner], child.topology.cornerEdges[4 * next + 3]};
}

} // namespace supple::surface
