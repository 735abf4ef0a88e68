#include "surface/lod/tables.h"

#include "shaders/shared/blend.h"
#include "shaders/shared/chains.h"
#include "surface/borders.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <map>

namespace supple::surface::lod {

namespace {

using Words = std::vector<uint32_t>;

/// A patch's border. Two patches have the same edge if they have the same key.
struct Border {
    Borders kind = Borders::cubics;
    Words key;
    Words edge;          ///< as tables have it
    uint32_t number = 0; ///< of the edge
};
/// The two patches write such a border from opposite ends. Its edge is the smaller of both, which is the same for them.
Border borderOf(Borders kind, const Words& edge) {
    return {kind, edge, edge};
}

/// Between charts, for either end: chart, direction in it, 4 / k.
Border chartBorder(const Words& words, const uint32_t* corner, const uint32_t* next) {
    Words ends[2];
    for (uint32_t e = 0; e < 2; ++e) {
        const uint32_t* record = e == 0 ? corner : next;
        const uint32_t* direction = &words[size_t{4} * record[1] + 2 * e]; // of the first spoke, and of the second one
        ends[e] = {record[0] & (shared::kPoolIndexMask | shared::kCreasedChart), direction[0], direction[1], record[2]};
    }
    const auto [first, second] = std::minmax(ends[0], ends[1]);
    Words border = first;
    border.insert(border.end(), second.begin(), second.end());
    return borderOf(Borders::charts, border);
}

/// A side of an irregular quad that has two halves. No other edge has the point of level 1 in its middle.
Border halvesBorder(const Tables& tables, const uint32_t* record, uint32_t element, uint32_t side) {
    const uint32_t middle = quadNetPoint(tables, record, SUPPLE_QUAD_SIDE_MIDDLE(side));
    return {Borders::halves, {middle}, {element, side, 0, 0}};
}

/// A side of a triangle of Loop, by the limit points of its ends.
Border splineBorder(const uint32_t* record, uint32_t element, uint32_t side) {
    const auto [first, second] = std::minmax(record[side], record[(side + 1) % 3]);
    const uint32_t flags = record[4 * shared::kTriangleCornerElement + 3];
    const bool whole = (flags >> (shared::kWholeTriangleSide + side) & 1u) != 0;
    return {whole ? Borders::splines : Borders::splineHalves, {first, second}, {element, side, 0, 0}};
}

/// By side of the grid.
std::vector<Border> borders(const Tables& tables, uint32_t element, PatchClass patchClass) {
    const uint32_t* record = &tables.words[size_t{4} * element];
    std::vector<Border> all;
    if (rowOf(patchClass).borders == Borders::charts) {
        for (uint32_t i = 0; i < 4; ++i) {
            all.push_back(chartBorder(tables.words, record + size_t{4} * i, record + size_t{4} * ((i + 1) % 4)));
        }
        return all;
    }
    if (rowOf(patchClass).borders == Borders::splines) {
        for (uint32_t side = 0; side < 3; ++side) {
            all.push_back(splineBorder(record, element, side));
        }
        return all;
    }
    for (const BorderCurve& c : borderCurves(tables, record, patchClass)) {
        all.push_back(
            borderOf(Borders::cubics, std::min(Words{c[0], c[1], c[2], c[3]}, Words{c[3], c[2], c[1], c[0]})));
    }
    const bool halves = rowOf(patchClass).borders == Borders::halves;
    const uint32_t flags = halves ? record[4 * shared::kQuadNetElement + shared::kWindowLastWord] : ~0u;
    for (uint32_t side = 0; side < all.size(); ++side) {
        if ((flags >> (shared::kCubicSide + side) & 1u) == 0) {
            all[side] = halvesBorder(tables, record, element, side);
        }
    }
    return all;
}

/// Numbers edges kind by kind, in the order in which patches come to them, and appends their elements to the tables.
void writeEdges(std::vector<std::vector<Border>>& ofPatches, Tables& tables) {
    TableWriter writer(tables.words);
    for (const Borders kind :
         {Borders::cubics, Borders::halves, Borders::splines, Borders::splineHalves, Borders::charts}) {
        std::map<Words, uint32_t> numbers;
        const uint32_t first = tables.lod.edgeCount, element = writer.element();
        for (std::vector<Border>& borders : ofPatches) {
            for (Border& border : borders) {
                if (border.kind != kind) {
                    continue;
                }
                const auto [found, isNew] = numbers.try_emplace(border.key, tables.lod.edgeCount);
                border.number = found->second;
                if (isNew) {
                    writer.put(border.edge);
                    ++tables.lod.edgeCount;
                }
            }
        }
        if (!numbers.empty()) {
            tables.lod.edges.push_back({kind, first, {element, static_cast<uint32_t>(numbers.size())}});
        }
    }
}

} // namespace

void appendTables(Tables& tables) {
    std::vector<std::vector<Border>> ofPatches;
    for (const PatchRange& range : tables.ranges) {
        const uint32_t elements = recordElements(tables, range.patchClass);
        tables.lod.borders = std::max(tables.lod.borders, rowOf(range.patchClass).borders);
        for (uint32_t p = 0; p < range.section.count; ++p) {
            ofPatches.push_back(borders(tables, range.section.table + p * elements, range.patchClass));
        }
    }
    writeEdges(ofPatches, tables);
    Words patches;
    for (const PatchRange& range : tables.ranges) {
        const uint32_t elements = recordElements(tables, range.patchClass);
        for (uint32_t p = 0; p < range.section.count; ++p) {
            const uint32_t patch = range.firstPatch + p, element = range.section.table + p * elements;
            const uint32_t material = tables.patches[patch].material;
            if (tables.lod.runs.empty() || tables.lod.runs.back().patchClass != range.patchClass ||
                tables.lod.runs.back().material != material) {
                tables.lod.runs.push_back({range.patchClass, material, 0});
            }
            ++tables.lod.runs.back().patchCount;
            std::array<uint32_t, kMaxSides> own{};
            std::ranges::transform(ofPatches[patch], own.begin(), &Border::number);
            const auto run = static_cast<uint32_t>(tables.lod.runs.size() - 1);
            const uint32_t kind = static_cast<uint32_t>(range.patchClass) | tables.patches[patch].part
                                                                                << shared::kLodPartShift;
            patches.insert(patches.end(), {own[0], own[1], own[2], own[3], own[4], run, element, kind});
        }
    }
    TableWriter writer(tables.words);
    tables.lod.patches = {writer.element(), static_cast<uint32_t>(tables.patches.size())};
    writer.put(patches);
}

} // namespace supple::surface::lod
