// The subdivision as a scheme: the tables of shaders/shared/{surface,subdivision}.h.
#include "shaders/shared/subdivision.h"
#include "surface/build.h"
#include "surface/fragments/smooth_uvs.h"
#include "surface/smooth_uvs.h"
#include "surface/stencil_table.h"
#include "surface/subdivision/masks.h"
#include "surface/subdivision/pattern.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

namespace supple::surface::fragments {

using namespace subdivision;

namespace {

static_assert(static_cast<uint32_t>(Rule::vertex) == shared::kVertexRule &&
              static_cast<uint32_t>(Rule::edge) == shared::kEdgeRule &&
              static_cast<uint32_t>(Rule::face) == shared::kFaceRule &&
              static_cast<uint32_t>(Rule::centre) == shared::kCentreRule);

constexpr uint32_t kMaxPoints = 0xFFFF; ///< 16-bit indices

/// Fragments that share all their tables.
struct ClassKey {
    Fan fan;
    bool sharp = false;

    bool operator<(const ClassKey& other) const { return std::tie(fan, sharp) < std::tie(other.fan, other.sharp); }
};

/// A fan's pattern, and where it lies in the tables.
struct PatternTables {
    Pattern pattern;
    uint32_t rows = 0, neighbours = 0; ///< elements
};

/// A fragment after a step: where its tables lie.
struct StepTables {
    uint32_t points = 0;
    const PatternTables* pattern = nullptr;
    Section cells;    ///< elements
    Section oneByOne; ///< words
    uint32_t run = 0; ///< in the scratch buffer
};

struct ClassTables {
    ClassKey key;
    std::vector<uint32_t> fragments;                         ///< of the mesh
    std::vector<StepTables> after;                           ///< 0..steps
    Section strips, limitRows;                               ///< elements
    uint32_t limitOneByOne = 0;                              ///< of the limit rows, the first
    uint32_t net = 0, sharpness = 0, patches = 0, masks = 0; ///< words
    uint32_t centreSteps = 0, header = 0;                    ///< elements
    [[nodiscard]] uint32_t sharedPoints() const {
        const size_t last = after.size() - 1;
        return after[last].points + (last > 0 ? after[last - 1].points : 0);
    }
    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(fragments.size()); }
};

class Builder {
public:
    /// `depth`: steps from the cage, at least the isolation steps.
    Builder(const Mesh& mesh, const cage::Cage& cage, const Recipe& recipe, uint32_t depth)
        : mesh_(mesh), host_(cage), recipe_(recipe),
          steps_(depth > mesh.isolationSteps ? depth - mesh.isolationSteps : 0), writer_(tables_.words) {}

