#include "surface/refinement.h"

#include "cage/features.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace supple::surface {
namespace {

using cage::Cage;
using cage::Topology;

float markedInfinite(float sharpness) {
    return sharpness >= cage::kHardSharpness ? kInfiniteSharpness : sharpness;
}

/// Writes stencil rows over the vertices of the parent. Entries have the order in which a row meets its vertices, which
/// follows fans and faces: the sums do not depend on how vertices are numbered, so neither do their bits.
class RowWriter {
public:
    RowWriter(uint32_t vertices, Stencils& out) : out_(out), sums_(vertices, 0.0), met_(vertices, 0) {
        out_.starts.push_back(0);
    }

    void add(uint32_t v, double weight) {
        if (met_[v] == 0) {
            met_[v] = 1;
            touched_.push_back(v);
        }
        sums_[v] += weight;
    }

    void close() {
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
    Stencils& out_;
    std::vector<double> sums_; ///< per vertex of the parent
    std::vector<uint8_t> met_;
    std::vector<uint32_t> touched_;
};

class Refiner : StepPoints {
public:
    Refiner(const RefinedMesh& parent, Subdivision subdivision)
        : StepPoints(parent), quads_(subdivision == Subdivision::catmullClark),
          rows_(parent.cage.vertexCount(), child_.stencils) {}

