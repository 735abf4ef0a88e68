#include "surface/mesh_tables.h"

#include "surface/patch_records.h"
#include "surface/uv_curves.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

namespace supple::surface {

namespace {

using namespace shared;

static_assert(kPlainEdges < kPerturbedEdges && kPerturbedEdges < kMixedEdges && kMixedEdges < kHalvesEdges &&
              kHalvesEdges < kTriangleEdges && kTriangleEdges < kIrregularTriangleEdges &&
              kIrregularTriangleEdges < kSharpTriangleEdges);

/// Numbers corners in the order in which they come.
class MeshCorners {
public:
    /// `corner`: PatchSide::corner.
    uint32_t number(uint32_t corner, uint32_t attributes, int8_t hand) {
        const auto [known, isNew] = known_.try_emplace(uint64_t{corner} << 32 | attributes);
        if (isNew) {
            known->second.fill(cage::kNone);
        }
        uint32_t& number = known->second[static_cast<size_t>(hand + 1)];
        number = number == cage::kNone ? count_++ : number;
        return number;
    }
    [[nodiscard]] uint32_t count() const { return count_; }

private:
    std::unordered_map<uint64_t, std::array<uint32_t, 3>> known_; ///< by corner and attributes; by hand
    uint32_t count_ = 0;
};

/// Derivatives on edges are those along it and towards the centre.
bool hasSectorFrames(PatchClass patchClass) {
    return rowOf(patchClass).hasSectors() || rowOf(patchClass).borders == Borders::splines;
}

class MeshBuilder {
public:
    MeshBuilder(const PatchEdges& edges, bool attributes, Tables& tables)
        : given_(edges), attributes_(attributes), tables_(tables) {}

    void build() {
        collect();
        chooseSides();
        order();
        writeEdges();
        if (attributes_) {
            writeAttributes();
        }
    }

private:
    struct Side {
        uint32_t patch = 0, number = 0;   ///< of the mesh's patch
        const PatchSide* given = nullptr; ///< null: the edge has no such side
    };
    struct Edge {
        std::array<Side, 2> sides;       ///< the second against the edge's own direction
        std::array<uint32_t, 2> ends{};  ///< corners
        uint32_t corner = kNoEdgeSample; ///< whose sample it stores
        uint32_t taken = 0;

        [[nodiscard]] const Side& source() const { return sides[taken]; }
    };

    /// Numbers corners and edges in the order in which patches come to them.
    void collect() {
        MeshCorners corners;
        firsts_.assign(given_.edgeBound(), cage::kNone);
        uint32_t corner = 0; // of all patches
        for (uint32_t p = 0; p < tables_.patches.size(); ++p) {
            std::array<const PatchSide*, kMaxSides> sides{};
            uint32_t count = 0;
            for (const PatchSide& side : given_.sidesOf(p)) {
                if (!side.isPoint) {
                    sides[count++] = &side;
                }
            }
            const int8_t hand = tables_.mesh.tangents ? given_.hands[p] : int8_t{0};
            MeshTables::Patch& own = tables_.mesh.patches.emplace_back();
            for (uint32_t i = 0; i < count; ++i, ++corner) {
                own.corners[i] = corners.number(sides[i]->corner, attributes_ ? given_.attributes[corner] : 0, hand);
            }
            for (uint32_t i = 0; i < count; ++i) {
                addSide({p, i, sides[i]}, own.corners[(i + 1) % count], own);
            }
        }
        tables_.mesh.edgeCount = static_cast<uint32_t>(edges_.size());
        tables_.mesh.cornerCount = corners.count();
    }

    /// For now an edge runs from the corner with the smaller number to the other one.
    void addSide(const Side& side, uint32_t end, MeshTables::Patch& own) {
        const uint32_t begin = own.corners[side.number];
        const bool reversed = end < begin;
        const std::array<uint32_t, 2> ends = {std::min(begin, end), std::max(begin, end)};
        uint32_t& first = firsts_[side.given->edge];
        uint32_t edge = first;
        if (first == cage::kNone || side.given->creased || edges_[first].ends != ends) {
            edge = static_cast<uint32_t>(edges_.size());
            edges_.emplace_back().ends = ends;
            first = first == cage::kNone ? edge : first;
        }
        edges_[edge].sides[reversed ? 1 : 0] = side;
        own.edges[side.number] = edge;
        own.reversed[side.number] = reversed;
    }

