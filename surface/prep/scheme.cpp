#include "surface/prep/scheme.h"

#include "shaders/shared/prep.h"
#include "surface/borders.h"
#include "surface/ring_writer.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <bit>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace supple::surface::prep {

namespace {

/// By kind of fan.
constexpr KindOfKernel kVertexKernels[] = {
    {Kernel::prepVertex, shared::kRegularFan, "supple p-rep vertex, regular"},
    {Kernel::prepVertex, shared::kFewFan, "supple p-rep vertex"},
    {Kernel::prepVertex, shared::kManyFan, "supple p-rep vertex, many spokes"},
};
constexpr KindOfKernel kEdgeKernel = {Kernel::prepEdge, 0, "supple p-rep edge"};

bool regular(const cage::Topology& topology, uint32_t vertex) {
    return topology.effectiveValence(vertex) == 4;
}

/// Valence classes in use, each written once.
class ClassTable {
public:
    ClassTable(const cage::Topology& topology, const Options& options) : topology_(topology), options_(options) {}

    void write(TableWriter& writer, uint32_t vertexCount) {
        for (uint32_t v = 0; v < vertexCount; ++v) {
            const auto key = keyOf(v);
            if (elements_.contains(key)) {
                continue;
            }
            const ValenceClass c = makeValenceClass(key.first, key.second, options_);
            elements_[key] = writer.element();
            cosines_[key] = c.c;
            writer.put({c.sectors | (c.boundary ? shared::kBoundaryClass : 0u), 0u, 0u, 0u});
            const uint32_t spokes = c.sectors + (c.boundary ? 1u : 0u);
            for (uint32_t k = 0; k < spokes; ++k) {
                // The last spoke of a boundary fan has no sector: its diagonal counts nothing.
                const bool sector = k < c.sectors;
                writer.put({floatBits(c.limitEdge[k]), floatBits(sector ? c.limitFace[k] : 0.0), floatBits(c.e1Edge[k]),
                            floatBits(sector ? c.e1Face[k] : 0.0), floatBits(c.e2Edge[k]),
                            floatBits(sector ? c.e2Face[k] : 0.0), floatBits(c.cosines[k]), floatBits(c.sines[k])});
            }
        }
    }
    [[nodiscard]] uint32_t element(uint32_t vertex) const { return elements_.at(keyOf(vertex)); }
    [[nodiscard]] double c(uint32_t vertex) const { return cosines_.at(keyOf(vertex)); }

private:
    [[nodiscard]] std::pair<uint32_t, bool> keyOf(uint32_t v) const {
        return {topology_.sectorCount(v), topology_.boundary[v] != 0};
    }
    const cage::Topology& topology_;
    Options options_;
    std::map<std::pair<uint32_t, bool>, uint32_t> elements_;
    std::map<std::pair<uint32_t, bool>, double> cosines_;
};

class Builder {
public:
    Builder(const cage::Cage& cage, const cage::Topology& topology, const Options& options)
        : cage_(cage), topology_(topology), options_(options), writer_(tables_.words), classes_(topology, options) {}

    Tables build() {
        sortVertices();
        layOutPool();
        classes_.write(writer_, cage_.vertexCount());
        writeVertices();
        writeEdgeClasses();
        writeEdges();
        sortedPatches();
        RingWriter ring(writer_, cage_.faceCount());
        writePatches(ring);
        writeRing(ring);
        finishTables(cage_, patches_, writer_, tables_);
        return std::move(tables_);
    }

private:
    [[nodiscard]] bool hasRegularFan(uint32_t v) const {
        return topology_.boundary[v] == 0 && topology_.sectorCount(v) == 4;
    }
    [[nodiscard]] bool isSmoothCorner(uint32_t v) const {
        return options_.cornerRule == CornerRule::smooth && topology_.boundary[v] != 0 && topology_.sectorCount(v) == 1;
    }
    [[nodiscard]] uint32_t cornerSlot(uint32_t c) const { return slots_[topology_.cornerSpokes[c]]; }
    /// The corner of the same face, so many steps on.
    [[nodiscard]] uint32_t corner(uint32_t c, uint32_t steps) const {
        const uint32_t first = cage_.faceStarts[topology_.cornerFaces[c]];
        return first + (c - first + steps) % 4;
    }
    /// What the edges of a class have in common: the weights of both ends.
    [[nodiscard]] std::pair<double, double> edgeKey(uint32_t edge) const {
        const cage::Topology::Edge& e = topology_.edges[edge];
        return {classes_.c(cage_.faceVertices[e.corner]), classes_.c(cage_.faceVertices[e.twin])};
    }

