// Exact Catmull-Clark patches as a scheme: the tables of shaders/shared/{surface,chains}.h.
#include "shaders/shared/chains.h"
#include "shaders/shared/subdivision.h"
#include "surface/build.h"
#include "surface/chains/chain_tables.h"
#include "surface/chains/corners.h"
#include "surface/chains/fan_points.h"
#include "surface/chains/kernels.h"
#include "surface/chains/needed_rows.h"
#include "surface/chains/net_lists.h"
#include "surface/chains/smooth_uvs.h"
#include "surface/fans.h"
#include "surface/patch_records.h"
#include "surface/stencil_table.h"
#include "surface/subdivision/mesh.h"
#include "surface/subdivision/pattern.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

namespace supple::surface::catmull_clark {
namespace {

using namespace chains;
using subdivision::Isolation;

/// The weights of a run of one or two faces between sharp edges: uniform B-splines whose border is the crease.
FanWeights openWeights(uint32_t facets) {
    FanWeights w;
    w.limitFace = w.e1Face = w.e2Face = std::vector<double>(facets, 0.0);
    w.limitEdge = w.e1Edge = w.e2Edge = w.cosines = w.sines = std::vector<double>(facets + 1, 0.0);
    if (facets == 2) {
        w.limitEdge = {1.0 / 6.0, 0.0, 1.0 / 6.0};
        w.e1Edge = {-1.0 / 18.0, 4.0 / 18.0, -1.0 / 18.0};
        w.e1Face = {1.0 / 18.0, 1.0 / 18.0};
        w.cosines[1] = 1.0;
    }
    return w;
}

/// How often points of level 1 are numbered anew, because some must be there several times, before no fan makes any.
constexpr uint32_t kMostRounds = 3;

class Builder {
public:
    Builder(const cage::Cage& host, const Isolation& isolation, const Recipe& recipe, PatchEdges* edges)
        : host_(host), recipe_(recipe), edges_(edges), mesh_(isolation.mesh), parent_(isolation.parent),
          cage_(parent_.cage), topology_(parent_.topology), corners_(isolation.parent), points_(isolation.parent),
          rate_(patchRate(recipe.rate)), lastLevel_(lastChainLevel(rate_)), writer_(tables_.words),
          fans_(lastLevel_, writer_),
          chains_({&mesh_, lastLevel_, recipe.wide, recipe.lod}, vertexContents(), fans_, writer_),
          levelOne_(mesh_.stencils.back().rows()) {}

    Result<Tables> build() {
        const Status fits = checkSizes();
        if (!fits) {
            return fits.error();
        }
        tables_.notes = mesh_.notes;
        tables_.isolationSteps = mesh_.isolationSteps - 1;
        tables_.rate = rate_;
        for (uint32_t f = 0; f < cage_.faceCount(); ++f) {
            firstCorners_.push_back(corners_.firstCorner(f));
        }
        patches_ =
            draftPatches({cage_, mesh_.hostVertices, parent_.sourceFaces, firstCorners_}, [&](DraftPatch& patch) {
                patch.kind = corners_.chainsOf(patch.facet);
                return classOf(patch);
            });
        findLevelOnePoints();
        layOutPool();
        writeFans();
        chains_.write({firstLevelOne_, [](uint32_t vertex) { return vertex; }, steps()}, tables_);
        const std::vector<uint32_t> points = ringPoints();
        RingWriter ring(cage_, topology_, points, firstCorners_, writer_);
        writePatches(ring);
        for (const uint32_t r : order_) {
            const FanRun& run = corners_.runs()[r];
            ring.add(run.vertex, corners_.spokesOf(run), !run.closed);
        }
        tables_.ring = ring.write();
        finishTables(recipe_, cage_, patches_, writer_, tables_, edges_);
        if (const Status smooth = writeUvLeaves(recipe_, host_, {Subdivision::catmullClark, steps(), lastLevel_},
                                                patches_, fans_, writer_, tables_);
            !smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    /// Quads that a step has made have half of the segments.
    [[nodiscard]] uint32_t patchRate(uint32_t rate) const { return steps() ? (rate + 1) / 2 : rate; }
    [[nodiscard]] bool steps() const { return mesh_.isolationSteps > 1; }
    [[nodiscard]] std::vector<VertexContent> vertexContents() const {
        std::vector<VertexContent> contents;
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            const VertexKind kind = corners_.kind(v);
            contents.push_back(kind == VertexKind::plain    ? VertexContent::nothing
                               : kind == VertexKind::tensor ? VertexContent::limit
                                                            : VertexContent::chain);
        }
        return contents;
    }

    Status checkSizes() const {
        if (const Status fits = chains_.checkSizes(); !fits) {
            return fits;
        }
        SpokeLimits spokes;
        for (const FanRun& run : corners_.runs()) {
            spokes.add(run.vertex, run.spokes());
        }
        return spokes.check();
    }

    [[nodiscard]] PatchClass classOf(const DraftPatch& patch) const {
        bool plain = true, chains = false, sharp = false;
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i];
            const VertexKind kind = corners_.kind(cage_.faceVertices[c]);
            plain = plain && kind == VertexKind::plain;
            chains = chains || kind == VertexKind::chain;
            sharp = sharp || sideSharpness(c) > 0.0f;
        }
        return plain     ? PatchClass::regular
               : !chains ? PatchClass::creased
               : sharp   ? PatchClass::irregularSharp
                         : PatchClass::irregular;
    }

