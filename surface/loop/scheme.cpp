// Loop patches as a scheme: the tables of shaders/shared/{surface,chains}.h (docs/loop.md).
#include "surface/build.h"
#include "surface/chains/chain_tables.h"
#include "surface/chains/needed_rows.h"
#include "surface/chains/net_lists.h"
#include "surface/chains/smooth_uvs.h"
#include "surface/chains/triangles.h"
#include "surface/stencil_table.h"
#include "surface/subdivision/mesh.h"

#include <algorithm>
#include <array>
#include <string>

namespace supple::surface::loop {
namespace {

using chains::ChainTables;
using chains::VertexContent;
using subdivision::Isolation;

class Builder {
public:
    Builder(const cage::Cage& host, const Isolation& isolation, const Recipe& recipe, PatchEdges* edges)
        : host_(host), recipe_(recipe), edges_(edges), mesh_(isolation.mesh), parent_(isolation.parent),
          cage_(parent_.cage), topology_(parent_.topology), triangles_(parent_),
          lastLevel_(chains::lastChainLevel(recipe.rate)), writer_(tables_.words), fans_(lastLevel_, writer_),
          chains_({&mesh_, lastLevel_, recipe.wide, recipe.lod}, vertexContents(), fans_, writer_),
          vertices_(cage_.vertexCount()), levelOne_(mesh_.stencils.back().rows()) {
        tables_.rate = recipe.rate;
        tables_.notes = mesh_.notes;
    }

    Result<Tables> build() {
        if (const Status fits = chains_.checkSizes(); !fits) {
            return fits.error();
        }
        for (uint32_t f = 0; f < cage_.faceCount(); ++f) {
            firstCorners_.push_back(triangles_.firstCorner(f));
        }
        const std::vector<DraftPatch> patches =
            draftPatches({cage_, mesh_.hostVertices, parent_.sourceFaces, firstCorners_}, [&](DraftPatch& patch) {
                patch.kind = triangles_.chainsOf(patch.facet);
                return classOf(patch);
            });
        findPoints(patches);
        layOutPool();
        writeRows();
        chains_.write({firstLevelOne_, [&](uint32_t vertex) { return limits_[vertex]; }, false}, tables_);
        for (uint32_t p = 0; p < patches.size(); ++p) {
            countPatch(patches[p].info.patchClass, p, writer_, tables_);
            writePatch(patches[p]);
            if (netOfPatch_[p] != cage::kNone) {
                writeIrregular(patches[p], nets_[netOfPatch_[p]]);
            }
            if (edges_ != nullptr) {
                addSides(patches[p]);
            }
        }
        finishTables(recipe_, cage_, patches, writer_, tables_, edges_);
        if (const Status smooth = chains::writeUvLeaves(recipe_, host_, {Subdivision::loop, false, lastLevel_}, patches,
                                                        fans_, writer_, tables_);
            !smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    [[nodiscard]] std::vector<VertexContent> vertexContents() const {
        std::vector<VertexContent> contents;
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            contents.push_back(triangles_.isPlain(v) ? VertexContent::nothing : VertexContent::chain);
        }
        return contents;
    }
    [[nodiscard]] PatchClass classOf(const DraftPatch& patch) const {
        bool sharp = false;
        for (uint32_t i = 0; i < 3; ++i) {
            sharp = sharp || triangles_.isSemiSharp(patch.cageCorners[i]);
        }
        return sharp             ? PatchClass::loopIrregularSharp
               : patch.kind == 0 ? PatchClass::loopRegular
                                 : PatchClass::loopIrregular;
    }
    [[nodiscard]] uint32_t firstOf(const DraftPatch& patch) const { return firstCorners_[patch.facet]; }

    /// Whether both ends of a side are plain: then it is one spline, of vertices.
    [[nodiscard]] bool isWhole(const DraftPatch& patch, uint32_t side) const {
        const auto plain = [&](uint32_t i) { return triangles_.isPlain(cage_.faceVertices[patch.cageCorners[i % 3]]); };
        return plain(side) && plain(side + 1);
    }

    void findPoints(const std::vector<DraftPatch>& patches) {
        for (const DraftPatch& patch : patches) {
            for (const uint32_t vertex : triangles_.cageOf(patch.facet, firstOf(patch))) {
                vertices_.need(vertex);
            }
        }
        netOfPatch_.assign(patches.size(), cage::kNone);
        for (const uint32_t p : chains::patchesByNeighbours(patches, cage_, topology_)) {
            if (patches[p].info.patchClass != PatchClass::loopRegular) {
                netOfPatch_[p] = static_cast<uint32_t>(nets_.size());
                levelOne_.needNet(nets_.emplace_back(triangles_.netOf(patches[p].facet, firstOf(patches[p]))));
            }
        }
        chains_.findNets();
        chains_.numberNets(levelOne_);
    }

    /// Limits of plain vertices, vertices, points of level 1, other limits, then what chains have.
    void layOutPool() {
        uint32_t next = 0;
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            limits_.push_back(triangles_.isPlain(v) ? next++ : cage::kNone);
        }
        firstVertex_ = next;
        firstLevelOne_ = firstVertex_ + vertices_.count();
        next = firstLevelOne_ + levelOne_.count();
        for (uint32_t& limit : limits_) {
            limit = limit == cage::kNone ? next++ : limit;
        }
        tables_.poolStride = poolStrideFor(chains_.layOut(next));
    }