    /// Spokes lie vertex by vertex: regular interior ones first; the others by class, so that neighbouring lanes loop
    /// equally long.
    void sortVertices() {
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            order_.push_back(v);
        }
        const auto rank = [&](uint32_t v) {
            return std::tuple(!hasRegularFan(v), topology_.spokeCount(v), topology_.boundary[v]);
        };
        std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
        slots_.resize(topology_.spokeVertices.size());
        uint32_t nextSlot = 0;
        for (const uint32_t v : order_) {
            for (uint32_t s = topology_.spokeStarts[v]; s < topology_.spokeStarts[v + 1]; ++s) {
                slots_[s] = nextSlot++;
            }
        }
    }

    /// X, TG, FC, H of the perturbed edges, four zeros.
    void layOutPool() {
        const auto spokeCount = static_cast<uint32_t>(topology_.spokeVertices.size());
        tables_.tangents = cage_.vertexCount();
        tables_.faces = tables_.tangents + spokeCount;
        tables_.inner = tables_.faces + spokeCount;
        edgeSlots_.assign(topology_.edges.size(), cage::kNone);
        zero_ = tables_.inner;
        for (uint32_t e = 0; e < topology_.edges.size(); ++e) {
            if (isPerturbed(cage_, topology_, e)) {
                edgeSlots_[e] = zero_;
                zero_ += 4;
                perturbedEdges_.push_back(e);
            }
        }
        tables_.poolStride = (zero_ + 4 + 15) / 16 * 16;
    }

    void writeVertices() {
        for (const uint32_t v : order_) {
            const uint32_t spokes = topology_.spokeCount(v);
            const uint32_t kind = hasRegularFan(v)               ? shared::kRegularFan
                                  : spokes <= shared::kFewSpokes ? shared::kFewFan
                                                                 : shared::kManyFan;
            countVertex(kVertexKernels[kind], 1 + 2 * spokes, writer_, tables_);
            if (kind != shared::kRegularFan) {
                writer_.put({slots_[topology_.spokeStarts[v]], classes_.element(v)});
            }
        }
    }

    void writeEdgeClasses() {
        tables_.edgeClasses = writer_.element();
        for (const uint32_t e : perturbedEdges_) {
            const auto [known, isNew] =
                edgeClasses_.try_emplace(edgeKey(e), static_cast<uint32_t>(edgeClasses_.size()));
            if (!isNew) {
                continue;
            }
            const EdgeWeights weights = makeEdgeWeights(known->first.first, known->first.second);
            for (size_t vector = 0; vector < 6; ++vector) {
                writer_.put({floatBits(weights[0][vector]), floatBits(weights[1][vector]),
                             floatBits(weights[2][vector]), floatBits(weights[3][vector])});
            }
        }
    }

    void writeEdges() {
        const auto edgeCount = static_cast<uint32_t>(perturbedEdges_.size());
        tables_.constructions.push_back({Stage::assemble, kEdgeKernel, {writer_.element(), edgeCount}, 4 * edgeCount});
        for (const uint32_t e : perturbedEdges_) {
            // Faces left and right of A -> B.
            const uint32_t f = topology_.edges[e].corner, o = topology_.edges[e].twin;
            const uint32_t a = cage_.faceVertices[f], b = cage_.faceVertices[o];
            const uint32_t edgeClass = edgeClasses_.at(edgeKey(e));
            writer_.put({a | edgeClass << shared::kPointBits, spokeWord(cornerSlot(f), cornerSlot(corner(o, 1))),
                         b | edgeClass >> (32 - shared::kPointBits) << shared::kPointBits,
                         spokeWord(cornerSlot(o), cornerSlot(corner(f, 1)))});
        }
    }

    void sortedPatches() {
        for (uint32_t face = 0; face < cage_.faceCount(); ++face) {
            if (std::binary_search(cage_.holes.begin(), cage_.holes.end(), face)) {
                continue;
            }
            DraftPatch& patch = patches_.emplace_back();
            patch.facet = patch.info.face = face;
            patch.material = cage_.faceMaterials.empty() ? cage::kNone : cage_.faceMaterials[face];
            for (uint32_t j = 0; j < 4; ++j) {
                const uint32_t c = cage_.faceStarts[face] + j;
                patch.cageCorners[j] = c;
                patch.info.corners[j] = cage_.faceVertices[c];
                if (edgeSlots_[topology_.cornerEdges[c]] != cage::kNone) {
                    patch.info.patchClass = PatchClass::perturbed;
                }
                tables_.cornerNormals = tables_.cornerNormals || isSmoothCorner(cage_.faceVertices[c]);
            }
        }
        sortPatches(patches_);
    }