    RefinedMesh run() {
        reserve();
        for (uint32_t v = 0; v < parent_.cage.vertexCount(); ++v) {
            addVertexPoint(v);
        }
        for (uint32_t e = 0; e < parent_.topology.edges.size(); ++e) {
            addEdgePoint(e);
        }
        for (uint32_t f = 0; f < parent_.cage.faceCount() && quads_; ++f) {
            addFaceMean(f, 1.0);
            rows_.close();
        }
        child_.cage.faceStarts.push_back(0);
        for (uint32_t f = 0; f < parent_.cage.faceCount(); ++f) {
            quads_ ? addQuads(f) : addTriangles(f);
        }
        forEachCornerAttribute(parent_.cage, child_.cage, [&](const auto& from, auto& to) { carry(from, to); });
        return std::move(child_);
    }

private:
    void reserve() {
        const size_t corners = parent_.cage.cornerCount(),
                     faces = quads_ ? corners : 4 * size_t{parent_.cage.faceCount()};
        const size_t points = size_t{parent_.cage.vertexCount()} + parent_.topology.edges.size() +
                              (quads_ ? parent_.cage.faceCount() : 0);
        child_.cage.positions.reserve(points);
        child_.stencils.starts.reserve(points + 1);
        child_.stencils.vertices.reserve(8 * points);
        child_.stencils.weights.reserve(8 * points);
        child_.cage.faceStarts.reserve(faces + 1);
        child_.cage.faceVertices.reserve((quads_ ? 4 : 3) * faces);
        child_.sourceFaces.reserve(faces);
        forEachCornerAttribute(parent_.cage, child_.cage, [&](const auto& from, auto& to) {
            to.reserve(from.empty() ? 0 : (quads_ ? 4 : 3) * faces);
        });
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
        const CentreWeights loop = refineWeights(Subdivision::loop, topology.sectorCount(v));
        const double spoke = quads_ ? 1.0 / (k * k) : loop.spoke;
        rows_.add(v, share * (quads_ ? (k - 2.0) / k : loop.centre));
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            rows_.add(topology.spokeVertices[s], share * spoke);
            if (quads_) {
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
                if (quads_) {
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

    void addQuads(uint32_t f) {
        for (uint32_t c = parent_.cage.faceStarts[f]; c < parent_.cage.faceStarts[f + 1]; ++c) {
            addFace(f, {vertexAt(c), edgePoint(c), facePoint(f), edgePoint(previous(c))});
        }
    }

    void addTriangles(uint32_t f) {
        const uint32_t first = parent_.cage.faceStarts[f];
        for (uint32_t c = first; c < first + 3; ++c) {
            addFace(f, {vertexAt(c), edgePoint(c), edgePoint(previous(c))});
        }
        addFace(f, {edgePoint(first), edgePoint(first + 1), edgePoint(first + 2)});
    }

    void addFace(uint32_t f, std::initializer_list<uint32_t> vertices) {
        child_.cage.faceVertices.insert(child_.cage.faceVertices.end(), vertices);
        closeFace(child_.cage, parent_.cage, f);
        child_.sourceFaces.push_back(parent_.sourceFaces[f]);
    }

    /// An attribute of the children's corners, in the order of addQuads() and addTriangles(): along edges and over
    /// faces the mean.
    template <class Value>
    void carry(const std::vector<Value>& from, std::vector<Value>& to) const {
        for (uint32_t f = 0; f < parent_.cage.faceCount() && !from.empty(); ++f) {
            const uint32_t first = parent_.cage.faceStarts[f], end = parent_.cage.faceStarts[f + 1];
            const auto middle = [&](uint32_t c) { return (from[c] + from[c + 1 == end ? first : c + 1]) * 0.5f; };
            const auto before = [&](uint32_t c) { return middle(c == first ? end - 1 : c - 1); };
            if (quads_) {
                Value mean(0.0f);
                for (uint32_t c = first; c < end; ++c) {
                    mean += from[c];
                }
                mean /= static_cast<float>(end - first);
                for (uint32_t c = first; c < end; ++c) {
                    to.insert(to.end(), {from[c], middle(c), mean, before(c)});
                }
            } else {
                for (uint32_t c = first; c < end; ++c) {
                    to.insert(to.end(), {from[c], middle(c), before(c)});
                }
                to.insert(to.end(), {middle(first), middle(first + 1), middle(first + 2)});
            }
        }
    }

    bool quads_; ///< Catmull-Clark, else Loop
    RefinedMesh child_;
    RowWriter rows_;
    std::vector<float> sharpness_; ///< of the vertex at work
};

} // namespace

Result<RefinedMesh> beginRefinement(const Cage& cage, const SplitRule* rule, std::vector<std::string>& notes) {
    Result<SplitCage> split = splitFaces(cage, rule);
    if (!split) {
        return split.error();
    }
    RefinedMesh mesh{std::move(split->cage), std::move(split->sourceFaces), {}, std::move(split->topology), {}, {}};
    mesh.cage.creaseScalars.clear();
    const cage::Features features = cage::buildFeatures(mesh.cage, mesh.topology);
    mesh.cage.creases.clear();
    mesh.cage.creaseSets.clear();
    mesh.cage.sharpVertices.clear();
    mesh.cage.sourceVertices.clear(); // a child's vertices come from no file
    notes.insert(notes.end(), split->notes.begin(), split->notes.end());
    notes.insert(notes.end(), features.unused.begin(), features.unused.end());
    for (std::string& note : cage::notesOnAlphas(cage)) {
        notes.push_back(std::move(note));
    }
    for (const float sharpness : features.edgeSharpness) {
        mesh.edgeSharpness.push_back(markedInfinite(sharpness));
    }
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        const bool tip = mesh.topology.boundary[v] != 0 && mesh.topology.sectorCount(v) == 1;
        mesh.vertexSharpness.push_back(tip ? kInfiniteSharpness : markedInfinite(features.vertexSharpness[v]));
        mesh.stencils.starts.push_back(v);
        mesh.stencils.vertices.push_back(v);
        mesh.stencils.weights.push_back(1.0);
    }
    mesh.stencils.starts.push_back(mesh.cage.vertexCount());
    return mesh;
}

Stencils rowsOf(const Stencils& all, std::span<const uint32_t> rows) {
    Stencils some;
    some.starts.push_back(0);
    for (const uint32_t row : rows) {
        const auto from = static_cast<ptrdiff_t>(all.starts[row]), to = static_cast<ptrdiff_t>(all.starts[row + 1]);
        some.vertices.insert(some.vertices.end(), all.vertices.begin() + from, all.vertices.begin() + to);
        some.weights.insert(some.weights.end(), all.weights.begin() + from, all.weights.begin() + to);
        some.starts.push_back(static_cast<uint32_t>(some.vertices.size()));
    }
    return some;
}

RefinedMesh refine(const RefinedMesh& parent, Subdivision subdivision) {
    RefinedMesh child = Refiner(parent, subdivision).run();
    const Stencils& stencils = child.stencils;
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        glm::dvec3 sum(0.0);
        for (uint32_t i = stencils.starts[row]; i < stencils.starts[row + 1]; ++i) {
            sum += stencils.weights[i] * glm::dvec3(parent.cage.positions[stencils.vertices[i]]);
        }
        child.cage.positions.emplace_back(sum);
    }
    return child;
}

Status equip(RefinedMesh& child, const RefinedMesh& parent) {
    Result<Topology> topology = cage::buildTopology(child.cage);
    if (!topology) {
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
    return success();
}

EdgeHalves edgeHalves(const RefinedMesh& child, const RefinedMesh& parent, uint32_t corner) {
    // The face of the corner begins with the first half of its edge; the face of the next corner ends with the second.
    const uint32_t face = parent.topology.cornerFaces[corner];
    const uint32_t next = cage::nextCorner(parent.cage, face, corner);
    const uint32_t sides = child.cage.sides(0);
    const uint32_t middles = sides == 3 ? face : 0; // of Loop, the middle faces before
    return {child.topology.cornerEdges[sides * (corner + middles)],
            child.topology.cornerEdges[sides * (next + middles) + sides - 1]};
}

} // namespace supple::surface
