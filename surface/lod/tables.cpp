#include "surface/lod/tables.h"

#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <map>

namespace supple::surface::lod {

namespace {

/// End, its tangent, the other end's tangent, other end: pool indices.
using Curve = std::array<uint32_t, 4>;

uint32_t recordElements(const Tables& tables, PatchClass patchClass) {
    switch (patchClass) {
    case PatchClass::regular:
    case PatchClass::polar:
        return tables.cornerNormals ? 5 : 4;
    case PatchClass::perturbed:
        return tables.cornerNormals ? 9 : 8;
    default:
        return sides(formOf(patchClass));
    }
}

/// Border curves by side of the grid.
std::vector<Curve> borders(const uint32_t* record, Form form) {
    if (form == Form::quad) {
        const auto g = [&](uint32_t i, uint32_t j) { return record[4 * j + i]; };
        return {{g(0, 0), g(1, 0), g(2, 0), g(3, 0)},
                {g(3, 0), g(3, 1), g(3, 2), g(3, 3)},
                {g(3, 3), g(2, 3), g(1, 3), g(0, 3)},
                {g(0, 3), g(0, 2), g(0, 1), g(0, 0)}};
    }
    std::vector<Curve> curves;
    for (uint32_t i = 0; i < sides(form); ++i) {
        const uint32_t* corner = record + size_t{4} * i;
        const uint32_t* next = record + size_t{4} * ((i + 1) % sides(form));
        curves.push_back({corner[0], corner[1], corner[2], next[0]});
    }
    return curves;
}

} // namespace

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
    std::map<Curve, uint32_t> edges;
    std::vector<Curve> order;
    std::vector<uint32_t> patches;
    for (const PatchRange& range : tables.ranges) {
        const Form form = formOf(range.patchClass);
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
            const std::vector<Curve> curves = borders(&tables.words[size_t{4} * element], form);
            for (size_t e = 0; e < curves.size(); ++e) {
                const Curve& curve = curves[e];
                const Curve key = std::min(curve, Curve{curve[3], curve[2], curve[1], curve[0]});
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
    for (const Curve& curve : order) {
        writer.put({curve[0], curve[1], curve[2], curve[3]});
    }
    tables.lod.patches = {writer.element(), static_cast<uint32_t>(tables.patches.size())};
    tables.words.insert(tables.words.end(), patches.begin(), patches.end());
}

} // namespace supple::surface::lod