    void writePatches(RingWriter& ring) {
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            const PatchClass patchClass = patch.info.patchClass;
            countPatch(patchClass, p, writer_, tables_);
            ring.setRecord(patch.facet, writer_.element());
            std::array<uint32_t, 4> spokes{}, edges{}, normals{};
            for (uint32_t j = 0; j < 4; ++j) {
                const uint32_t c = patch.cageCorners[j];
                const uint32_t v = patch.info.corners[j];
                spokes[j] = spokeWord(cornerSlot(c), slots_[topology_.cornerSpokesBack[c]]);
                const uint32_t edge = topology_.cornerEdges[c];
                edges[j] = edgeSlots_[edge] == cage::kNone ? zero_ | shared::kStillEdgeOfPatch : edgeSlots_[edge];
                edges[j] |= topology_.edges[edge].corner == c ? 0u : shared::kReversedEdgeOfPatch;
                normals[j] =
                    isSmoothCorner(v) ? tables_.faces + slots_[topology_.spokeStarts[v]] + 1 : shared::kNoNormal;
            }
            const std::array<uint32_t, kMaxSides>& points = patch.info.corners;
            writer_.put({points[0], points[1], points[2], points[3], spokes[0], spokes[1], spokes[2], spokes[3]});
            if (patchClass == PatchClass::perturbed) {
                writer_.put({edges[0], edges[1], edges[2], edges[3]});
            }
            if (tables_.cornerNormals) {
                writer_.put({normals[0], normals[1], normals[2], normals[3]});
            }
        }
    }

    void writeRing(RingWriter& ring) {
        for (const uint32_t v : order_) {
            for (uint32_t s = topology_.spokeStarts[v]; s < topology_.spokeStarts[v + 1]; ++s) {
                // The last spoke of a boundary fan has no face behind it: its far end is in the one before.
                const uint32_t own = topology_.sectorCorners[s];
                const uint32_t c = own == cage::kNone ? topology_.sectorCorners[s - 1] : own;
                const uint32_t face = topology_.cornerFaces[c];
                const uint32_t diagonal = own == cage::kNone ? v : cage_.faceVertices[corner(c, 2)];
                ring.add({v, topology_.spokeVertices[s], diagonal, diagonal}, face,
                         std::span(cage_.faceVertices).subspan(cage_.faceStarts[face], 4));
            }
        }
        tables_.ring = ring.write();
    }

    const cage::Cage& cage_;
    const cage::Topology& topology_;
    Options options_;
    Tables tables_;
    TableWriter writer_;
    ClassTable classes_;
    std::vector<uint32_t> order_; ///< vertices
    std::vector<uint32_t> slots_; ///< by spoke: its place among tangents and face coefficients
    std::vector<uint32_t> perturbedEdges_;
    std::vector<uint32_t> edgeSlots_; ///< by edge: the pool index of its H, or kNone
    uint32_t zero_ = 0;               ///< pool index of the zeros
    std::map<std::pair<double, double>, uint32_t> edgeClasses_;
    std::vector<DraftPatch> patches_;
};

} // namespace

bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge) {
    const cage::Topology::Edge& e = topology.edges[edge];
    if (e.twin == cage::kNone) {
        return false;
    }
    return !regular(topology, cage.faceVertices[e.corner]) || !regular(topology, cage.faceVertices[e.twin]);
}

Status accepts(const cage::Cage& cage) {
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        if (cage.sides(face) != 4) {
            return Error{ErrorCode::asset, "face " + std::to_string(face) + " has " + std::to_string(cage.sides(face)) +
                                               " sides: p-rep takes quads only"};
        }
    }
    return success();
}

Tables buildTables(const cage::Cage& cage, const cage::Topology& topology, const Options& options) {
    return Builder(cage, topology, options).build();
}

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology) {
        return topology.error();
    }
    const Status accepted = accepts(cage);
    if (!accepted) {
        return accepted.error();
    }
    SpokeLimits spokes;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        spokes.add(v, topology->spokeCount(v));
    }
    const Status fits = spokes.check();
    if (!fits) {
        return fits.error();
    }
    return buildTables(cage, *topology, recipe.prep);
}

} // namespace supple::surface::prep