    /// Each corner's sample is stored by an edge that begins there: that of the first patch that comes to the corner.
    /// The edge is still free then, for both patches at it have the corner. It is taken from that patch's side.
    void chooseSides() {
        auto& patches = tables_.mesh.patches;
        std::vector<bool> stored(tables_.mesh.cornerCount, false);
        for (uint32_t p = 0; p < patches.size(); ++p) {
            for (uint32_t i = 0; i < tables_.patches[p].cornerCount; ++i) {
                const uint32_t corner = patches[p].corners[i];
                if (!stored[corner]) {
                    stored[corner] = true;
                    Edge& edge = edges_[patches[p].edges[i]];
                    edge.corner = corner;
                    edge.taken = patches[p].reversed[i] ? 1 : 0;
                }
            }
        }
        for (Edge& edge : edges_) {
            if (edge.corner == kNoEdgeSample) {
                edge.taken = edge.sides[0].given != nullptr ? 0 : 1;
            }
            for (uint32_t s = 0; s < 2; ++s) { // from here on an edge runs as its record does
                if (const Side& side = edge.sides[s]; side.given != nullptr) {
                    patches[side.patch].reversed[side.number] = s != edge.taken;
                }
            }
        }
    }

    /// By kind. The kernel of mixed edges takes all of P_m's.
    void order() {
        uint32_t most = kPlainEdges;
        for (const Edge& edge : edges_) {
            most = std::max(most, edge.source().given->kind);
        }
        for (const Edge& edge : edges_) {
            kinds_.push_back(most == kMixedEdges ? most : edge.source().given->kind);
        }
        order_.resize(edges_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return kinds_[a] < kinds_[b]; });
    }

    void writeEdges() {
        TableWriter writer(tables_.words);
        writer.reserve(size_t{4} * kEdgeElements * order_.size());
        MeshTables& mesh = tables_.mesh;
        for (const uint32_t e : order_) {
            if (mesh.edges.empty() || mesh.edges.back().kind != kinds_[e]) {
                mesh.edges.push_back({kinds_[e], {writer.element(), 0}});
            }
            ++mesh.edges.back().section.count;
            const Side& side = edges_[e].source();
            if (kinds_[e] < kHalvesEdges) {
                writer.put(side.given->curve);
                writer.put(side.given->across);
            } else {
                writer.put({recordOf(side.patch), side.number, 0u, 0u, 0u, 0u, 0u, 0u});
            }
            writer.put({edges_[e].corner, e, side.given->flags, side.given->extra});
        }
    }

    [[nodiscard]] uint32_t recordOf(uint32_t patch) const {
        const PatchRange& range = tables_.rangeOf(patch);
        return range.section.table + (patch - range.firstPatch) * recordElements(tables_, range.patchClass);
    }

    void writeAttributes() {
        TableWriter writer(tables_.words);
        std::vector<uint32_t> curves; // elements
        for (size_t i = 0; i < order_.size() && tables_.uvMode != cage::UvMode::all; ++i) {
            const Side& side = edges_[order_[i]].source();
            if (tables_.uvLeaves) {
                curves.push_back(uvElement(tables_, side.patch, 0));
                continue;
            }
            curves.push_back(writer.element());
            writeUvCurves(tables_, side.patch, side.number, writer);
        }
        tables_.mesh.attributes = {writer.element(), static_cast<uint32_t>(order_.size())};
        for (size_t i = 0; i < order_.size(); ++i) {
            const Side& side = edges_[order_[i]].source();
            const PatchRange& range = tables_.rangeOf(side.patch);
            const uint32_t corners = cornerCount(domainOf(range.patchClass));
            const uint32_t place = corners * (side.patch - range.firstPatch), halves = tables_.attributeHalves ? 1 : 0;
            const uint32_t form = side.number | corners << kPatchCornersShift |
                                  (hasSectorFrames(range.patchClass) ? kPatchHasSectors : 0) |
                                  (place & halves) << kPatchHalfShift;
            writer.put({range.attributes + (place >> halves), form, curves.empty() ? 0u : curves[i], 0u});
        }
    }

    const PatchEdges& given_;
    bool attributes_;
    Tables& tables_;
    std::vector<Edge> edges_;
    std::vector<uint32_t> firsts_; ///< by PatchSide::edge: the first edge of it
    std::vector<uint32_t> kinds_;  ///< by edge
    std::vector<uint32_t> order_;  ///< edges as the tables have them
};

} // namespace

void appendMeshTables(const PatchEdges& edges, bool attributes, bool tangents, Tables& tables) {
    tables.mesh.tangents = tangents;
    MeshBuilder(edges, attributes, tables).build();
}

} // namespace supple::surface