    /// The sharpness of the edge behind a corner, on level 1.
    [[nodiscard]] float sideSharpness(uint32_t corner) const {
        return softened(parent_.edgeSharpness[topology_.cornerEdges[corner]], 1);
    }

    /// What an irregular quad's leaves of level 1 and the nets of chains are made of.
    void findLevelOnePoints() {
        netOfPatch_.assign(patches_.size(), cage::kNone);
        for (const uint32_t p : patchesByNeighbours(patches_, cage_, topology_)) {
            const uint32_t facet = patches_[p].facet;
            if (patches_[p].info.patchClass != PatchClass::regular) {
                netOfPatch_[p] = static_cast<uint32_t>(nets_.size());
                nets_.push_back(corners_.netOf(facet, firstCorners_[facet], points_));
            }
        }
        const std::vector<QuadNet> nets = nets_;
        std::vector<uint8_t> isByFan(mesh_.stencils.back().rows(), 0);
        for (const QuadNet& net : nets) {
            markAll(net, isByFan, 1);
        }
        markAll(chains_.findNets(), isByFan, 1);
        numberLevelOnePoints(isByFan);
        // All points that are there several times must have the same bits, so rows of weights make them.
        for (uint32_t round = 0; isAnyMarked(levelOne_.repeated(), isByFan); ++round) {
            markAll(levelOne_.repeated(), isByFan, 0);
            if (round == kMostRounds) {
                isByFan.assign(isByFan.size(), 0);
            }
            nets_ = nets;
            chains_.findNets();
            numberLevelOnePoints(isByFan);
        }
    }
    void numberLevelOnePoints(std::span<const uint8_t> isByFan) {
        fanPoints_.emplace(parent_, corners_, isByFan);
        levelOne_ = NeededRows(static_cast<uint32_t>(isByFan.size()));
        levelOne_.group(fanPoints_->groups());
        for (QuadNet& net : nets_) {
            levelOne_.needNet(net);
        }
        chains_.numberNets(levelOne_);
    }
    static void markAll(std::span<const uint32_t> rows, std::vector<uint8_t>& marks, uint8_t mark) {
        for (const uint32_t row : rows) {
            marks[row] = mark;
        }
    }
    static bool isAnyMarked(std::span<const uint32_t> rows, std::span<const uint8_t> marks) {
        return std::any_of(rows.begin(), rows.end(), [&](uint32_t row) { return marks[row] != 0; });
    }

