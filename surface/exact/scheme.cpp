// Exact Catmull-Clark patches as a scheme: the tables of shaders/shared/{surface,exact}.h.
#include "shaders/shared/exact.h"
#include "shaders/shared/subdivision.h"
#include "surface/borders.h"
#include "surface/build.h"
#include "surface/exact/arrangement.h"
#include "surface/exact/corners.h"
#include "surface/exact/fan_tables.h"
#include "surface/exact/smooth_uvs.h"
#include "surface/fans.h"
#include "surface/smooth_uvs.h"
#include "surface/stencil_table.h"
#include "surface/subdivision/mesh.h"
#include "surface/subdivision/pattern.h"

#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <numeric>
#include <string>

namespace supple::surface::exact {
namespace {

using subdivision::Fan;
using subdivision::Isolation;

constexpr uint32_t kRegular = shared::kRegularFan, kOpen = shared::kFewFan;
constexpr KindOfKernel kVertexKernels[] = {
    {Kernel::exactVertex, kRegular, "supple exact vertex, regular"},
    {Kernel::exactVertex, kOpen, "supple exact vertex, creased"},
    {Kernel::exactVertexMeshInPool, kRegular, "supple exact vertex of a step, regular"},
    {Kernel::exactVertexMeshInPool, kOpen, "supple exact vertex of a step, creased"},
};
constexpr KindOfKernel kLimitKernel = {Kernel::exactChain, shared::kMakesLimits, "supple exact limits"};
constexpr KindOfKernel kChainKernel = {Kernel::exactChain, shared::kMakesChains, "supple exact chains"};
constexpr KindOfKernel kFirstLevelKernel = {Kernel::exactChain, shared::kMakesFirstLevel,
                                            "supple exact chains, first level"};
constexpr KindOfKernel kLaterLevelKernel = {Kernel::exactChain, shared::kMakesLevel, "supple exact chains, level"};
constexpr uint32_t kMaxChainPoints = 0xFFFF; ///< 16-bit numbers
constexpr uint32_t kLastChainLevel = 6;      ///< of 64 segments along an edge

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

class Builder {
public:
    Builder(const cage::Cage& host, const Isolation& isolation, const Recipe& recipe)
        : host_(host), recipe_(recipe), mesh_(isolation.mesh), parent_(isolation.parent), cage_(parent_.cage),
          topology_(parent_.topology), corners_(isolation.parent), points_(isolation.parent),
          rate_(patchRate(recipe.rate)), lastLevel_(lastLevelFor(rate_)), writer_(tables_.words), fans_(writer_) {}

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
        writeVertices();
        const std::vector<uint32_t> points = ringPoints();
        RingWriter ring(cage_, topology_, points, firstCorners_, writer_);
        writePatches(ring);
        for (const uint32_t r : order_) {
            const Run& run = corners_.runs()[r];
            ring.add(run.vertex, corners_.spokesOf(run), !run.closed);
        }
        tables_.ring = ring.write();
        finishTables(recipe_, cage_, patches_, writer_, tables_);
        if (const Status smooth = writeSmoothUvs(); !smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    /// A sample at 1 / rate or further from a corner lies in a leaf of this level at most. `rate` 0: any rate.
    static uint32_t lastLevelFor(uint32_t rate) {
        return rate == 0 ? kLastChainLevel
                         : std::max(kFirstChainLevel, static_cast<uint32_t>(std::bit_width(rate - 1)));
    }
    /// Quads that a step has made have half of the segments.
    [[nodiscard]] uint32_t patchRate(uint32_t rate) const { return steps() ? (rate + 1) / 2 : rate; }
    [[nodiscard]] bool steps() const { return mesh_.isolationSteps > 1; }
    [[nodiscard]] Fan fanOf(uint32_t v) const {
        return {Subdivision::catmullClark, mesh_.fragments[v].sectors, mesh_.fragments[v].open};
    }
    [[nodiscard]] uint32_t chainPoints(uint32_t v) const { return pointCount(fanOf(v), 3); }
    [[nodiscard]] uint32_t chainLevels(uint32_t v) const {
        return corners_.kind(v) == VertexKind::chain ? lastLevel_ - kFirstChainLevel + 1 : 0;
    }

    Status checkSizes() const {
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            if (corners_.kind(v) == VertexKind::chain && chainPoints(v) > kMaxChainPoints) {
                return Error{ErrorCode::limit, "vertex " + std::to_string(v) + " has " +
                                                   std::to_string(mesh_.fragments[v].sectors) +
                                                   " faces: more than chains of leaves count"};
            }
        }
        SpokeLimits spokes;
        for (const Run& run : corners_.runs()) {
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
        levelOne_.assign(mesh_.stencils.back().rows(), cage::kNone);
        const auto need = [&](uint32_t point) {
            if (levelOne_[point] == cage::kNone) {
                levelOne_[point] = static_cast<uint32_t>(needed_.size());
                needed_.push_back(point);
            }
        };
        for (const DraftPatch& patch : patches_) {
            if (patch.info.patchClass == PatchClass::regular) {
                continue;
            }
            const QuadNet& net = nets_.emplace_back(corners_.netOf(patch.facet, firstCorners_[patch.facet], points_));
            std::for_each(net.begin(), net.end(), need);
        }
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            for (uint32_t i = 0; i < netSize(v); ++i) {
                need(mesh_.net[mesh_.fragments[v].firstNet + i]);
            }
        }
    }
    /// Points of level 1 round a vertex that is not plain: up to radius 2 for its chain, else for its limit alone.
    [[nodiscard]] uint32_t netSize(uint32_t v) const {
        switch (corners_.kind(v)) {
        case VertexKind::chain:
            return pointCount(fanOf(v), 2);
        case VertexKind::tensor:
            return pointCount(fanOf(v), 1);
        default:
            return 0;
        }
    }