    void writeRows() {
        Stencils rows;
        rows.starts.push_back(0);
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            if (triangles_.isPlain(v)) {
                triangles_.addLimit(v, rows);
            }
        }
        for (const uint32_t vertex : vertices_.rows()) {
            rows.vertices.push_back(vertex);
            rows.weights.push_back(1.0);
            rows.starts.push_back(static_cast<uint32_t>(rows.vertices.size()));
        }
        const Stencils levelOne = rowsOf(mesh_.stencils.back(), levelOne_.rows());
        const auto before = static_cast<uint32_t>(rows.vertices.size());
        rows.vertices.insert(rows.vertices.end(), levelOne.vertices.begin(), levelOne.vertices.end());
        rows.weights.insert(rows.weights.end(), levelOne.weights.begin(), levelOne.weights.end());
        for (uint32_t row = 0; row < levelOne.rows(); ++row) {
            rows.starts.push_back(before + levelOne.starts[row + 1]);
        }
        writeStencils(rows, {}, writer_, tables_);
    }

    [[nodiscard]] uint32_t flagsOf(const DraftPatch& patch) const {
        uint32_t flags = triangles_.flagsOf(patch.cageCorners);
        for (uint32_t i = 0; i < 3; ++i) {
            flags |= isWhole(patch, i) ? 1u << (shared::kWholeTriangleSide + i) : 0u;
        }
        return flags;
    }

    void writePatch(const DraftPatch& patch) {
        for (const uint32_t vertex : triangles_.cageOf(patch.facet, firstOf(patch))) {
            writer_.put({firstVertex_ + vertices_.number(vertex)});
        }
        for (uint32_t i = 0; i < 3; ++i) {
            writer_.put({limits_[cage_.faceVertices[patch.cageCorners[i]]]});
        }
        writer_.put({flagsOf(patch)});
    }

    void addSides(const DraftPatch& patch) {
        edges_->beginPatch();
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t c = patch.cageCorners[i];
            PatchSide& side = edges_->sides.emplace_back();
            side.edge = topology_.cornerEdges[c];
            side.corner = cornerNumber(c);
            side.creased = triangles_.isEndless(c);
            side.borders = triangles_.isSemiSharp(c) ? Borders::sharpHalves
                           : isWhole(patch, i)       ? Borders::splines
                                                     : Borders::splineHalves;
            side.kind = edgeKind(patch.info.patchClass);
        }
    }
    [[nodiscard]] static uint32_t edgeKind(PatchClass patchClass) {
        return patchClass == PatchClass::loopRegular     ? shared::kTriangleEdges
               : patchClass == PatchClass::loopIrregular ? shared::kIrregularTriangleEdges
                                                         : shared::kSharpTriangleEdges;
    }
    /// PatchSide::corner. Triangles between creases have normals of their own. A plain vertex stores none: it is named
    /// by its limit point and by the side of its crease.
    [[nodiscard]] uint32_t cornerNumber(uint32_t corner) {
        const uint32_t v = cage_.faceVertices[corner],
                       sector = topology_.cornerSpokes[corner] - topology_.spokeStarts[v];
        if (triangles_.isPlain(v)) {
            return 2 * limits_[v] + (triangles_.isBehindCrease(v, sector) ? 1 : 0);
        }
        const ChainTables::Corner own = chains_.cornerOf(v, sector);
        return 2 * (own.chain - own.normal);
    }
    /// What follows of an irregular one.
    void writeIrregular(const DraftPatch& patch, const TriangleNet& net) {
        std::array<uint32_t, 4> chains{}, netLists{}, normals{};
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t c = patch.cageCorners[i], v = cage_.faceVertices[c];
            const ChainTables::Corner corner =
                chains_.cornerOf(v, topology_.cornerSpokes[c] - topology_.spokeStarts[v]);
            chains[i] = corner.chain;
            netLists[i] = corner.netLists;
            normals[i] = corner.normal;
        }
        writer_.put(chains);
        writer_.put(netLists);
        const uint32_t first = chains::firstOfNet(net);
        chains::writeNetList(net, first, shared::kTriangleNetListElements,
                             {shared::kTriangleNetListNormals, normals, firstLevelOne_ + first}, writer_);
        if (patch.info.patchClass == PatchClass::loopIrregularSharp) {
            writer_.put(triangles_.sharpnessOf(patch.cageCorners));
        }
    }

    const cage::Cage& host_;
    const Recipe& recipe_;
    PatchEdges* edges_; ///< null: nobody asks
    const subdivision::Mesh& mesh_;
    const RefinedMesh& parent_;
    const cage::Cage& cage_;
    const cage::Topology& topology_;
    Triangles triangles_;
    uint32_t lastLevel_;
    Tables tables_;
    TableWriter writer_;
    chains::FanTables fans_;
    ChainTables chains_;
    chains::NeededRows vertices_, levelOne_;
    std::vector<TriangleNet> nets_;    ///< of irregular triangles: numbers of points of level 1
    std::vector<uint32_t> netOfPatch_; ///< kNone where it is regular
    uint32_t firstVertex_ = 0, firstLevelOne_ = 0;
    std::vector<uint32_t> limits_;      ///< by vertex: pool indices
    std::vector<uint8_t> firstCorners_; ///< by face
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges) {
    const Result<Isolation> isolation = subdivision::isolateCage(cage, Subdivision::loop);
    if (!isolation) {
        return isolation.error();
    }
    return Builder(cage, *isolation, recipe, edges).build();
}

} // namespace supple::surface::loop
