// The blending surface as a scheme: the tables of shaders/shared/{surface,blend}.h.
#include "shaders/shared/blend.h"
#include "surface/blend/kernels.h"
#include "surface/blend/smooth_uvs.h"
#include "surface/blend/weights.h"
#include "surface/build.h"
#include "surface/smooth_uvs.h"
#include "surface/stencil_table.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace supple::surface::blend {

namespace {

static_assert(kCoefficients == shared::kChartCoefficients);

/// Where the tables of one k lie.
struct TurnTables {
    std::vector<glm::dvec2> spokes; ///< the directions of a chart's spokes, the first once more at the end
    uint32_t directions = 0, samples = 0;
    uint32_t creaseSamples = 0; ///< 0 where no chart needs them
};

class Builder {
public:
    /// `rate`: segments along a patch edge; 0: tables for samples at any parameters.
    Builder(const Mesh& mesh, const cage::Cage& cage, const Recipe& recipe, uint32_t rate, PatchEdges* edges)
        : mesh_(mesh), host_(cage), recipe_(recipe), rate_(rate), edges_(edges), writer_(tables_.words) {}

    Result<Tables> build() {
        tables_.rate = rate_;
        tables_.isolationSteps = mesh_.refined ? 1 : 0;
        tables_.notes = mesh_.notes;
        patches_ = draftPatches({mesh_.cage, mesh_.hostVertices, mesh_.sourceFaces},
                                [&](const DraftPatch& patch) { return classOf(patch); });
        firstChart_ = mesh_.refined ? mesh_.cage.vertexCount() : 0;
        tables_.poolStride = poolStrideFor(poolIndex(static_cast<uint32_t>(mesh_.charts.size())));
        if (mesh_.refined) {
            writeStencils(mesh_.stencils, {}, writer_, tables_);
        }
        writeCharts();
        if (rate_ > 0) {
            writeCoordinates();
        }
        for (const ChartClass& chartClass : mesh_.classes) {
            writeTurns(chartClass);
        }
        writePatches();
        finishTables(recipe_, mesh_.cage, patches_, writer_, tables_, edges_);
        const Status smooth = writeUvs();
        if (!smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    /// Whether a corner or the edge from it to the next has no derivative.
    [[nodiscard]] bool stillCorner(uint32_t corner) const {
        const ChartKind kind = mesh_.classOf(mesh_.corners[corner].chart).kind;
        return kind == ChartKind::point || kind == ChartKind::curve;
    }

    [[nodiscard]] PatchClass classOf(const DraftPatch& patch) const {
        const bool sharp = std::any_of(patch.cageCorners.begin(), patch.cageCorners.begin() + 4, [&](uint32_t c) {
            return mesh_.classOf(mesh_.corners[c].chart).creased() || stillCorner(c) || flatAcross(mesh_, c);
        });
        const bool regular = std::all_of(patch.cageCorners.begin(), patch.cageCorners.begin() + 4, [&](uint32_t c) {
            return mesh_.classOf(mesh_.corners[c].chart).turns() == 4;
        });
        return sharp ? PatchClass::blendSharp : regular ? PatchClass::blendRegular : PatchClass::blend;
    }

    [[nodiscard]] uint32_t poolIndex(uint32_t chart) const { return firstChart_ + kCoefficients * chart; }

    void writeCharts() {
        const uint32_t ring = 4 * writer_.element();
        writer_.put(mesh_.ring);
        std::vector<uint32_t> fits;
        for (const ChartClass& chartClass : mesh_.classes) {
            const FitMatrix matrix = makeFitMatrix(chartClass);
            fits.push_back(writer_.element());
            writer_.put({matrix.ringPoints, 0u, 0u, 0u});
            for (uint32_t i = 0; i < matrix.ringPoints; ++i) {
                for (uint32_t row = 0; row < kCoefficients; ++row) {
                    writer_.putFloats({matrix.weight(row, i)});
                }
                writer_.put({0u, 0u, 0u});
            }
        }
        // By class, and classes by size, so that neighbouring lanes loop equally long.
        std::vector<uint32_t> order(mesh_.charts.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            return mesh_.classOf(a).ringPoints() < mesh_.classOf(b).ringPoints();
        });
        const auto count = static_cast<uint32_t>(order.size());
        tables_.constructions.push_back({mesh_.refined ? Stage::assemble : Stage::vertex,
                                         kChartKernels[mesh_.refined ? 1 : 0],
                                         {writer_.element(), count},
                                         kCoefficients * count});
        for (const uint32_t i : order) {
            const Chart& chart = mesh_.charts[i];
            writer_.put({chart.vertex, ring + chart.firstRing, fits[chart.chartClass], poolIndex(i)});
        }
    }

    void writeCoordinates() {
        tables_.coordinates = writer_.element();
        for (uint32_t i = 0; i < coordinateCount(rate_); ++i) {
            const Coordinate c = coordinateAt(rate_, i);
            const float t = static_cast<float>(c.numerator) / static_cast<float>(c.denominator);
            writer_.put({std::bit_cast<uint32_t>(t), std::bit_cast<uint32_t>((2.0f * t - 3.0f) * t * t + 1.0f),
                         std::bit_cast<uint32_t>(6.0f * t * (t - 1.0f)), 0u});
        }
    }

    void put(glm::dvec2 a, glm::dvec2 b) { writer_.putFloats({a.x, a.y, b.x, b.y}); }

    void writeTurns(const ChartClass& chartClass) {
        const uint32_t turns = chartClass.turns(), side = coordinateCount(rate_);
        const auto [known, isNew] = turns_.try_emplace(turns);
        TurnTables& tables = known->second;
        if (isNew) {
            tables.spokes = chartDirections(turns);
            tables.directions = writer_.element();
            for (uint32_t h = 0; h < turns; ++h) {
                put(tables.spokes[h], tables.spokes[h + 1]);
            }
        }
        if (rate_ == 0) {
            return;
        }
        const auto onSecondSpoke = [&](uint32_t index) { return index % side == 0 && index > 0; };
        if (isNew) {
            const ChartTable table = makeChartTable(turns, rate_);
            tables.samples = writer_.element();
            for (uint32_t i = 0; i < side * side; ++i) {
                put(onSecondSpoke(i) ? glm::dvec2(table.radii[i / side], 0.0) : table.points[i], table.slopes[i]);
            }
        }
        if (chartClass.creased() && tables.creaseSamples == 0) {
            const CreaseTable table = makeCreaseTable(turns, rate_);
            tables.creaseSamples = writer_.element();
            for (uint32_t i = 0; i < side * side; ++i) {
                const double y = coordinateAt(rate_, i / side).value();
                put(onSecondSpoke(i) ? glm::dvec2(y, 0.0) : table.points[i], table.slopesX[i]);
                put(table.slopesY[i], glm::dvec2(0.0));
            }
        }
    }

    /// Charts of texture coordinates, and for every patch and UV set what its record has.
    Status writeUvs() {
        if (recipe_.uvMode == cage::UvMode::all || !recipe_.attributes || host_.cornerUvs.empty()) {
            return success();
        }
        const Result<RefinedMesh> begin = beginCharts(host_, recipe_.blend);
        if (!begin) {
            return begin.error();
        }
        std::vector<UvCharts> sets;
        std::vector<uint32_t> firstCharts; // elements
        for (const std::vector<glm::vec2>* uvs : uvSetsOf(begin->cage)) {
            Result<UvCharts> set = makeUvCharts(mesh_, *begin, *uvs, recipe_.uvMode);
            if (!set) {
                return set.error();
            }
            for (const ChartClass& chartClass : set->classes) {
                writeTurns(chartClass);
            }
            firstCharts.push_back(writer_.element());
            for (const auto& coefficients : set->coefficients) {
                for (const glm::dvec2& c : coefficients) {
                    writer_.putFloats({c.x + 0.0, c.y + 0.0});
                }
                (void)writer_.element();
            }
            sets.push_back(std::move(*set));
        }
        tables_.uvMode = recipe_.uvMode;
        for (PatchRange& range : tables_.ranges) {
            range.smoothUvs = writer_.element();
            for (uint32_t p = range.firstPatch; p < range.firstPatch + range.section.count; ++p) {
                for (size_t set = 0; set < sets.size(); ++set) {
                    writeUvCorners(patches_[p], sets[set], firstCharts[set]);
                }
            }
        }
        return success();
    }

    void writeUvCorners(const DraftPatch& patch, const UvCharts& charts, uint32_t firstChart) {
        constexpr uint32_t kChartElements = (kCoefficients + 1) / 2;
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i];
            const auto [chart, sector] = charts.corners[c];
            const bool chords = mesh_.classOf(mesh_.corners[c].chart).creased();
            writer_.put(recordWords(firstChart + kChartElements * chart, charts.classes[chart], sector, c,
                                    chords ? shared::kChordCorner : 0u));
        }
    }