    Result<Tables> build() {
        sortFragments();
        for (const ClassTables& c : classes_) {
            if (pointCount(c.key.fan, (1u << steps_) + 1) >= kMaxPoints) {
                const Fragment& fragment = mesh_.fragments[c.fragments.front()];
                return Error{ErrorCode::limit, "vertex " + std::to_string(mesh_.net[fragment.firstNet]) + " has " +
                                                   std::to_string(c.key.fan.sectors) + " faces: at depth " +
                                                   std::to_string(steps_ + mesh_.isolationSteps) +
                                                   " they have more points than the subdivision counts"};
            }
        }
        sortPatches();
        tables_.isolationSteps = mesh_.isolationSteps;
        tables_.rate = 1u << steps_;
        tables_.notes = mesh_.notes;
        // What there is of them all, roughly: untouched pages cost nothing, growing does.
        writer_.reserve(24 * size_t{mesh_.cage.vertexCount()} + 32 * size_t{mesh_.cage.faceCount()});
        writeSteps();
        for (ClassTables& c : classes_) {
            writeClass(c);
        }
        writeFragments();
        writeBlocks();
        if (!patches_.empty()) {
            tables_.ranges.push_back({PatchClass::fragment, {0, static_cast<uint32_t>(patches_.size())}, 0, 0});
        }
        finishTables(recipe_, mesh_.cage, patches_, writer_, tables_, nullptr);
        const Status smooth = writeUvs();
        if (!smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    [[nodiscard]] std::span<const float> sharpness(const Fragment& fragment) const {
        return std::span(mesh_.spokeSharpness).subspan(fragment.firstSpoke, fragment.spokes());
    }

    /// Classes by what a workgroup needs for a fragment.
    void sortFragments() {
        std::map<ClassKey, std::vector<uint32_t>> byKey;
        for (uint32_t f = 0; f < mesh_.fragments.size(); ++f) {
            const Fragment& fragment = mesh_.fragments[f];
            const std::span<const float> spokes = sharpness(fragment);
            const bool sharp = fragment.centreSharpness > 0.0f ||
                               std::any_of(spokes.begin(), spokes.end(), [](float s) { return s > 0.0f; });
            byKey[{{mesh_.subdivision, fragment.sectors, fragment.open}, sharp}].push_back(f);
        }
        for (auto& [key, fragments] : byKey) {
            ClassTables& c = classes_.emplace_back();
            c.key = key;
            c.fragments = std::move(fragments);
            for (uint32_t step = 0; step <= steps_; ++step) {
                c.after.push_back({pointCount(key.fan, (1u << step) + 1)});
            }
        }
        std::stable_sort(classes_.begin(), classes_.end(), [](const ClassTables& a, const ClassTables& b) {
            return a.sharedPoints() < b.sharedPoints();
        });
    }

    void sortPatches() {
        patches_ = draftPatches({mesh_.cage, mesh_.hostVertices, mesh_.sourceFaces},
                                [](const DraftPatch&) { return PatchClass::fragment; });
        facePatches_.assign(mesh_.cage.faceCount(), shared::kNoPatch);
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            facePatches_[patches_[p].facet] = p;
        }
    }

    /// The isolated mesh stands at the front of the pool, a step before it behind.
    void writeSteps() {
        const std::vector<Stencils>& steps = mesh_.stencils;
        const uint32_t isolated = steps.back().rows();
        if (steps.size() == 1) {
            writeStencils(steps[0], {}, writer_, tables_);
            tables_.poolStride = isolated;
        } else {
            writeStencils(steps[0], {Stage::vertex, false, 0, isolated}, writer_, tables_);
            writeStencils(steps[1], {Stage::assemble, true, isolated, 0}, writer_, tables_);
            tables_.poolStride = isolated + steps[0].rows();
        }
        tables_.poolStride = poolStrideFor(tables_.poolStride);
    }

    PatternTables writePattern(Pattern pattern) {
        PatternTables tables;
        tables.rows = writer_.element();
        for (const Row& row : pattern.rows) {
            std::array<uint32_t, 8> halves{};
            std::copy(row.sources.begin(), row.sources.end(), halves.begin());
            halves[7] = static_cast<uint32_t>(row.rule) | (row.spoke == kNoSpoke ? 0u : (row.spoke + 1) << 2);
            writer_.putHalves(halves);
        }
        tables.neighbours = writer_.element();
        for (const Neighbours& neighbours : pattern.neighbours) {
            writer_.putHalves(neighbours);
        }
        tables.pattern = std::move(pattern);
        return tables;
    }

    /// One for all steps.
    const PatternTables& patternOf(const Fan& fan) {
        const auto [known, isNew] = fans_.try_emplace(fan);
        if (isNew) {
            known->second = writePattern(fanPattern(fan, steps_));
        }
        return known->second;
    }

    /// The points a cell makes, as the tables have them.
    using Cell = std::array<uint32_t, 8>;

    /// Gives every row of a step that needs neither sharpness nor the centre's rule to a cell of the step before, if
    /// one has all of its sources round it, and takes it from `rows`. `neighbours` are those before the step.
    std::vector<Cell> makeCells(const ClassKey& key, std::span<const Neighbours> neighbours,
                                const std::vector<Row>& pattern, std::vector<uint32_t>& rows) const {
        // The points of the next step that a point's ring makes: towards which neighbours.
        constexpr uint32_t kSlots[] = {SUPPLE_SUBDIVISION_QUAD_SLOTS};
        std::map<uint32_t, Cell> cells;
        const auto give = [&](uint32_t point, uint32_t slot, uint32_t row) {
            const auto [cell, isNew] = cells.try_emplace(point);
            if (isNew) {
                cell->second.fill(shared::kNoTarget);
                cell->second[shared::kCellTargets] = point;
            }
            cell->second[slot] = row;
        };
        std::erase_if(rows, [&](uint32_t row) {
            const Row& r = pattern[row];
            if (r.rule == Rule::centre || (key.sharp && r.spoke != kNoSpoke)) {
                return false;
            }
            // A vertex point's cell is its first source's; an edge or face point's that of a corner with a slot for it.
            const uint32_t corners = r.rule == Rule::vertex ? 1 : r.rule == Rule::edge ? 2 : 4;
            for (uint32_t k = 0; k < corners; ++k) {
                const uint32_t point = r.sources[k];
                if (point == 0 || point >= neighbours.size() ||
                    neighbours[point][0] == point) { // the centre, or in the halo
                    continue;
                }
                if (r.rule == Rule::vertex) {
                    give(point, 0, row);
                    return true;
                }
                for (uint32_t slot = 0; slot < std::size(kSlots); ++slot) {
                    if (neighbours[point][kSlots[slot]] == r.sources[k ^ 1u]) {
                        give(point, 1 + slot, row);
                        return true;
                    }
                }
            }
            return false;
        });
        std::vector<Cell> result;
        for (const auto& [point, cell] : cells) {
            result.push_back(cell);
        }
        return result;
    }

    void writeWork(ClassTables& c) {
        for (uint32_t step = 0; step <= steps_; ++step) {
            c.after[step].pattern = &patternOf(c.key.fan);
        }
        for (uint32_t step = 1; step <= steps_; ++step) {
            StepTables& own = c.after[step];
            // Those neighbours that were covered before the step; they come first.
            const std::span<const Neighbours> neighbours =
                std::span<const Neighbours>(c.after[step - 1].pattern->pattern.neighbours)
                    .first(pointCount(c.key.fan, 1u << (step - 1)));
            std::vector<uint32_t> rows(own.points);
            std::iota(rows.begin(), rows.end(), 0u);
            const std::vector<Cell> cells = makeCells(c.key, neighbours, own.pattern->pattern.rows, rows);
            own.cells = {writer_.element(), static_cast<uint32_t>(cells.size())};
            for (const Cell& cell : cells) {
                writer_.putHalves(cell);
            }
            own.oneByOne = {4 * writer_.element(), static_cast<uint32_t>(rows.size())};
            writer_.put(rows);
        }
    }

    /// How many quarters to turn from a point's first neighbour to the direction of the sector's first edge. A centre
    /// has 0.
    [[nodiscard]] static uint32_t turnsAt(const Fan& fan, const Neighbours& neighbours, uint32_t sector, int32_t a,
                                          int32_t b) {
        const uint32_t next = pointIndex(fan, sector, a + 1, b);
        for (uint32_t turns = 0; turns < 4; ++turns) {
            if (neighbours[2 * turns] == next) {
                return turns;
            }
        }
        return 0;
    }

    struct LimitRow {
        uint32_t point, place, sample;
    };

    /// Strips of the samples that need neither sharpness nor the centre's mask, and rows for all, the others first.
    void writeLimits(ClassTables& c) {
        const Pattern& pattern = c.after[steps_].pattern->pattern;
        const int32_t side = 1 << steps_;
        std::vector<LimitRow> oneByOne, inStrips;
        std::vector<Section> strips; // columns
        std::vector<uint32_t> stripSectors;
        uint32_t column = writer_.element();
        for (uint32_t sector = 0; sector < c.key.fan.sectors; ++sector) {
            uint32_t sample = 0;
            for (int32_t b = 0; b <= side; ++b) {
                strips.push_back({column, static_cast<uint32_t>(side + 3)});
                stripSectors.push_back(sector);
                for (int32_t a = -1; a <= side + 1; ++a, ++column) {
                    // Points that no sample of the strip asks for may be missing, or lie beyond the halo.
                    const auto at = [&](int32_t y) {
                        const uint32_t point = pointIndex(c.key.fan, sector, a, y);
                        return point < c.after[steps_].points ? point : 0u;
                    };
                    const uint32_t point = at(b);
                    const bool isSample = a >= 0 && a <= side;
                    uint32_t inStrip = shared::kNoSample;
                    if (isSample) {
                        const uint32_t spoke = pattern.spokes[point];
                        if (point != 0 && !(c.key.sharp && spoke != kNoSpoke)) {
                            inStrip = 0;
                        }
                        (inStrip == shared::kNoSample ? oneByOne : inStrips)
                            .push_back(
                                {point,
                                 sector |
                                     turnsAt(c.key.fan, pattern.neighbours[point], sector, a, b) << shared::kTurnShift |
                                     (a == 0 ? shared::kRightSide : 0u),
                                 sample});
                    }
                    writer_.put({at(b - 1) | point << 16, at(b + 1) | sample << 16, inStrip, 0u});
                    sample += isSample ? 1 : 0;
                }
            }
        }
        c.strips = {writer_.element(), static_cast<uint32_t>(strips.size())};
        for (size_t i = 0; i < strips.size(); ++i) {
            writer_.put({strips[i].table, strips[i].count, stripSectors[i], 0u});
        }
        writeLimitRows(c, oneByOne, inStrips);
    }

    void writeLimitRows(ClassTables& c, const std::vector<LimitRow>& oneByOne, const std::vector<LimitRow>& inStrips) {
        const Pattern& pattern = c.after[steps_].pattern->pattern;
        c.limitRows = {writer_.element(), static_cast<uint32_t>(oneByOne.size() + inStrips.size())};
        c.limitOneByOne = static_cast<uint32_t>(oneByOne.size());
        for (const std::vector<LimitRow>* rows : {&oneByOne, &inStrips}) {
            for (const LimitRow& row : *rows) {
                writer_.putHalves(pattern.neighbours[row.point]);
                const uint32_t spoke = pattern.spokes[row.point];
                writer_.put({row.point, spoke == kNoSpoke ? 0u : spoke + 1, row.place, row.sample});
            }
        }
    }

    void writeClass(ClassTables& c) {
        const uint32_t sectors = c.key.fan.sectors;
        writeWork(c);
        writeLimits(c);
        for (size_t i = 0; i < c.fragments.size(); ++i) {
            if (i == 0 || c.key.sharp) {
                writeMasks(c.key.fan, mesh_.fragments[c.fragments[i]]);
            } else { // the same as the first one's
                for (uint32_t h = 0; h < sectors; ++h) {
                    masks_.push_back(masks_[masks_.size() - sectors]);
                }
            }
        }
        if (c.key.sharp) {
            writeCentreSteps(c);
        }
        const auto words = [&](uint32_t rows, auto&& value) {
            const uint32_t first = 4 * writer_.element();
            for (uint32_t row = 0; row < rows; ++row) {
                for (const uint32_t f : c.fragments) {
                    writer_.put({value(mesh_.fragments[f], row)});
                }
            }
            return first;
        };
        c.net = words(c.after[0].points, [&](const Fragment& f, uint32_t i) { return mesh_.net[f.firstNet + i]; });
        c.patches = words(sectors, [&](const Fragment& f, uint32_t sector) {
            return facePatches_[mesh_.sectorFaces[f.firstSector + sector]];
        });
        if (c.key.sharp) {
            c.sharpness = words(mesh_.fragments[c.fragments.front()].spokes(), [&](const Fragment& f, uint32_t spoke) {
                return std::bit_cast<uint32_t>(sharpness(f)[spoke]);
            });
        }
        uint32_t next = 0;
        std::vector<uint32_t> own;
        std::swap(own, masks_);
        c.masks = words(sectors,
                        [&](const Fragment&, uint32_t sector) { return own[next++ % c.count() * sectors + sector]; });
        const CentreWeights weights = refineWeights(mesh_.subdivision, c.key.fan.sectors);
        c.header = writer_.element();
        writer_.put({c.count(), sectors | (c.key.sharp ? shared::kSharpClass : 0u), c.net, c.sharpness, c.patches,
                     c.masks, c.centreSteps, 0u, floatBits(weights.spoke), floatBits(weights.face), c.limitRows.table,
                     c.limitRows.count});
        for (uint32_t step = 0; step <= steps_; ++step) {
            StepTables& after = c.after[step];
            after.run = tables_.fragments.scratchStride;
            writer_.put({after.pattern->rows, after.pattern->neighbours, after.points, after.run});
            tables_.fragments.scratchStride += step > 0 ? after.points * c.count() : 0;
        }
    }

    /// Appends to masks_ the mask element of every sector of a fragment.
    void writeMasks(const Fan& fan, const Fragment& fragment) {
        const CentreLimit limit =
            centreLimit(fan, softened(sharpness(fragment), steps_), softened(fragment.centreSharpness, steps_));
        const size_t first = masks_.size();
        masks_.resize(first + fan.sectors);
        const uint32_t ring = pointCount(fan, 1) - 1;
        for (const CentreRun& run : limit.runs) {
            const bool whole = limit.runs.size() == 1 && !fan.open && !run.corner;
            std::vector<uint32_t> words = {run.corner ? shared::kCornerMask
                                           : whole    ? shared::kWholeMask
                                                      : 0u,
                                           run.firstSector, run.sectors, ring};
            for (uint32_t i = 1; i <= ring; ++i) {
                words.insert(words.end(), {floatBits(limit.position[i]), run.corner ? 0u : floatBits(run.first[i]),
                                           run.corner ? 0u : floatBits(run.second[i]), 0u});
            }
            const auto [known, isNew] = maskElements_.try_emplace(words, 0u);
            if (isNew) {
                known->second = writer_.element();
                writer_.put(words);
            }
            for (uint32_t h = 0; h < run.sectors; ++h) {
                masks_[first + (run.firstSector + h) % fan.sectors] = known->second;
            }
        }
    }

    void writeCentreSteps(ClassTables& c) {
        c.centreSteps = writer_.element();
        for (uint32_t step = 0; step < steps_; ++step) {
            for (const uint32_t f : c.fragments) {
                const Fragment& fragment = mesh_.fragments[f];
                const CentreStep centre =
                    centreStep(softened(sharpness(fragment), step), softened(fragment.centreSharpness, step));
                writer_.put({floatBits(centre.smooth), floatBits(centre.crease), centre.first, centre.second});
            }
        }
    }

    void writeFragments() {
        tables_.fragments.steps = steps_;
        tables_.fragments.scratchStride = poolStrideFor(tables_.fragments.scratchStride);
        for (const ClassTables& c : classes_) {
            tables_.fragments.classes.push_back({c.sharedPoints(), {writer_.element(), c.count()}, {}});
            for (uint32_t fragment = 0; fragment < c.count(); ++fragment) {
                writer_.put({c.header, fragment, 0u, 0u});
            }
        }
    }

    void writeBlocks() {
        for (uint32_t step = 1; step <= steps_ + 1; ++step) {
            for (uint32_t kind = 0; kind < shared::kWorkKinds; ++kind) {
                for (size_t k = 0; k < classes_.size(); ++k) {
                    writeBlocks(k, step, kind);
                }
            }
        }
    }

    /// The limits themselves: of every patch and UV set its samples, each with what a direction asks of its slopes.
    Status writeUvs() {
        if (recipe_.uvMode == cage::UvMode::all || !recipe_.attributes || host_.cornerUvs.empty() || patches_.empty()) {
            return success();
        }
        std::vector<std::string> notes; // known
        const Result<RefinedMesh> begin = beginSteps(host_, mesh_.subdivision, notes);
        if (!begin) {
            return begin.error();
        }
        std::vector<std::vector<UvSample>> sets;
        for (const std::vector<glm::vec2>* uvs : uvSetsOf(begin->cage)) {
            Result<std::vector<UvSample>> set =
                limitUvs(*begin, *uvs, {mesh_.subdivision, mesh_.isolationSteps, steps_, recipe_.uvMode, true});
            if (!set) {
                return set.error();
            }
            sets.push_back(std::move(*set));
        }
        tables_.uvMode = recipe_.uvMode;
        tables_.ranges.front().smoothUvs = writer_.element();
        const size_t samples = sets.front().size() / mesh_.cage.faceCount();
        writer_.reserve(4 * samples * sets.size() * patches_.size());
        for (const DraftPatch& patch : patches_) {
            const cage::MapFrame frame = cage::mapFrameOf(recipe_.mapFrames, patch.info.material);
            for (const std::vector<UvSample>& set : sets) {
                for (size_t i = samples * patch.facet; i < samples * (patch.facet + 1); ++i) {
                    const UvSample& s = set[i];
                    writer_.putFloats({s.value.x + 0.0, s.value.y + 0.0, frame.turn(s.u).y, frame.turn(s.v).y});
                }
            }
        }
        return success();
    }

    /// Kind 0: cells, or strips in the limit, which is the last step; kind 1: rows one by one.
    void writeBlocks(size_t classIndex, uint32_t step, uint32_t kind) {
        const ClassTables& c = classes_[classIndex];
        const StepTables& before = c.after[step - 1];
        uint32_t list = c.patches, write = 0;
        Section rows = kind == 0 ? c.strips : Section{c.limitRows.table, c.limitOneByOne};
        if (step <= steps_) {
            const StepTables& own = c.after[step];
            list = kind == 0 ? 0 : own.oneByOne.table;
            write = own.run;
            rows = kind == 0 ? own.cells : Section{own.pattern->rows, own.oneByOne.count};
        }
        Section section{writer_.element(), 0};
        for (uint64_t lane = 0; lane < uint64_t{rows.count} * c.count(); lane += shared::kBlockLanes, ++section.count) {
            writer_.put({rows.table, list, static_cast<uint32_t>(lane / c.count()),
                         static_cast<uint32_t>(lane % c.count()), step == 1 ? c.net : before.run, write, c.count(),
                         rows.count, before.pattern->neighbours, c.header, 0u, 0u});
        }
        tables_.fragments.classes[classIndex].blocks.push_back(section);
    }

    const Mesh& mesh_;
    const cage::Cage& host_;
    const Recipe& recipe_;
    uint32_t steps_;
    Tables tables_;
    TableWriter writer_;
    std::vector<ClassTables> classes_;
    std::vector<DraftPatch> patches_;
    std::vector<uint32_t> facePatches_; ///< per face of the isolated mesh
    std::map<Fan, PatternTables> fans_;
    std::map<std::vector<uint32_t>, uint32_t> maskElements_;
    std::vector<uint32_t> masks_; ///< [fragment][sector] of the class at work
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* /*edges*/) {
    const Result<Mesh> mesh = buildMesh(cage, Subdivision::catmullClark);
    if (!mesh) {
        return mesh.error();
    }
    return Builder(*mesh, cage, recipe, recipe.rate > 1 ? static_cast<uint32_t>(std::bit_width(recipe.rate - 1)) : 0)
        .build();
}

} // namespace supple::surface::fragments
