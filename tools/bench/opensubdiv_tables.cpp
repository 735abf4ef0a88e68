#include "tools/bench/opensubdiv_tables.h"

#include "tools/bench/opensubdiv_refiner.h"

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/stencilTableFactory.h>

namespace supple::bench {

using namespace OpenSubdiv;

Result<std::unique_ptr<OpensubdivTables>> opensubdivTables(const cage::Cage& cage, uint32_t rate) {
    const std::unique_ptr<Far::TopologyRefiner> refiner = opensubdivRefiner(cage, Sdc::SCHEME_CATMARK);
    if (refiner == nullptr) {
        return Error{ErrorCode::asset, "OpenSubdiv refuses the cage"};
    }
    auto tables = std::make_unique<OpensubdivTables>();
    for (const glm::vec3& p : cage.positions) {
        tables->cage.insert(tables->cage.end(), {p.x, p.y, p.z});
    }

    Far::PatchTableFactory::Options patchOptions(kOpensubdivLevel);
    patchOptions.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    refiner->RefineAdaptive(patchOptions.GetRefineAdaptiveOptions());
    tables->patches.reset(Far::PatchTableFactory::Create(*refiner, patchOptions));

    Far::StencilTableFactory::Options stencilOptions;
    stencilOptions.generateIntermediateLevels = true;
    stencilOptions.generateOffsets = true;
    std::unique_ptr<const Far::StencilTable> levels(Far::StencilTableFactory::Create(*refiner, stencilOptions));
    const Far::StencilTable* local = tables->patches->GetLocalPointStencilTable();
    tables->refinement = std::move(levels);
    if (local != nullptr && local->GetNumStencils() > 0) {
        tables->refinement.reset(
            Far::StencilTableFactory::AppendLocalPointStencilTable(*refiner, tables->refinement.get(), local));
    }

    std::vector<float> s, t;
    for (uint32_t j = 0; j <= rate; ++j) {
        for (uint32_t i = 0; i <= rate; ++i) {
            s.push_back(static_cast<float>(i) / static_cast<float>(rate));
            t.push_back(static_cast<float>(j) / static_cast<float>(rate));
        }
    }
    Far::LimitStencilTableFactory::LocationArrayVec locations(cage.faceCount());
    const Far::PatchMap map(*tables->patches);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        locations[f].ptexIdx = static_cast<int>(f); // a quad is one ptex face
        locations[f].numLocations = static_cast<int>(s.size());
        locations[f].s = s.data();
        locations[f].t = t.data();
        for (size_t k = 0; k < s.size(); ++k) {
            const Far::PatchTable::PatchHandle* handle = map.FindPatch(static_cast<int>(f), s[k], t[k]);
            if (handle == nullptr) {
                return Error{ErrorCode::asset, "OpenSubdiv has no patch for face " + std::to_string(f)};
            }
            tables->coordinates.emplace_back(*handle, s[k], t[k]);
        }
    }
    tables->limitStencils.reset(Far::LimitStencilTableFactory::Create(*refiner, locations));
    if (tables->limitStencils == nullptr ||
        static_cast<size_t>(tables->limitStencils->GetNumStencils()) != tables->points()) {
        return Error{ErrorCode::asset, "OpenSubdiv makes no limit stencils of the cage"};
    }
    return tables;
}

} // namespace supple::bench
