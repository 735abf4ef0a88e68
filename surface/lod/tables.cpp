#include "surface/lod/tables.h"

#include "surface/borders.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <map>

namespace supple::surface::lod {

Form formOf(PatchClass patchClass) {
    switch (patchClass) {
    case PatchClass::p3:
        return Form::triangleRings;
    case PatchClass::p4:
        return Form::quadRings;
    case PatchClass::p5:
        return Form::pentagonRings;
    default:
        return Form::quad;
    }
}

void appendTables(Tables& tables) {
    std::map<BorderCurve, uint32_t> edges;
    std::vector<BorderCurve> order;
    std::vector<uint32_t> patches;
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
            const std::vector<BorderCurve> curves = borderCurves(&tables.words[size_t{4} * element], range.patchClass);
            for (size_t e = 0; e < curves.size(); ++e) {
                const BorderCurve& curve = curves[e];
                const BorderCurve key = std::min(curve, BorderCurve{curve[3], curve[2], curve[1], curve[0]});
                const auto [found, fresh] = edges.try_emplace(key, static_cast<uint32_t>(order.size()));
                if (fresh) {
                    order.push_back(key);
                }
                own[e] = found->second;
            }
            const auto run = static_cast<uint32_t>(tables.lod.runs.size() - 1);
            patches.insert(patches.end(), {own[0], own[1], own[2], own[3], own[4], run, element,
                                           static_cast<uint32_t>(range.patchClass)});
        }
    }
    TableWriter writer(tables.words);
    tables.lod.edges = {writer.element(), static_cast<uint32_t>(order.size())};
    for (const BorderCurve& curve : order) {
        writer.put({curve[0], curve[1], curve[2], curve[3]});
    }
    tables.lod.patches = {writer.element(), static_cast<uint32_t>(tables.patches.size())};
    tables.words.insert(tables.words.end(), patches.begin(), patches.end());
}

} // namespace supple::surface::lod
