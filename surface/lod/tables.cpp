#include "surface/lod/tables.h"

#include "surface/patch_records.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>

namespace supple::surface::lod {

namespace {

using Words = std::vector<uint32_t>;

/// By patch: the element of its record.
std::vector<uint32_t> recordsOf(const Tables& tables) {
    std::vector<uint32_t> records;
    records.reserve(tables.patches.size());
    for (const PatchRange& range : tables.ranges) {
        const uint32_t elements = recordElements(tables, range.patchClass);
        for (uint32_t p = 0; p < range.section.count; ++p) {
            records.push_back(range.section.table + p * elements);
        }
    }
    return records;
}

/// What the tables have of an edge. The two patches at a cubic write it from opposite ends: it is the smaller of both.
void writeEdge(const PatchSide& side, uint32_t record, uint32_t number, TableWriter& writer) {
    const CubicIndices& curve = side.curve;
    switch (side.borders) {
    case Borders::cubics:
        writer.put(std::min(curve, CubicIndices{curve[3], curve[2], curve[1], curve[0]}));
        return;
    case Borders::charts:
        writer.put(std::min(curve, side.across));
        writer.put(std::max(curve, side.across));
        return;
    default:
        writer.put({record, number, 0u, 0u});
    }
}

/// Numbers edges kind by kind, in the order in which patches come to them, and appends their elements to the tables.
/// Returns the numbers by PatchSide::edge.
Words writeEdges(const PatchEdges& edges, const std::vector<uint32_t>& records, Tables& tables) {
    TableWriter writer(tables.words);
    Words numbers(edges.edgeBound(), cage::kNone);
    for (const Borders kind : {Borders::cubics, Borders::halves, Borders::splines, Borders::splineHalves,
                               Borders::sharpHalves, Borders::charts}) {
        const uint32_t first = tables.lod.edgeCount, element = writer.element();
        for (uint32_t patch = 0; patch < records.size(); ++patch) {
            const std::span<const PatchSide> sides = edges.sidesOf(patch);
            for (uint32_t i = 0; i < sides.size(); ++i) {
                if (uint32_t& number = numbers[sides[i].edge]; sides[i].borders == kind && number == cage::kNone) {
                    number = tables.lod.edgeCount++;
                    writeEdge(sides[i], records[patch], i, writer);
                }
            }
        }
        if (tables.lod.edgeCount > first) {
            tables.lod.edges.push_back({kind, first, {element, tables.lod.edgeCount - first}});
        }
    }
    return numbers;
}

} // namespace

void appendTables(const PatchEdges& edges, Tables& tables) {
    const std::vector<uint32_t> records = recordsOf(tables);
    const Words numbers = writeEdges(edges, records, tables);
    TableWriter writer(tables.words);
    tables.lod.patches = {writer.element(), static_cast<uint32_t>(tables.patches.size())};
    writer.reserve(size_t{8} * tables.patches.size());
    for (uint32_t patch = 0; patch < tables.patches.size(); ++patch) {
        const PatchInfo& info = tables.patches[patch];
        tables.lod.borders = std::max(tables.lod.borders, rowOf(info.patchClass).borders);
        if (tables.lod.runs.empty() || tables.lod.runs.back().patchClass != info.patchClass ||
            tables.lod.runs.back().material != info.material) {
            tables.lod.runs.push_back({info.patchClass, info.material, 0});
        }
        ++tables.lod.runs.back().patchCount;
        std::array<uint32_t, kMaxSides> own{};
        std::transform(edges.sidesOf(patch).begin(), edges.sidesOf(patch).end(), own.begin(),
                       [&](const PatchSide& side) { return numbers[side.edge]; });
        const auto run = static_cast<uint32_t>(tables.lod.runs.size() - 1);
        const uint32_t kind = static_cast<uint32_t>(info.patchClass) | info.part << shared::kLodPartShift;
        writer.put({own[0], own[1], own[2], own[3], own[4], run, records[patch], kind});
    }
}

} // namespace supple::surface::lod