    /// Runs: closed ones first. Slots lie in this order.
    void layOutPool() {
        const std::vector<Run>& runs = corners_.runs();
        order_.resize(runs.size());
        std::iota(order_.begin(), order_.end(), 0u);
        std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
            return std::tuple(!runs[a].closed, runs[a].faces) < std::tuple(!runs[b].closed, runs[b].faces);
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
        uint32_t next = firstLevelOne_ + static_cast<uint32_t>(needed_.size());
        normals_.assign(cage_.vertexCount(), cage::kNone);
        chains_.assign(cage_.vertexCount(), 0);
        vertexArrangements_.assign(cage_.vertexCount(), nullptr);
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            if (corners_.kind(v) != VertexKind::plain) {
                vertexArrangements_[v] = &arrangementOf(v);
                normals_[v] = next;
                next += vertexArrangements_[v]->runs;
            }
        }
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            if (chainLevels(v) > 0) {
                chains_[v] = next + 1; // behind the point that it is relative to
                next += 1 + chainLevels(v) * chainPoints(v);
            }
        }
        tables_.inner = steps() ? next : 0; // the mesh
        tables_.poolStride = poolStrideFor(next + (steps() ? cage_.vertexCount() : 0));
    }

    struct ArrangementTable {
        uint32_t element = 0, runs = 0;
        std::vector<uint32_t> runOfSector;
    };
    /// Written when it is asked for first.
    const ArrangementTable& arrangementOf(uint32_t v) {
        const subdivision::Fragment& fragment = mesh_.fragments[v];
        const auto spokes = mesh_.spokeSharpness.begin() + fragment.firstSpoke;
        const Arrangement key{fanOf(v), {spokes, spokes + fragment.spokes()}, fragment.centreSharpness};
        const auto [known, isNew] = arrangements_.try_emplace(key);
        if (isNew) {
            known->second = writeArrangement(key);
        }
        return known->second;
    }
    ArrangementTable writeArrangement(const Arrangement& key) {
        const bool sharp = std::any_of(key.spokes.begin(), key.spokes.end(), [](float s) { return s > 0.0f; });
        uint32_t words = shared::kNoSharpness;
        if (sharp) {
            words = 4 * writer_.element();
            for (const float sharpness : key.spokes) {
                writer_.put({std::bit_cast<uint32_t>(sharpness)});
            }
        }
        const uint32_t steps = writer_.element();
        for (uint32_t level = 0; level + kFirstChainLevel <= lastLevel_; ++level) {
            const CentreStep step = centreStep(softened(key.spokes, level), softened(key.vertex, level));
            writer_.put({floatBits(step.smooth), floatBits(step.crease), step.first, step.second});
        }
        const Limit limit = limitOf(key);
        const auto ring = static_cast<uint32_t>(limit.position.size()) - 1;
        ArrangementTable table{writer_.element(), static_cast<uint32_t>(limit.runs.size()),
                               std::vector<uint32_t>(key.fan.sectors, 0)};
        writer_.put({table.runs, words, steps, ring});
        for (uint32_t r = 0; r < table.runs; ++r) {
            const LimitRun& run = limit.runs[r];
            writeRun(limit.position, run);
            for (uint32_t h = 0; h < run.sectors; ++h) {
                table.runOfSector[(run.firstSector + h) % key.fan.sectors] = r;
            }
        }
        return table;
    }

