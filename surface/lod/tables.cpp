#include "surface/lod/tables.h"

#include "shaders/shared/blend.h"
#include "surface/borders.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <map>

namespace supple::surface::lod {

namespace {

/// A border as its edge is written, and as the patch on the other side writes it. A cubic: see surface/borders.h.
/// Between charts, for either end: chart, direction in it, 4 / k.
struct Border {
    std::vector<uint32_t> words, reversed;
};

Border chartBorder(const std::vector<uint32_t>& words, const uint32_t* corner, const uint32_t* next) {
    std::vector<uint32_t> ends[2];
    for (uint32_t e = 0; e < 2; ++e) {
        const uint32_t* record = e == 0 ? corner : next;
        const uint32_t* direction = &words[size_t{4} * record[1] + 2 * e]; // of the first spoke, and of the second one
        ends[e] = {record[0] & (shared::kPoolIndexMask | shared::kCreasedChart), direction[0], direction[1], record[2]};
    }
    Border border{ends[0], ends[1]};
    border.words.insert(border.words.end(), ends[1].begin(), ends[1].end());
    border.reversed.insert(border.reversed.end(), ends[0].begin(), ends[0].end());
    return border;
}

/// By side of the grid.
std::vector<Border> borders(const Tables& tables, uint32_t element, PatchClass patchClass) {
    const uint32_t* record = &tables.words[size_t{4} * element];
    std::vector<Border> all;
    if (rowOf(patchClass).charts) {
        for (uint32_t i = 0; i < 4; ++i) {
            all.push_back(chartBorder(tables.words, record + size_t{4} * i, record + size_t{4} * ((i + 1) % 4)));
        }
        return all;
    }
    for (const BorderCurve& c : borderCurves(tables, record, patchClass)) {
        all.push_back({{c[0], c[1], c[2], c[3]}, {c[3], c[2], c[1], c[0]}});
    }
    return all;
}

} // namespace

void appendTables(Tables& tables) {
    std::map<std::vector<uint32_t>, uint32_t> edges;
    std::vector<uint32_t> edgeWords, patches;
    for (const PatchRange& range : tables.ranges) {
        const uint32_t elements = recordElements(tables, range.patchClass);
        tables.lod.charts = rowOf(range.patchClass).charts;
        for (uint32_t p = 0; p < range.section.count; ++p) {
            const uint32_t patch = range.firstPatch + p, element = range.section.table + p * elements;
            const uint32_t material = tables.patches[patch].material;
            if (tables.lod.runs.empty() || tables.lod.runs.back().patchClass != range.patchClass ||
                tables.lod.runs.back().material != material) {
                tables.lod.runs.push_back({range.patchClass, material, 0});
            }
            ++tables.lod.runs.back().patchCount;
            std::array<uint32_t, kMaxSides> own{};
            const std::vector<Border> sideBorders = borders(tables, element, range.patchClass);
            for (size_t e = 0; e < sideBorders.size(); ++e) {
                const std::vector<uint32_t>& key = std::min(sideBorders[e].words, sideBorders[e].reversed);
                const auto [found, fresh] = edges.try_emplace(key, static_cast<uint32_t>(edges.size()));
                if (fresh) {
                    edgeWords.insert(edgeWords.end(), key.begin(), key.end());
                }
                own[e] = found->second;
            }
            const auto run = static_cast<uint32_t>(tables.lod.runs.size() - 1);
            patches.insert(patches.end(), {own[0], own[1], own[2], own[3], own[4], run, element,
                                           static_cast<uint32_t>(range.patchClass)});
        }
    }
    TableWriter writer(tables.words);
    tables.lod.edges = {writer.element(), static_cast<uint32_t>(edges.size())};
    tables.words.insert(tables.words.end(), edgeWords.begin(), edgeWords.end());
    tables.lod.patches = {writer.element(), static_cast<uint32_t>(tables.patches.size())};
    tables.words.insert(tables.words.end(), patches.begin(), patches.end());
}

} // namespace supple::surface::lod
