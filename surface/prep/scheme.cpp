// p-rep as a scheme: the tables of shaders/shared/{surface,prep}.h.
#include "cage/features.h"
#include "cage/message.h"
#include "shaders/shared/prep.h"
#include "surface/build.h"
#include "surface/fans.h"
#include "surface/patch_records.h"
#include "surface/prep/pool_form.h"
#include "surface/prep/smooth_uvs.h"
#include "surface/prep/weights.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace supple::surface::prep {

namespace {

class Builder {
public:
    Builder(const cage::Cage& cage, const cage::Topology& topology, const Recipe& recipe, PatchEdges* edges)
        : cage_(cage), topology_(topology), recipe_(recipe), options_(recipe.prep), edges_(edges),
          writer_(tables_.words), layout_{cage, topology, slots_}, form_(makePoolForm(layout_, recipe.fanRecords)) {}

    Result<Tables> build() {
        sortVertices();
        layOutPool();
        writeClasses();
        writeVertices();
        writeEdgeClasses();
        writeEdges();
        patches_ = draftPatches({cage_, cage_.vertexCount()}, [&](const DraftPatch& patch) { return classOf(patch); });
        RingWriter ring(cage_, topology_, cage_.faceVertices, {}, writer_);
        writePatches(ring);
        for (const uint32_t v : order_) {
            const std::span spokes = std::span(spokes_).subspan(topology_.spokeStarts[v], topology_.spokeCount(v));
            ring.add(v, spokes, topology_.boundary[v] != 0);
        }
        tables_.ring = ring.write();
        finishTables(recipe_, cage_, patches_, writer_, tables_, edges_);
        const Status smooth = writeUvs();
        if (!smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    [[nodiscard]] bool hasRegularFan(uint32_t v) const {
        return topology_.boundary[v] == 0 && topology_.sectorCount(v) == 4;
    }
    [[nodiscard]] bool isSmoothCorner(uint32_t v) const {
        return options_.cornerRule == CornerRule::smooth && topology_.boundary[v] != 0 && topology_.sectorCount(v) == 1;
    }
    /// Where the normal of a vertex comes from, or kNoNormal.
    [[nodiscard]] uint32_t normalOf(uint32_t v) const {
        return isSmoothCorner(v) ? form_->cornerNormal(v) : shared::kNoNormal;
    }
    /// Whether the face of a corner runs against the edge behind it.
    [[nodiscard]] bool isReversed(uint32_t c) const { return topology_.edges[topology_.cornerEdges[c]].corner != c; }
    /// What the edges of a class have in common: the weights of both ends.
    [[nodiscard]] std::pair<double, double> edgeKey(uint32_t edge) const {
        const cage::Topology::Edge& e = topology_.edges[edge];
        return {classes_.at(layout_.classKey(cage_.faceVertices[e.corner])).c,
                classes_.at(layout_.classKey(cage_.faceVertices[e.twin])).c};
    }

    /// Spokes lie vertex by vertex: regular interior ones first; the others by class, so that neighbouring lanes loop
    /// equally long.
    void sortVertices() {
        order_.resize(cage_.vertexCount());
        std::iota(order_.begin(), order_.end(), 0u);
        spokes_.resize(topology_.spokeVertices.size());
        std::iota(spokes_.begin(), spokes_.end(), 0u);
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

    /// What there is of fans, H of the perturbed edges, four zeros.
    void layOutPool() {
        tables_.inner = form_->layOut(tables_);
        edgeSlots_.assign(topology_.edges.size(), cage::kNone);
        zero_ = tables_.inner;
        for (uint32_t e = 0; e < topology_.edges.size(); ++e) {
            if (isPerturbed(cage_, topology_, e)) {
                edgeSlots_[e] = zero_;
                zero_ += 4;
                perturbedEdges_.push_back(e);
            }
        }
        tables_.poolStride = poolStrideFor(zero_ + 4);
    }

    void writeClasses() {
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            const auto [known, isNew] = classes_.try_emplace(layout_.classKey(v));
            if (isNew) {
                const auto [sectors, boundary] = known->first;
                const ValenceClass c = makeValenceClass(sectors, boundary, options_);
                known->second = {writeFanWeights(c, boundary ? shared::kBoundaryClass : 0u, writer_), c.c};
                form_->addClass(c, writer_);
            }
        }
    }

    void writeVertices() {
        for (const uint32_t v : order_) {
            const uint32_t spokes = topology_.spokeCount(v);
            const uint32_t kind = hasRegularFan(v)               ? shared::kRegularFan
                                  : spokes <= shared::kFewSpokes ? shared::kFewFan
                                                                 : shared::kManyFan;
            form_->countVertex(kind, spokes, writer_, tables_);
            if (kind != shared::kRegularFan) {
                writer_.put({slots_[topology_.spokeStarts[v]], classes_.at(layout_.classKey(v)).element});
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
                writer_.putFloats({weights[0][vector], weights[1][vector], weights[2][vector], weights[3][vector]});
            }
        }
    }

    void writeEdges() {
        const auto edgeCount = static_cast<uint32_t>(perturbedEdges_.size());
        tables_.constructions.push_back(
            {Stage::assemble, form_->edgeKernel(), {writer_.element(), edgeCount}, 4 * edgeCount});
        for (const uint32_t e : perturbedEdges_) {
            // Faces left and right of A -> B.
            const uint32_t f = topology_.edges[e].corner, o = topology_.edges[e].twin;
            const uint32_t a = cage_.faceVertices[f], b = cage_.faceVertices[o];
            const uint32_t edgeClass = edgeClasses_.at(edgeKey(e));
            form_->writeEdge(a | edgeClass << shared::kPointBits,
                             b | edgeClass >> (32 - shared::kPointBits) << shared::kPointBits, f, o, writer_);
        }
    }

    [[nodiscard]] PatchClass classOf(const DraftPatch& patch) const {
        const bool perturbed = std::any_of(patch.cageCorners.begin(), patch.cageCorners.begin() + 4, [&](uint32_t c) {
            return edgeSlots_[topology_.cornerEdges[c]] != cage::kNone;
        });
        return perturbed ? PatchClass::perturbed : PatchClass::regular;
    }

    void writePatches(RingWriter& ring) {
        for (const DraftPatch& patch : patches_) {
            tables_.cornerNormals =
                tables_.cornerNormals || std::any_of(patch.info.corners.begin(), patch.info.corners.begin() + 4,
                                                     [&](uint32_t v) { return isSmoothCorner(v); });
        }
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            const PatchClass patchClass = patch.info.patchClass;
            countPatch(patchClass, p, writer_, tables_);
            ring.setRecord(patch.facet, writer_.element());
            NetCorners corners;
            std::array<uint32_t, 4> spokes{}, edges{}, normals{};
            for (uint32_t j = 0; j < 4; ++j) {
                const uint32_t c = patch.cageCorners[j];
                const uint32_t v = patch.info.corners[j];
                corners.points[j] = v;
                corners.spokes[j] = layout_.slot(c);
                corners.nextSpokes[j] = slots_[topology_.cornerSpokesBack[c]];
                spokes[j] = form_->cornerWord(c);
                const uint32_t edge = topology_.cornerEdges[c];
                edges[j] = edgeSlots_[edge] == cage::kNone ? zero_ | shared::kStillEdgeOfPatch : edgeSlots_[edge];
                edges[j] |= isReversed(c) ? shared::kReversedEdgeOfPatch : 0u;
                normals[j] = normalOf(v);
            }
            writer_.put(corners.points);
            writer_.put(spokes);
            if (patchClass == PatchClass::perturbed) {
                writer_.put(edges);
            }
            if (tables_.cornerNormals) {
                writer_.put(normals);
            }
            if (edges_ != nullptr) {
                addSides(patch, corners);
            }
        }
    }

    void addSides(const DraftPatch& patch, const NetCorners& corners) {
        const NetIndices net(corners, tables_.tangents, tables_.faces, false);
        edges_->beginPatch();
        for (uint32_t j = 0; j < 4; ++j) {
            const uint32_t c = patch.cageCorners[j], normal = normalOf(patch.info.corners[j]);
            PatchSide& side = edges_->sides.emplace_back();
            side.edge = topology_.cornerEdges[c];
            side.corner = corners.points[j];
            side.curve = net.curve(j);
            side.across = net.inside(j);
            if (edgeSlots_[side.edge] != cage::kNone) {
                side.kind = shared::kPerturbedEdges;
                side.extra = edgeSlots_[side.edge];
                side.flags |= isReversed(c) ? shared::kSwappedEdge : 0;
            }
            if (normal != shared::kNoNormal) {
                side.flags |= shared::kStoredNormalEdge;
                side.extra = normal;
            }
        }
    }

    Status writeUvs() {
        const auto makeSet = [&](const std::vector<glm::vec2>& uvs) -> Result<UvPatches> {
            const Result<cage::UvChannel> channel =
                prep::buildUvChannel(cage_, topology_, options_, uvs, recipe_.uvMode);
            if (!channel) {
                return channel.error();
            }
            return UvPatches([made = UvConstruction(cage_, topology_, options_, *channel)](const DraftPatch& patch) {
                return made.patch(patch.facet);
            });
        };
        return writeSmoothUvs(recipe_, cage_, patches_, makeSet, writer_, tables_);
    }

    struct ClassEntry {
        uint32_t element = 0;
        double c = 0.0; ///< ValenceClass::c
    };

    const cage::Cage& cage_;
    const cage::Topology& topology_;
    const Recipe& recipe_;
    const Options& options_;
    PatchEdges* edges_; ///< null: nobody asks
    Tables tables_;
    TableWriter writer_;
    FanLayout layout_;
    std::unique_ptr<PoolForm> form_;
    std::map<std::pair<uint32_t, bool>, ClassEntry> classes_;
    std::vector<uint32_t> order_;  ///< vertices
    std::vector<uint32_t> spokes_; ///< of the topology, as they are
    std::vector<uint32_t> slots_;  ///< by spoke: its place among tangents and face coefficients
    std::vector<uint32_t> perturbedEdges_;
    std::vector<uint32_t> edgeSlots_; ///< by edge: the pool index of its H, or kNone
    uint32_t zero_ = 0;               ///< pool index of the zeros
    std::map<std::pair<double, double>, uint32_t> edgeClasses_;
    std::vector<DraftPatch> patches_;
};

/// What the cage has and p-rep has not.
std::vector<std::string> notesOn(const cage::Cage& cage) {
    cage::Found creases, vertices;
    for (const cage::Crease& crease : cage.creases) {
        if (crease.sharpness > 0.0f) {
            creases.add([&] { return "edge (" + std::to_string(crease.a) + ", " + std::to_string(crease.b) + ")"; });
        }
    }
    for (const cage::SharpVertex& sharp : cage.sharpVertices) {
        if (sharp.sharpness > 0.0f) {
            vertices.add([&] { return "vertex " + std::to_string(sharp.vertex); });
        }
    }
    std::vector<std::string> notes = cage::notesOnAlphas(cage);
    if (creases.count > 0) {
        notes.push_back("p-rep has no creases: " + creases.told("crease is drawn smooth", "creases are drawn smooth"));
    }
    if (vertices.count > 0) {
        notes.push_back("p-rep has no sharp vertices: " + vertices.told("is drawn smooth", "are drawn smooth"));
    }
    return notes;
}

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology) {
        return topology.error();
    }
    cage::Found others;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        if (cage.sides(face) != 4) {
            others.add([&] {
                return "face " + std::to_string(face) + " with " + std::to_string(cage.sides(face)) + " sides";
            });
        }
    }
    if (others.count > 0) {
        return Error{ErrorCode::asset, "p-rep takes quads only: " + others.told("face is none", "faces are none")};
    }
    SpokeLimits spokes;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        spokes.add(v, topology->spokeCount(v));
    }
    const Status fits = spokes.check();
    if (!fits) {
        return fits.error();
    }
    Result<Tables> tables = Builder(cage, *topology, recipe, edges).build();
    if (tables) {
        tables->notes = notesOn(cage);
    }
    return tables;
}

} // namespace supple::surface::prep
