// Follows the tables of shaders/shared/blend.h as the kernels of shaders/blend do.
#include "shaders/shared/blend.h"
#include "shaders/shared/subdivision.h"
#include "surface/blend/kernels.h"
#include "surface/build.h"
#include "surface/stencil_table.h"
#include "surface/table_check_common.h"

#include <array>
#include <span>

namespace supple::surface::blend {

namespace {

using namespace shared;

class BlendCheck {
public:
    explicit BlendCheck(TableCheck& check)
        : check_(check), tables_(check.tables()), atLevels_(check.source().recipe.lod) {}

    void run() { (void)(checkConstructions() && checkCharts() && checkCoordinates() && checkPatches() && checkUvs()); }

private:
    /// Charts, behind a step of subdivision where the cage takes one.
    bool checkConstructions() {
        const std::array steps = {stencilKernel(false, kHalfWords), stencilKernel(false, kWholeWords)};
        const std::span charts(kChartKernels);
        const bool refined = tables_.isolationSteps > 0;
        const auto& all = tables_.constructions;
        if (!checkClasses(check_, {PatchClass::blend, PatchClass::blendSharp, PatchClass::blendRegular}) ||
            !checkKernels(
                check_,
                {{Stage::vertex, steps}, {Stage::vertex, charts.first(1)}, {Stage::assemble, charts.last(1)}}) ||
            !check_.require(all.size() == (refined ? 2 : 1) && all.back().kernel == charts[refined ? 1 : 0],
                            "not a step and charts")) {
            return false;
        }
        vertices_ = check_.source().vertices;
        if (!refined) {
            return true;
        }
        vertices_ = all.front().coefficients;
        check_.begin("stencils");
        return check_.require(all.front().to == 0, "vertices that do not begin the pool") &&
               check_.pool(0, vertices_) && checkStencils(check_, all.front(), check_.source().vertices);
    }

    bool checkCharts() {
        check_.begin("charts");
        const Section& section = tables_.constructions.back().section;
        if (!check_.elements(section.table, section.count)) {
            return false;
        }
        for (uint64_t chart = 0; chart < section.count; ++chart) {
            if (!checkChart(check_.element(section.table + chart))) {
                return false;
            }
        }
        return true;
    }

    /// Its vertex, first ring word, fit and coefficients.
    bool checkChart(std::span<const uint32_t> record) {
        if (!check_.within(record[0], 1, vertices_, "vertices") || !check_.elements(record[2], 1)) {
            return false;
        }
        const uint32_t points = check_.element(record[2])[0];
        if (!check_.elements(record[2], 1 + uint64_t{3} * points) || !check_.words(record[1], points)) {
            return false;
        }
        // Charts have rings of their own. With this no file can make kernels go round one long ring for every chart.
        ringWords_ += points;
        if (!check_.require(ringWords_ <= tables_.words.size(), "their rings overlap")) {
            return false;
        }
        for (const uint32_t vertex : std::span(tables_.words).subspan(record[1], points)) {
            if (!check_.within(vertex, 1, vertices_, "vertices")) {
                return false;
            }
        }
        return check_.pool(record[3], kChartCoefficients);
    }

    /// Checks the samples of a rate. At levels there are neither coordinates nor samples.
    bool checkCoordinates() {
        check_.begin("coordinates");
        // Those on the grid, and half a step inside either end.
        const uint64_t coordinates = tables_.rate + uint64_t{3};
        samples_ = coordinates * coordinates;
        return check_.require(atLevels_ == (tables_.rate == 0), "made for no rate") &&
               (atLevels_ || check_.elements(tables_.coordinates, coordinates));
    }

    /// A corner of a patch but for where its coefficients are.
    bool checkCorner(std::span<const uint32_t> corner, PatchClass patchClass) {
        const bool creased = patchClass == PatchClass::blendSharp && (corner[0] & kCreasedChart) != 0;
        return check_.elements(corner[1], 1) && (atLevels_ || (check_.elements(corner[2], samples_) &&
                                                               (!creased || check_.elements(corner[3], 2 * samples_))));
    }

    bool checkPatches() {
        check_.begin("patch records");
        for (const PatchRange& range : tables_.ranges) {
            for (uint64_t c = 0; c < uint64_t{4} * range.section.count; ++c) {
                const std::span<const uint32_t> corner = check_.element(range.section.table + c);
                if (!check_.pool(corner[0] & kPoolIndexMask, kChartCoefficients) ||
                    !checkCorner(corner, range.patchClass)) {
                    return false;
                }
            }
        }
        return true;
    }

    /// The coefficients of texture coordinates are in the tables, two an element.
    bool checkUvs() {
        check_.begin("smooth texture coordinates");
        for (const PatchRange& range : tables_.ranges) {
            const uint64_t corners = uint64_t{4} * tables_.uvSets * range.section.count;
            if (tables_.uvMode == cage::UvMode::all) {
                continue;
            }
            if (!check_.elements(range.smoothUvs, corners)) {
                return false;
            }
            for (uint64_t c = 0; c < corners; ++c) {
                const std::span<const uint32_t> corner = check_.element(range.smoothUvs + c);
                if (!check_.elements(corner[0] & kPoolIndexMask, (kChartCoefficients + 1) / 2) ||
                    !checkCorner(corner, range.patchClass)) {
                    return false;
                }
            }
        }
        return true;
    }

    TableCheck& check_;
    const Tables& tables_;
    bool atLevels_;
    uint64_t vertices_ = 0; ///< that charts are made of
    uint64_t ringWords_ = 0, samples_ = 0;
};

} // namespace

void check(TableCheck& check) {
    BlendCheck(check).run();
}

} // namespace supple::surface::blend