    void writeRun(const subdivision::CentreMask& position, const LimitRun& run) {
        std::vector<const subdivision::CentreMask*> masks{&position};
        for (const subdivision::CentreMask& tangent : run.tangents) {
            masks.push_back(&tangent);
        }
        const auto blocks = static_cast<uint32_t>((masks.size() + 3) / 4);
        writer_.put({blocks, 0u, 0u, 0u});
        for (uint32_t block = 0; block < blocks; ++block) {
            for (size_t i = 1; i < position.size(); ++i) {
                for (size_t k = size_t{4} * block; k < size_t{4} * block + 4; ++k) {
                    writer_.putFloats({k < masks.size() ? (*masks[k])[i] : 0.0});
                }
            }
        }
    }

    [[nodiscard]] Stage meshStage() const { return steps() ? Stage::assemble : Stage::vertex; }

    /// The vertices of the mesh if it is not the cage, plain vertices, points of level 1.
    void writeFans() {
        if (steps()) {
            writeStencils(mesh_.stencils[0], {Stage::vertex, false, 0, tables_.inner}, writer_, tables_);
        }
        std::array<uint32_t, 3> weights{};
        for (uint32_t faces = 1; faces <= 2; ++faces) {
            weights[faces] = writeFanWeights(openWeights(faces), 0, writer_);
        }
        for (const bool closed : {true, false}) {
            Construction vertices{
                meshStage(), kVertexKernels[(closed ? 0 : 1) + (steps() ? 2 : 0)], {writer_.element(), 0}, 0};
            for (const uint32_t r : order_) {
                const Run& run = corners_.runs()[r];
                if (run.closed != closed) {
                    continue;
                }
                ++vertices.section.count;
                vertices.coefficients += 1 + run.spokes() + run.faces;
                if (!closed) {
                    writer_.put({runSlots_[r], weights[run.faces], runPoints_[r]});
                }
            }
            if (vertices.section.count > 0) {
                tables_.constructions.push_back(vertices);
            }
        }
        writeStencils(rowsOf(mesh_.stencils.back(), needed_),
                      {meshStage(), steps(), steps() ? tables_.inner : 0, firstLevelOne_}, writer_, tables_);
    }
    static Stencils rowsOf(const Stencils& all, const std::vector<uint32_t>& rows) {
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

    /// Those that are not plain, by the size of their fans, so that neighbouring lanes loop equally long.
    void writeVertices() {
        std::vector<uint32_t> vertices, nets;
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            if (corners_.kind(v) != VertexKind::plain) {
                vertices.push_back(v);
            }
        }
        std::stable_sort(vertices.begin(), vertices.end(), [&](uint32_t a, uint32_t b) {
            return std::pair(chainLevels(a), fanOf(a)) < std::pair(chainLevels(b), fanOf(b));
        });
        for (const uint32_t v : vertices) {
            nets.push_back(4 * writer_.element());
            for (uint32_t i = 0; i < netSize(v); ++i) {
                writer_.put({firstLevelOne_ + levelOne_[mesh_.net[mesh_.fragments[v].firstNet + i]]});
            }
            (void)fans_.of(fanOf(v));
        }
        uint32_t limits = 0; // coefficients
        const uint32_t first = writer_.element();
        for (size_t i = 0; i < vertices.size(); ++i) {
            const uint32_t v = vertices[i];
            const ArrangementTable& arrangement = *vertexArrangements_[v];
            const uint32_t levels = chainLevels(v);
            writer_.put({nets[i], fans_.of(fanOf(v)).element, arrangement.element, v, chains_[v], normals_[v], 0u, 0u});
            limits += 1 + arrangement.runs + (levels > 0 ? 1 : 0);
        }
        if (vertices.empty()) {
            return;
        }
        const auto count = static_cast<uint32_t>(vertices.size());
        tables_.constructions.push_back({Stage::assemble, kLimitKernel, {first, count}, limits, steps()});
        writeChains(vertices, first);
        for (uint32_t level = kFirstChainLevel; level <= lastLevel_; ++level) {
            writeLevel(vertices, first, level);
        }
    }