    /// A corner of a record. `coefficients`: where its chart's stand.
    [[nodiscard]] std::array<uint32_t, 4> recordWords(uint32_t coefficients, const ChartClass& chartClass,
                                                      uint32_t sector, uint32_t corner, uint32_t flags) const {
        const TurnTables& tables = turns_.at(chartClass.turns());
        flags |= (chartClass.creased() ? shared::kCreasedChart : 0u) |
                 (stillCorner(corner) ? shared::kStillCorner : 0u) |
                 (flatAcross(mesh_, corner) ? shared::kStillEdge : 0u);
        return {coefficients | flags, tables.directions + sector,
                rate_ > 0 ? tables.samples : floatBits(4.0 / chartClass.turns()), tables.creaseSamples};
    }

    /// How corner `i` of a regular face sees its chart, of which it has sector h: the face's coordinates there are z,
    /// or its own two exchanged, and zeta is z turned by h quarters.
    [[nodiscard]] static uint32_t quarterOf(uint32_t i, uint32_t h) {
        const bool backX = h == 2 || h == 3, backY = h == 1 || h == 2, alongY = i % 2 == 1;
        return ((h + i) % 2 == 1 ? shared::kQuarterSwapped : 0u) |
               ((alongY ? backY : backX) ? shared::kQuarterBackAlong : 0u) |
               ((alongY ? backX : backY) ? shared::kQuarterBackAcross : 0u);
    }

