#include "surface/table_header.h"

#include "shaders/shared/lod.h"

#include <algorithm>
#include <bit>

namespace supple::surface {

namespace {

constexpr uint32_t kScratchPadding = 16; ///< elements: instances start on 256 bytes

} // namespace

uint32_t depthWords(const LodTables& tables) {
    return tables.edgeCount + shared::kLodPatchLevelWords * tables.patches.count;
}

uint32_t scratchStride(const Tables& tables) {
    if (tables.lod.edges.empty()) {
        return tables.fragments.scratchStride;
    }
    const uint32_t words = depthWords(tables.lod) + (tables.lod.depth > 0 ? shared::kDepthWords : 0);
    return ((words + 3) / 4 + kScratchPadding - 1) / kScratchPadding * kScratchPadding;
}

std::array<uint32_t, shared::kTableHeaderWords> headerOf(const Tables& tables) {
    const LodTables& lod = tables.lod;
    shared::TableHeader header{};
    header.words = static_cast<uint32_t>(tables.words.size());
    header.cageStride = tables.cageStride;
    header.patchCount = static_cast<uint32_t>(tables.patches.size());
    header.poolStride = tables.poolStride;
    header.meshVertices = tables.meshVertices;
    header.tangents = tables.tangents;
    header.faces = tables.faces;
    header.inner = tables.inner;
    header.frames = tables.frames;
    header.depth = lod.depth;
    header.ring = tables.ring;
    header.edgeClasses = tables.edgeClasses;
    header.coordinates = tables.coordinates;
    header.directions = tables.triangles.directions;
    header.attributes = tables.attributes;
    header.attributeHalves = tables.attributeHalves ? 1 : 0;
    header.uvSets = tables.uvSets;
    header.faceUvs = tables.faceUvs ? 1 : 0;
    header.levelPatches = lod.patches.table;
    header.depthLanes = lod.depthLanes;
    header.runCount = static_cast<uint32_t>(lod.runs.size());
    header.edgeCount = lod.edgeCount;
    header.scratchStride = scratchStride(tables);
    header.depths = lod.depth == 0 ? 0 : depthWords(lod);
    static_assert(sizeof(header) == sizeof(uint32_t) * shared::kTableHeaderWords);
    return std::bit_cast<std::array<uint32_t, shared::kTableHeaderWords>>(header);
}

void writeHeader(Tables& tables) {
    const auto header = headerOf(tables);
    std::copy(header.begin(), header.end(), tables.words.begin());
}

} // namespace supple::surface
