#include "tools/bench/opensubdiv_tables.h"

#include "tools/bench/opensubdiv_refiner.h"

#include <algorithm>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/stencilTableFactory.h>

namespace supple::bench {

using namespace OpenSubdiv;

namespace {

/// The points of a domain.
struct Grid {
    std::vector<float> s, t;

    Grid(uint32_t rate, bool triangle) {
        for (uint32_t j = 0; j <= rate; ++j) {
            for (uint32_t i = 0; i <= (triangle ? rate - j : rate); ++i) {
                s.push_back(static_cast<float>(i) / static_cast<float>(rate));
                t.push_back(static_cast<float>(j) / static_cast<float>(rate));
            }
        }
    }
};

/// A face of OpenSubdiv's own, ptex face as it calls it: a quad, a triangle of Loop's, or a corner of any other.
struct Domain {
    uint32_t face = 0; ///< of the cage
    int ptex = 0;
    const Grid* grid = nullptr;
};

std::vector<Domain> domainsOf(const cage::Cage& cage, const Far::TopologyRefiner& refiner, const Grid& whole,
                              const Grid& corner) {
    const Far::PtexIndices ptex(refiner);
    const bool triangles = refiner.GetSchemeType() == Sdc::SCHEME_LOOP;
    std::vector<Domain> domains;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (std::binary_search(cage.holes.begin(), cage.holes.end(), f)) {
            continue;
        }
        const int first = ptex.GetFaceId(static_cast<int>(f));
        if (triangles || cage.sides(f) == 4) {
            domains.push_back({f, first, &whole});
            continue;
        }
        for (uint32_t k = 0; k < cage.sides(f); ++k) {
            domains.push_back({f, first + static_cast<int>(k), &corner});
        }
    }
    return domains;
}

void refine(Far::TopologyRefiner& refiner, OpensubdivTables& tables) {
    Far::PatchTableFactory::Options patchOptions(kOpensubdivLevel);
    patchOptions.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    refiner.RefineAdaptive(patchOptions.GetRefineAdaptiveOptions());
    tables.patches.reset(Far::PatchTableFactory::Create(refiner, patchOptions));

    Far::StencilTableFactory::Options stencilOptions;
    stencilOptions.generateIntermediateLevels = true;
    stencilOptions.generateOffsets = true;
    std::unique_ptr<const Far::StencilTable> levels(Far::StencilTableFactory::Create(refiner, stencilOptions));
    const Far::StencilTable* local = tables.patches->GetLocalPointStencilTable();
    tables.refinement = std::move(levels);
    if (local != nullptr && local->GetNumStencils() > 0) {
        tables.refinement.reset(
            Far::StencilTableFactory::AppendLocalPointStencilTable(refiner, tables.refinement.get(), local));
    }
}

Status placePoints(const Far::TopologyRefiner& refiner, std::span<const Domain> domains, OpensubdivTables& tables) {
    Far::LimitStencilTableFactory::LocationArrayVec locations(domains.size());
    const Far::PatchMap map(*tables.patches);
    auto faces = std::make_shared<std::vector<uint32_t>>();
    for (size_t d = 0; d < domains.size(); ++d) {
        const Domain& domain = domains[d];
        const std::vector<float>&s = domain.grid->s, &t = domain.grid->t;
        locations[d].ptexIdx = domain.ptex;
        locations[d].numLocations = static_cast<int>(s.size());
        locations[d].s = s.data();
        locations[d].t = t.data();
        for (size_t k = 0; k < s.size(); ++k) {
            const Far::PatchTable::PatchHandle* handle = map.FindPatch(domain.ptex, s[k], t[k]);
            if (handle == nullptr) {
                return Error{ErrorCode::asset, "OpenSubdiv has no patch for face " + std::to_string(domain.face)};
            }
            tables.coordinates.emplace_back(*handle, s[k], t[k]);
            faces->push_back(domain.face);
        }
    }
    tables.faces = std::move(faces);
    tables.limitStencils.reset(Far::LimitStencilTableFactory::Create(refiner, locations));
    if (tables.limitStencils == nullptr ||
        static_cast<size_t>(tables.limitStencils->GetNumStencils()) != tables.points()) {
        return Error{ErrorCode::asset, "OpenSubdiv makes no limit stencils of the cage"};
    }
    return success();
}

} // namespace

Result<std::unique_ptr<OpensubdivTables>> opensubdivTables(const cage::Cage& cage, PeerRules rules, uint32_t rate) {
    const bool loop = rules == PeerRules::loop;
    for (uint32_t f = 0; loop && f < cage.faceCount(); ++f) {
        if (cage.sides(f) != 3) {
            return Error{ErrorCode::asset, "face " + std::to_string(f) + " is no triangle"};
        }
    }
    const std::unique_ptr<Far::TopologyRefiner> refiner =
        opensubdivRefiner(cage, loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK);
    if (refiner == nullptr) {
        return Error{ErrorCode::asset, "the cage is refused"};
    }
    const Grid whole(rate, loop), corner(std::max(rate / 2, 1u), false);
    const std::vector<Domain> domains = domainsOf(cage, *refiner, whole, corner);
    size_t points = 0;
    for (const Domain& domain : domains) {
        points += domain.grid->s.size();
    }
    if (points > kMostPeerPoints) {
        return Error{ErrorCode::limit, std::to_string(points) + " points at rate " + std::to_string(rate) +
                                           " are more than " + std::to_string(kMostPeerPoints)};
    }
    auto tables = std::make_unique<OpensubdivTables>();
    tables->rules = rules;
    for (const glm::vec3& p : cage.positions) {
        tables->cage.insert(tables->cage.end(), {p.x, p.y, p.z});
    }
    refine(*refiner, *tables);
    const Status placed = placePoints(*refiner, domains, *tables);
    return placed ? Result<std::unique_ptr<OpensubdivTables>>(std::move(tables)) : placed.error();
}

} // namespace supple::bench