    void writePatches() {
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            countPatch(patches_[p].info.patchClass, p, writer_, tables_);
            for (uint32_t i = 0; i < 4; ++i) {
                const uint32_t c = patches_[p].cageCorners[i];
                const Corner& corner = mesh_.corners[c];
                std::array<uint32_t, 4> words =
                    recordWords(poolIndex(corner.chart), mesh_.classOf(corner.chart), corner.sector, c, 0u);
                if (patches_[p].info.patchClass == PatchClass::blendRegular) {
                    words[3] = quarterOf(i, corner.sector);
                }
                writer_.put(words);
            }
            if (edges_ != nullptr) {
                addSides(patches_[p]);
            }
        }
    }

    void addSides(const DraftPatch& patch) {
        const cage::Topology& topology = mesh_.topology;
        edges_->beginPatch();
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i], next = patch.cageCorners[(i + 1) % 4];
            const uint32_t twin = topology.twins[c];
            const auto after = [&](uint32_t corner) {
                return cage::nextCorner(mesh_.cage, topology.cornerFaces[corner], corner);
            };
            PatchSide& side = edges_->sides.emplace_back();
            side.borders = Borders::charts;
            side.edge =
                edgeNumber(topology, c, twin != cage::kNone && isSameSpoke(c, after(twin)) && isSameSpoke(twin, next));
            side.curve = chartEnd(mesh_.corners[c].chart, mesh_.corners[c].sector);
            side.across = chartEnd(mesh_.corners[next].chart, mesh_.corners[next].sector + 1);
        }
    }
    /// Whether the spoke that a corner's sector begins with is, in the same chart, the one that another's ends with.
    [[nodiscard]] bool isSameSpoke(uint32_t begins, uint32_t ends) const {
        const Corner &a = mesh_.corners[begins], &b = mesh_.corners[ends];
        return a.chart == b.chart && a.sector == (b.sector + 1) % mesh_.classOf(b.chart).turns();
    }
    /// What levels have of an end of an edge: chart, direction in it, 4 / k.
    [[nodiscard]] std::array<uint32_t, 4> chartEnd(uint32_t chart, uint32_t spoke) const {
        const ChartClass& chartClass = mesh_.classOf(chart);
        const glm::dvec2& direction = turns_.at(chartClass.turns()).spokes[spoke];
        return {poolIndex(chart) | (chartClass.creased() ? shared::kCreasedChart : 0u), floatBits(direction.x),
                floatBits(direction.y), floatBits(4.0 / chartClass.turns())};
    }

    const Mesh& mesh_;
    const cage::Cage& host_;
    const Recipe& recipe_;
    uint32_t rate_;
    PatchEdges* edges_; ///< null: nobody asks
    Tables tables_;
    TableWriter writer_;
    uint32_t firstChart_ = 0; ///< in the pool
    std::vector<DraftPatch> patches_;
    std::map<uint32_t, TurnTables> turns_; ///< by k
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges) {
    const Result<Mesh> mesh = buildMesh(cage, recipe.blend);
    if (!mesh) {
        return mesh.error();
    }
    const uint32_t rate = std::max(recipe.rate, 1u);
    return Builder(*mesh, cage, recipe, recipe.lod ? 0 : mesh->refined ? (rate + 1) / 2 : rate, edges).build();
}

float boundsMargin(const cage::Cage& cage) {
    // A chart that is not open has smaller weights.
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    const bool open =
        !cage.creases.empty() || !cage.sharpVertices.empty() || !topology.ok() ||
        std::any_of(topology->boundary.begin(), topology->boundary.end(), [](uint8_t b) { return b != 0; });
    return open ? 1.05f : 0.3f; // found: 1.0126, 0.2812
}

} // namespace supple::surface::blend