    /// The kernel for a run.
    [[nodiscard]] uint32_t fanKind(uint32_t run) const {
        if (!corners_.runs()[run].closed) {
            return shared::kFewFan;
        }
        return fanPoints_->groupOfRun(run) == cage::kNone ? shared::kRegularFan : shared::kPointsFan;
    }
    /// Runs: closed ones first, and of them those that make points of level 1. Slots lie in this order.
    void layOutPool() {
        const std::vector<FanRun>& runs = corners_.runs();
        order_.resize(runs.size());
        std::iota(order_.begin(), order_.end(), 0u);
        std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
            const auto place = [&](uint32_t run) {
                return std::tuple(!runs[run].closed, fanKind(run) == shared::kRegularFan, runs[run].faces);
            };
            return place(a) < place(b);
        });
        slots_.assign(topology_.spokeVertices.size(), {cage::kNone, cage::kNone});
        uint32_t slot = 0, point = cage_.vertexCount();
        runPoints_.resize(runs.size());
        runSlots_.resize(runs.size());
        for (const uint32_t r : order_) {
            runSlots_[r] = slot;
            const std::vector<uint32_t> spokes = corners_.spokesOf(runs[r]);
            for (uint32_t k = 0; k < runs[r].faces; ++k) {
                slots_[spokes[k]] = {slot + k, slot + (k + 1) % static_cast<uint32_t>(spokes.size())};
            }
            slot += static_cast<uint32_t>(spokes.size());
        }
        for (uint32_t r = 0; r < runs.size(); ++r) {
            const bool first = r == 0 || runs[r - 1].vertex != runs[r].vertex;
            runPoints_[r] = first ? runs[r].vertex : point++;
        }
        tables_.tangents = point;
        tables_.faces = tables_.tangents + slot;
        firstLevelOne_ = tables_.faces + slot;
        const uint32_t next = chains_.layOut(firstLevelOne_ + levelOne_.count());
        tables_.meshVertices = steps() ? next : 0; // the mesh
        tables_.poolStride = poolStrideFor(next + (steps() ? cage_.vertexCount() : 0));
    }

    [[nodiscard]] Stage meshStage() const { return steps() ? Stage::assemble : Stage::vertex; }

    /// The vertices of the mesh if it is not the cage, plain vertices, points of level 1.
    void writeFans() {
        if (steps()) {
            writeStencils(mesh_.stencils[0], {Stage::vertex, false, 0, tables_.meshVertices}, writer_, tables_);
        }
        std::array<uint32_t, 3> weights{};
        for (uint32_t faces = 1; faces <= 2; ++faces) {
            weights[faces] = writeFanWeights(openWeights(faces), 0, writer_);
        }
        uint32_t withPoints = 0;
        for (const uint32_t kind : {shared::kPointsFan, shared::kRegularFan, shared::kFewFan}) {
            Construction vertices{meshStage(), plainVertexKernel(kind, steps()), {writer_.element(), 0}, 0};
            vertices.from = kind == shared::kRegularFan ? withPoints : 0;
            for (const uint32_t r : order_) {
                if (fanKind(r) != kind) {
                    continue;
                }
                const FanRun& run = corners_.runs()[r];
                ++vertices.section.count;
                vertices.coefficients += 1 + run.spokes() + run.faces;
                if (kind == shared::kFewFan) {
                    writer_.put({runSlots_[r], weights[run.faces], runPoints_[r]});
                } else if (kind == shared::kPointsFan) {
                    const uint32_t group = fanPoints_->groupOfRun(r), points = fanPoints_->bitsOf(group);
                    writer_.put({firstLevelOne_ + levelOne_.firstOfGroup(group), points});
                    vertices.coefficients += static_cast<uint32_t>(std::popcount(points));
                    ++withPoints;
                }
            }
            if (vertices.section.count > 0) {
                tables_.constructions.push_back(vertices);
            }
        }
        writeOtherPoints();
    }

    /// Points of level 1 that no fan makes.
    void writeOtherPoints() {
        const std::vector<uint32_t>& numbers = levelOne_.alone();
        std::vector<uint32_t> rows;
        for (const uint32_t number : numbers) {
            rows.push_back(levelOne_.rows()[number]);
        }
        writeStencils(rowsOf(mesh_.stencils.back(), rows),
                      {meshStage(), steps(), steps() ? tables_.meshVertices : 0, firstLevelOne_, numbers}, writer_,
                      tables_);
    }

    [[nodiscard]] ChainTables::Corner cornerOf(uint32_t c) {
        const uint32_t v = cage_.faceVertices[c];
        return chains_.cornerOf(v, topology_.cornerSpokes[c] - topology_.spokeStarts[v]);
    }
    [[nodiscard]] uint32_t limitPoint(uint32_t c) const {
        const uint32_t run = corners_.runOf(topology_.cornerSpokes[c]);
        return run == cage::kNone ? cage_.faceVertices[c] : runPoints_[run];
    }
    /// By corner of the mesh; cage::kNone where the limit point's number is not that of the vertex (RingWriter).
    [[nodiscard]] std::vector<uint32_t> ringPoints() const {
        std::vector<uint32_t> points;
        for (uint32_t c = 0; c < cage_.cornerCount(); ++c) {
            points.push_back(limitPoint(c) == cage_.faceVertices[c] ? limitPoint(c) : cage::kNone);
        }
        return points;
    }

    void writePatches(RingWriter& ring) {
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            countPatch(patch.info.patchClass, p, writer_, tables_);
            ring.setRecord(patch.facet, writer_.element());
            std::array<uint32_t, 4> points{}, spokes{};
            for (uint32_t i = 0; i < 4; ++i) {
                const uint32_t c = patch.cageCorners[i], spoke = topology_.cornerSpokes[c];
                points[i] = limitPoint(c);
                const auto [slot, next] = slots_[spoke];
                spokes[i] = slot == cage::kNone ? cornerOf(c).chain : spokeWord(slot, next);
            }
            writer_.put(points);
            writer_.put(spokes);
            if (patch.info.patchClass != PatchClass::regular) {
                writeIrregular(patch, nets_[netOfPatch_[p]]);
            }
            if (edges_ != nullptr) {
                addSides(patch, points);
            }
        }
    }

    /// `points`: the limit points of its corners.
    void addSides(const DraftPatch& patch, const std::array<uint32_t, 4>& points) {
        const bool isRegular = patch.info.patchClass == PatchClass::regular;
        NetCorners corners{points, {}, {}};
        for (uint32_t i = 0; i < 4; ++i) { // corners that are not plain have no slots, and no cubic begins there
            const auto [slot, next] = slots_[topology_.cornerSpokes[patch.cageCorners[i]]];
            corners.spokes[i] = slot;
            corners.nextSpokes[i] = next;
        }
        const NetIndices net(corners, tables_.tangents, tables_.faces, false);
        edges_->beginPatch();
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i];
            const ChainTables::Corner corner = cornerOf(c);
            PatchSide& side = edges_->sides.emplace_back();
            // Where there is no normal, the faces between two creases have a limit point of their own.
            side.corner = corner.normal == 0 ? points[i] : corner.chain - corner.normal;
            side.creased = sideSharpness(c) >= kInfiniteSharpness;
            side.borders = isCubic(patch, i) ? Borders::cubics : Borders::halves;
            side.edge = edgeNumber(topology_, c, !side.creased || side.borders == Borders::halves);
            if (side.borders == Borders::cubics) {
                side.curve = net.curve(i);
            }
            if (isRegular) {
                side.across = net.inside(i);
            } else {
                side.kind = shared::kHalvesEdges;
            }
        }
    }

    /// Whether both ends of a side are plain: then it is a cubic.
    [[nodiscard]] bool isCubic(const DraftPatch& patch, uint32_t side) const {
        const auto plain = [&](uint32_t i) {
            return corners_.kind(cage_.faceVertices[patch.cageCorners[i % 4]]) == VertexKind::plain;
        };
        return plain(side) && plain(side + 1);
    }

    void writeIrregular(const DraftPatch& patch, const QuadNet& net) {
        std::array<uint32_t, 4> netLists{}, sharpness{}, normals{};
        uint32_t flags = 0;
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i];
            const ChainTables::Corner corner = cornerOf(c);
            sharpness[i] = std::bit_cast<uint32_t>(sideSharpness(c));
            normals[i] = corner.normal;
            netLists[i] = corner.netLists;
            flags |= isCubic(patch, i) ? 1u << (shared::kCubicSide + i) : 0u;
        }
        writer_.put(netLists);
        const uint32_t first = firstOfNet(net);
        flags |= (firstLevelOne_ + first) << shared::kNetFirstShift;
        const bool sharp = patch.info.patchClass != PatchClass::irregular;
        writeNetList(net, first, shared::kNetListElements, {shared::kNetListNormals, normals, flags, sharp}, writer_);
        if (sharp) {
            writer_.put(sharpness);
        }
    }

    const cage::Cage& host_;
    const Recipe& recipe_;
    PatchEdges* edges_; ///< null: nobody asks
    const subdivision::Mesh& mesh_;
    const RefinedMesh& parent_;
    const cage::Cage& cage_;
    const cage::Topology& topology_;
    Corners corners_;
    StepPoints points_;
    uint32_t rate_;
    uint32_t lastLevel_;
    Tables tables_;
    TableWriter writer_;
    FanTables fans_;
    ChainTables chains_;
    std::vector<DraftPatch> patches_;
    std::vector<QuadNet> nets_;        ///< of irregular quads: numbers of points of level 1
    std::vector<uint32_t> netOfPatch_; ///< kNone where it is regular
    std::optional<FanPoints> fanPoints_;
    NeededRows levelOne_;
    uint32_t firstLevelOne_ = 0;
    std::vector<uint32_t> order_;                ///< runs as slots have them
    std::vector<uint32_t> runPoints_, runSlots_; ///< by run
    /// By spoke of the topology: the slots of the two edges of the sector behind it.
    std::vector<std::array<uint32_t, 2>> slots_;
    std::vector<uint8_t> firstCorners_; ///< by face
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges) {
    const Result<Isolation> isolation = subdivision::isolateCage(cage, Subdivision::catmullClark);
    if (!isolation) {
        return isolation.error();
    }
    return Builder(cage, *isolation, recipe, edges).build();
}

} // namespace supple::surface::catmull_clark
