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
    Tables t;
    TableWriter writer(t.words);
    const uint32_t vertexCount = cage.vertexCount(), faceCount = cage.faceCount();
    const auto spokeCount = static_cast<uint32_t>(topology.spokeVertices.size());

    // Spokes lie vertex by vertex: regular interior ones first; the others by class, so that neighbouring lanes loop
    // equally long.
    std::vector<uint32_t> order(vertexCount);
    for (uint32_t v = 0; v < vertexCount; ++v) {
        order[v] = v;
    }
    const auto rank = [&](uint32_t v) {
        const bool interiorRegular = topology.boundary[v] == 0 && topology.sectorCount(v) == 4;
        return std::tuple(!interiorRegular, topology.spokeCount(v), topology.boundary[v]);
    };
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
    std::vector<uint32_t> slots(spokeCount);
    uint32_t nextSlot = 0;
    for (const uint32_t v : order) {
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            slots[s] = nextSlot++;
        }
    }
    const auto cornerSlot = [&](uint32_t c) { return slots[topology.cornerSpokes[c]]; };

    // Pool: X, TG, FC, H of the perturbed edges, four zeros.
    t.tangents = vertexCount;
    t.faces = t.tangents + spokeCount;
    t.inner = t.faces + spokeCount;
    std::vector<uint32_t> perturbedEdges, edgeSlots(topology.edges.size(), cage::kNone);
    for (uint32_t e = 0; e < topology.edges.size(); ++e) {
        if (isPerturbed(cage, topology, e)) {
            edgeSlots[e] = t.inner + 4 * static_cast<uint32_t>(perturbedEdges.size());
            perturbedEdges.push_back(e);
        }
    }
    const uint32_t zero = t.inner + 4 * static_cast<uint32_t>(perturbedEdges.size());
    t.poolStride = (zero + 4 + 15) / 16 * 16;

    ClassTable classes(topology, options);
    classes.write(writer, vertexCount);

    for (uint32_t v : order) {
        const uint32_t spokes = topology.spokeCount(v);
        const bool regularFan = !std::get<0>(rank(v));
        const Kernel kernel = regularFan                     ? Kernel::prepVertexRegular
                              : spokes <= shared::kFewSpokes ? Kernel::prepVertex
                                                             : Kernel::prepVertexMany;
        if (t.constructions.empty() || t.constructions.back().kernel != kernel) {
            t.constructions.push_back({Stage::vertex, kernel, {writer.element(), 0}, 0});
        }
        ++t.constructions.back().section.count;
        t.constructions.back().coefficients += 1 + 2 * spokes;
        if (!regularFan) {
            writer.put({slots[topology.spokeStarts[v]], classes.element(v)});
        }
    }

    // Edge classes, then edges.
    t.edgeClasses = writer.element();
    std::map<std::pair<double, double>, uint32_t> edgeClasses;
    for (uint32_t e : perturbedEdges) {
        const cage::Topology::Edge& edge = topology.edges[e];
        const std::pair key(classes.c(cage.faceVertices[edge.corner]), classes.c(cage.faceVertices[edge.twin]));
        if (edgeClasses.contains(key)) {
            continue;
        }
        edgeClasses.emplace(key, static_cast<uint32_t>(edgeClasses.size()));
        const EdgeWeights weights = makeEdgeWeights(key.first, key.second);
        for (size_t vector = 0; vector < 6; ++vector) {
            writer.put({floatBits(weights[0][vector]), floatBits(weights[1][vector]), floatBits(weights[2][vector]),
                        floatBits(weights[3][vector])});
        }
    }
    const auto corner = [&](uint32_t c, uint32_t steps) {
        const uint32_t first = cage.faceStarts[topology.cornerFaces[c]];
        return first + (c - first + steps) % 4;
    };
    const auto edgeCount = static_cast<uint32_t>(perturbedEdges.size());
    t.constructions.push_back({Stage::edge, Kernel::prepEdge, {writer.element(), edgeCount}, 4 * edgeCount});
    for (uint32_t e : perturbedEdges) {
        const uint32_t f = topology.edges[e].corner, o = topology.edges[e].twin; // faces left and right of A -> B
        const uint32_t a = cage.faceVertices[f], b = cage.faceVertices[o];
        const uint32_t edgeClass = edgeClasses.at({classes.c(a), classes.c(b)});
        writer.put({a | edgeClass << shared::kPointBits, spokeWord(cornerSlot(f), cornerSlot(corner(o, 1))),
                    b | edgeClass >> (32 - shared::kPointBits) << shared::kPointBits,
                    spokeWord(cornerSlot(o), cornerSlot(corner(f, 1)))});
    }

    const auto smoothCorner = [&](uint32_t v) {
        return options.cornerRule == CornerRule::smooth && topology.boundary[v] != 0 && topology.sectorCount(v) == 1;
    };

    // Patches.
    std::vector<DraftPatch> patches;
    for (uint32_t face = 0; face < faceCount; ++face) {
        if (std::binary_search(cage.holes.begin(), cage.holes.end(), face)) {
            continue;
        }
        DraftPatch& patch = patches.emplace_back();
        patch.facet = patch.info.face = face;
        patch.material = cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[face];
        for (uint32_t j = 0; j < 4; ++j) {
            const uint32_t c = cage.faceStarts[face] + j;
            patch.cageCorners[j] = c;
            patch.info.corners[j] = cage.faceVertices[c];
            if (edgeSlots[topology.cornerEdges[c]] != cage::kNone) {
                patch.info.patchClass = PatchClass::perturbed;
            }
            t.cornerNormals = t.cornerNormals || smoothCorner(cage.faceVertices[c]);
        }
    }
    sortPatches(patches);

    RingWriter ring(writer, faceCount);
    for (uint32_t p = 0; p < patches.size(); ++p) {
        const DraftPatch& patch = patches[p];
        const PatchClass patchClass = patch.info.patchClass;
        if (t.ranges.empty() || t.ranges.back().patchClass != patchClass) {
            t.ranges.push_back({patchClass, {writer.element(), 0}, p, 0});
        }
        ++t.ranges.back().section.count;
        ring.setRecord(patch.facet, writer.element());
        std::array<uint32_t, 4> spokes{}, edges{}, normals{};
        for (uint32_t j = 0; j < 4; ++j) {
            const uint32_t c = patch.cageCorners[j];
            const uint32_t v = patch.info.corners[j];
            spokes[j] = spokeWord(cornerSlot(c), slots[topology.cornerSpokesBack[c]]);
            const uint32_t edge = topology.cornerEdges[c];
            edges[j] = edgeSlots[edge] == cage::kNone ? zero | shared::kStillEdgeOfPatch : edgeSlots[edge];
            edges[j] |= topology.edges[edge].corner == c ? 0u : shared::kReversedEdgeOfPatch;
            normals[j] = smoothCorner(v) ? t.faces + slots[topology.spokeStarts[v]] + 1 : shared::kNoNormal;
        }
        const std::array<uint32_t, kMaxSides>& points = patch.info.corners;
        writer.put({points[0], points[1], points[2], points[3], spokes[0], spokes[1], spokes[2], spokes[3]});
        if (patchClass == PatchClass::perturbed) {
            writer.put({edges[0], edges[1], edges[2], edges[3]});
        }
        if (t.cornerNormals) {
            writer.put({normals[0], normals[1], normals[2], normals[3]});
        }
    }

    for (const uint32_t v : order) {
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            // The last spoke of a boundary fan has no face behind it: its far end is in the one before.
            const uint32_t own = topology.sectorCorners[s],
                           c = own == cage::kNone ? topology.sectorCorners[s - 1] : own;
            const uint32_t face = topology.cornerFaces[c];
            const uint32_t diagonal = own == cage::kNone ? v : cage.faceVertices[corner(c, 2)];
            ring.add({v, topology.spokeVertices[s], diagonal, diagonal}, face,
                     std::span(cage.faceVertices).subspan(cage.faceStarts[face], 4));
        }
    }
    t.ring = ring.write();
    finishTables(cage, patches, writer, t);
    return t;
}

} // namespace supple::surface::prep