    /// Whether a block makes all levels of the vertex's chain, in workgroup memory. On CPU devices barriers within a
    /// workgroup cost more than dispatches.
    [[nodiscard]] bool fitsInBlock(uint32_t v) const {
        return recipe_.wide && chainPoints(v) <= shared::kBlockPoints &&
               mesh_.fragments[v].spokes() < shared::kBlockLanes;
    }
    /// Blocks of kBlockLanes lanes: whole chains of one fan each. Vertices follow each other by fans.
    void writeChains(const std::vector<uint32_t>& vertices, uint32_t firstRecord) {
        Construction work{Stage::assemble, kChainKernel, {writer_.element(), 0}, 0};
        for (size_t i = 0; i < vertices.size();) {
            const uint32_t v = vertices[i];
            if (chainLevels(v) == 0 || !fitsInBlock(v)) {
                ++i;
                continue;
            }
            const size_t most = std::min(shared::kBlockPoints / chainPoints(v),
                                         shared::kBlockLanes / (mesh_.fragments[v].spokes() + 1));
            uint32_t count = 1;
            while (count < most && i + count < vertices.size() && chainLevels(vertices[i + count]) > 0 &&
                   fanOf(vertices[i + count]) == fanOf(v)) {
                ++count;
            }
            writer_.put({fans_.of(fanOf(v)).element, firstRecord + 2 * static_cast<uint32_t>(i), count, lastLevel_});
            work.section.count += shared::kBlockLanes;
            work.coefficients += count * chainPoints(v) * chainLevels(v);
            i += count;
        }
        if (work.section.count > 0) {
            tables_.constructions.push_back(work);
        }
    }

