#include "tools/bench/opensubdiv_cpu_peer.h"

#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuPatchTable.h>

namespace supple::bench {

using namespace OpenSubdiv;

namespace {

struct CpuOutput {
    explicit CpuOutput(size_t points) : position(3 * points), du(3 * points), dv(3 * points) {}
    std::vector<float> position, du, dv;
};

Status outcome(bool done) {
    return done ? success() : Status(Error{ErrorCode::asset, "OpenSubdiv's CpuEvaluator failed"});
}

Peer limitStencils(const std::shared_ptr<const OpensubdivTables>& tables) {
    const auto out = std::make_shared<CpuOutput>(tables->points());
    const auto run = [tables, out] {
        const Far::LimitStencilTable& stencils = *tables->limitStencils;
        return outcome(Osd::CpuEvaluator::EvalStencils(
            tables->cage.data(), kXyz, out->position.data(), kXyz, out->du.data(), kXyz, out->dv.data(), kXyz,
            stencils.GetSizes().data(), stencils.GetOffsets().data(), stencils.GetControlIndices().data(),
            stencils.GetWeights().data(), stencils.GetDuWeights().data(), stencils.GetDvWeights().data(), 0,
            stencils.GetNumStencils()));
    };
    return {peerName(tables->rules) + " CPU, limit stencils",
            tables->rules,
            tables->points(),
            run,
            nullptr,
            [out] { return out->position; },
            tables->faces};
}

Peer patches(const std::shared_ptr<const OpensubdivTables>& tables) {
    const auto out = std::make_shared<CpuOutput>(tables->points());
    const auto patchTable = std::make_shared<Osd::CpuPatchTable>(tables->patches.get());
    // The cage's points, then the refined ones.
    const auto points = std::make_shared<std::vector<float>>(tables->cage);
    points->resize(points->size() + 3 * static_cast<size_t>(tables->refinement->GetNumStencils()));
    const Osd::BufferDescriptor refined(static_cast<int>(tables->cage.size()), 3, 3);
    const auto run = [tables, out, patchTable, points, refined] {
        const Far::StencilTable& stencils = *tables->refinement;
        const bool done = Osd::CpuEvaluator::EvalStencils(
            points->data(), kXyz, points->data(), refined, stencils.GetSizes().data(), stencils.GetOffsets().data(),
            stencils.GetControlIndices().data(), stencils.GetWeights().data(), 0, stencils.GetNumStencils());
        return outcome(done && Osd::CpuEvaluator::EvalPatches(
                                   points->data(), kXyz, out->position.data(), kXyz, out->du.data(), kXyz,
                                   out->dv.data(), kXyz, static_cast<int>(tables->points()), tables->coordinates.data(),
                                   patchTable->GetPatchArrayBuffer(), patchTable->GetPatchIndexBuffer(),
                                   patchTable->GetPatchParamBuffer()));
    };
    return {peerName(tables->rules) + " CPU, patches", tables->rules, tables->points(), run, nullptr,
            [out] { return out->position; },           tables->faces};
}

} // namespace

std::vector<Peer> opensubdivCpuPeers(const std::shared_ptr<const OpensubdivTables>& tables) {
    return {limitStencils(tables), patches(tables)};
}

} // namespace supple::bench
