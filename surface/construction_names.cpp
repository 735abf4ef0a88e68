#include "surface/construction_names.h"

#include "shaders/shared/chains.h"
#include "shaders/shared/pm.h"
#include "shaders/shared/polygons.h"
#include "shaders/shared/subdivision.h"
#include "shaders/shared/surface.h"

#include <algorithm>
#include <iterator>

namespace supple::surface {

namespace {

struct Row {
    KindOfKernel kernel;
    const char* name = "";
};

constexpr Row kRows[] = {
    {{Kernel::prepVertex, shared::kRegularFan}, "supple p-rep vertex, regular"},
    {{Kernel::prepVertex, shared::kFewFan}, "supple p-rep vertex"},
    {{Kernel::prepVertex, shared::kManyFan}, "supple p-rep vertex, many spokes"},
    {{Kernel::prepEdge, 0}, "supple p-rep edge"},
    {{Kernel::prepVertexFanRecords, shared::kRegularFan}, "supple p-rep fan record, regular"},
    {{Kernel::prepVertexFanRecords, shared::kFewFan}, "supple p-rep fan record"},
    {{Kernel::prepVertexFanRecords, shared::kManyFan}, "supple p-rep fan record, many spokes"},
    {{Kernel::prepEdgeFanRecords, 0}, "supple p-rep edge from fan records"},
    {{Kernel::pmVertex, shared::kRegularFan}, "supple P_m vertex, regular"},
    {{Kernel::pmVertex, shared::kFewFan}, "supple P_m vertex"},
    {{Kernel::pmVertex, shared::kManyFan}, "supple P_m vertex, many spokes"},
    {{Kernel::pmVertex, shared::kCreasedFan}, "supple P_m vertex, creased"},
    {{Kernel::pmVertex, shared::kVariableFan}, "supple P_m vertex, with crease sets"},
    {{Kernel::pmFacet, shared::kPolarPatch}, "supple P_m facet, polar"},
    {{Kernel::pmFacet, shared::kP3Patch}, "supple P_m facet, triangle"},
    {{Kernel::pmFacet, shared::kP4Patch}, "supple P_m facet, quad"},
    {{Kernel::pmFacet, shared::kP5Patch}, "supple P_m facet, pentagon"},
    {{Kernel::chainsVertex, shared::kRegularFan}, "supple exact vertex, regular"},
    {{Kernel::chainsVertex, shared::kPointsFan}, "supple exact vertex, regular, with points"},
    {{Kernel::chainsVertex, shared::kFewFan}, "supple exact vertex, creased"},
    {{Kernel::chainsVertexMeshInPool, shared::kRegularFan}, "supple exact vertex of a step, regular"},
    {{Kernel::chainsVertexMeshInPool, shared::kPointsFan}, "supple exact vertex of a step, regular, with points"},
    {{Kernel::chainsVertexMeshInPool, shared::kFewFan}, "supple exact vertex of a step, creased"},
    {{Kernel::chainsChain, shared::kMakesLimits}, "supple exact limits"},
    {{Kernel::chainsChain, shared::kMakesFirstLevel}, "supple exact chains, first level"},
    {{Kernel::chainsChain, shared::kMakesLevel}, "supple exact chains, level"},
    {{Kernel::chainsChain, shared::kMakesChains}, "supple exact chains"},
    {{Kernel::chainsChainLevels, shared::kMakesLevel}, "supple exact chains, level where it is asked for"},
    {{Kernel::chainsChainTriangles, shared::kMakesLimits}, "supple Loop limits"},
    {{Kernel::chainsChainTriangles, shared::kMakesFirstLevel}, "supple Loop chains, first level"},
    {{Kernel::chainsChainTriangles, shared::kMakesLevel}, "supple Loop chains, level"},
    {{Kernel::chainsChainTriangles, shared::kMakesChains}, "supple Loop chains"},
    {{Kernel::chainsChainLevelsTriangles, shared::kMakesLevel}, "supple Loop chains, level where it is asked for"},
    {{Kernel::subdivisionIsolate, shared::kHalfWords}, "supple subdivision, isolate"},
    {{Kernel::subdivisionIsolate, shared::kWholeWords}, "supple subdivision, isolate a large cage"},
    {{Kernel::subdivisionIsolateMeshInPool, shared::kHalfWords}, "supple subdivision, isolate once more"},
    {{Kernel::subdivisionIsolateMeshInPool, shared::kWholeWords}, "supple subdivision, isolate a large cage once more"},
    {{Kernel::blendChart, 0}, "supple blend, chart"},
    {{Kernel::blendChartMeshInPool, 0}, "supple blend, chart of a subdivided cage"},
    {{Kernel::polygonsFace, shared::kShortFaces}, "supple polygons, faces"},
    {{Kernel::polygonsFace, shared::kLongFaces}, "supple polygons, long faces"},
    {{Kernel::polygonsFrame, 0}, "supple polygons, frames"},
};

} // namespace

const char* constructionName(const KindOfKernel& kernel) {
    const auto* row =
        std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& own) { return own.kernel == kernel; });
    return row != std::end(kRows) ? row->name : nameOf(kernel.kernel);
}

} // namespace supple::surface