    /// One level of the other chains: blocks of kBlockLanes lanes, of each fan's.
    void writeLevel(const std::vector<uint32_t>& vertices, uint32_t firstRecord, uint32_t level) {
        const bool isFirst = level == kFirstChainLevel;
        Construction work{Stage::assemble, isFirst ? kFirstLevelKernel : kLaterLevelKernel, {writer_.element(), 0}, 0};
        work.readsPool = !isFirst;
        const auto add = [&](uint32_t fan, uint32_t record, uint32_t count, uint32_t items) {
            for (uint32_t item = 0; item < items; item += shared::kBlockLanes) {
                writer_.put({fan, record, count | level << shared::kChainLevelShift, item});
                work.section.count += shared::kBlockLanes;
            }
        };
        for (size_t i = 0; i < vertices.size();) {
            size_t end = i;
            while (end < vertices.size() && fanOf(vertices[end]) == fanOf(vertices[i]) &&
                   chainLevels(vertices[end]) == chainLevels(vertices[i])) {
                ++end;
            }
            if (chainLevels(vertices[i]) > 0 && !fitsInBlock(vertices[i])) {
                const auto count = static_cast<uint32_t>(end - i);
                add(fans_.of(fanOf(vertices[i])).element, firstRecord + 2 * static_cast<uint32_t>(i), count,
                    count * (mesh_.fragments[vertices[i]].spokes() + 1));
                work.coefficients += count * chainPoints(vertices[i]);
            }
            i = end;
        }
        if (work.section.count > 0) {
            tables_.constructions.push_back(work);
        }
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
        size_t net = 0;
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            countPatch(patch.info.patchClass, p, writer_, tables_);
            ring.setRecord(patch.facet, writer_.element());
            std::array<uint32_t, 4> points{}, spokes{};
            for (uint32_t i = 0; i < 4; ++i) {
                const uint32_t c = patch.cageCorners[i], spoke = topology_.cornerSpokes[c];
                points[i] = limitPoint(c);
                const auto [slot, next] = slots_[spoke];
                spokes[i] = slot == cage::kNone ? chains_[cage_.faceVertices[c]] : spokeWord(slot, next);
            }
            writer_.put(points);
            writer_.put(spokes);
            if (patch.info.patchClass != PatchClass::regular) {
                writeIrregular(patch, nets_[net++]);
            }
        }
    }

    void writeIrregular(const DraftPatch& patch, const QuadNet& net) {
        std::array<uint32_t, 4> windows{}, sizes{}, sharpness{}, normals{};
        uint32_t flags = 0;
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i], v = cage_.faceVertices[c];
            const uint32_t end = cage_.faceVertices[patch.cageCorners[(i + 1) % 4]];
            const uint32_t sector = topology_.cornerSpokes[c] - topology_.spokeStarts[v];
            sharpness[i] = std::bit_cast<uint32_t>(sideSharpness(c));
            normals[i] = shared::kNoNormal;
            if (corners_.kind(v) != VertexKind::plain) {
                normals[i] = normals_[v] + vertexArrangements_[v]->runOfSector[sector];
            }
            if (chainLevels(v) > 0) {
                windows[i] = fans_.of(fanOf(v)).windows + shared::kWindowElements * sector;
                sizes[i] = chainPoints(v) | lastLevel_ << shared::kChainLevelShift;
            }
            const bool cubic = corners_.kind(v) == VertexKind::plain && corners_.kind(end) == VertexKind::plain;
            flags |= cubic ? 1u << (shared::kCubicSide + i) : 0u;
        }
        for (const auto& words : {windows, sizes, sharpness, normals}) {
            writer_.put(words);
        }
        writer_.put({flags});
        for (const uint32_t point : net) {
            writer_.put({firstLevelOne_ + levelOne_[point]});
        }
        (void)writer_.element();
    }

    Status writeSmoothUvs() {
        const std::vector<const std::vector<glm::vec2>*> uvs = uvSetsOf(host_);
        if (recipe_.uvMode == cage::UvMode::all || !recipe_.attributes || uvs.empty()) {
            return success();
        }
        std::vector<std::string> notes; // known
        const Result<RefinedMesh> begin = subdivision::beginSteps(host_, Subdivision::catmullClark, notes);
        if (!begin) {
            return begin.error();
        }
        std::vector<std::unique_ptr<UvQuads>> sets;
        for (const std::vector<glm::vec2>* set : uvSetsOf(begin->cage)) {
            Result<ChannelLevel> level = channelOfQuads(*begin, *set, recipe_.uvMode, steps());
            if (!level) {
                return level.error();
            }
            sets.push_back(std::make_unique<UvQuads>(std::move(*level), lastLevel_));
            sets.back()->addFans(fans_);
            sets.back()->writePoints(writer_);
        }
        tables_.uvMode = recipe_.uvMode;
        tables_.uvQuads = true;
        for (PatchRange& range : tables_.ranges) {
            range.smoothUvs = writer_.element();
            for (uint32_t p = range.firstPatch; p < range.firstPatch + range.section.count; ++p) {
                for (const std::unique_ptr<UvQuads>& set : sets) {
                    set->writePatch(patches_[p], fans_, writer_);
                }
            }
        }
        return success();
    }

    const cage::Cage& host_;
    const Recipe& recipe_;
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
    std::vector<DraftPatch> patches_;
    std::vector<QuadNet> nets_; ///< of irregular quads, in the order of patches
    std::vector<uint32_t> levelOne_, needed_;
    uint32_t firstLevelOne_ = 0;
    std::vector<uint32_t> order_;                ///< runs as slots have them
    std::vector<uint32_t> runPoints_, runSlots_; ///< by run
    /// By spoke of the topology: the slots of the two edges of the sector behind it.
    std::vector<std::array<uint32_t, 2>> slots_;
    std::vector<uint32_t> normals_, chains_; ///< by vertex: pool indices; kNone and 0 where there are none
    std::map<Arrangement, ArrangementTable> arrangements_;
    std::vector<const ArrangementTable*> vertexArrangements_; ///< by vertex; null where it is plain
    std::vector<uint8_t> firstCorners_;                       ///< by face
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage) {
    const Result<Isolation> isolation = subdivision::isolateCage(cage, Subdivision::catmullClark);
    if (!isolation) {
        return isolation.error();
    }
    return Builder(cage, *isolation, recipe).build();
}

} // namespace supple::surface::exact
