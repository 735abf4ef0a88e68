#include "surface/pm/scheme.h"

#include "shaders/shared/pm.h"
#include "surface/borders.h"
#include "surface/pm/weights.h"
#include "surface/table_writer.h"
#include "surface/valence.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace supple::surface::pm {

namespace {

constexpr uint32_t kRingWords = 3;

PatchClass patchClassOf(FacetClass facetClass) {
    constexpr PatchClass kClasses[] = {PatchClass::regular, PatchClass::polar, PatchClass::p3, PatchClass::p4,
                                       PatchClass::p5};
    return kClasses[static_cast<size_t>(facetClass)];
}

Kernel sectorKernel(const Sector& sector) {
    if (sector.creased || sector.pinned) {
        return Kernel::pmVertexCreased;
    }
    return sector.closed() && sector.facets == 4 ? Kernel::pmVertexRegular : Kernel::pmVertex;
}

class Builder {
public:
    explicit Builder(const Mesh& mesh) : mesh_(mesh), cage_(mesh.cage), writer_(tables_.words) {}

    Tables build() {
        tables_.notes = mesh_.notes;
        sortedPatches();
        layOutPool();
        writeRing();
        writeSectors();
        writeFacets();
        writePatches();
        finishTables(cage_, patches_, writer_, tables_);
        return std::move(tables_);
    }

private:
    [[nodiscard]] const FacetCorner& corner(const DraftPatch& patch, uint32_t i) const {
        return mesh_.corners[patch.cageCorners[i % patch.info.cornerCount]];
    }
    [[nodiscard]] uint32_t tangent(uint32_t slot) const { return tables_.tangents + slot; }
    [[nodiscard]] uint32_t face(uint32_t slot) const { return tables_.faces + slot; }

    void sortedPatches() {
        for (uint32_t f = 0; f < cage_.faceCount(); ++f) {
            if (std::binary_search(cage_.holes.begin(), cage_.holes.end(), f)) {
                continue;
            }
            DraftPatch& patch = patches_.emplace_back();
            patch.facet = f;
            patch.material = cage_.faceMaterials.empty() ? cage::kNone : cage_.faceMaterials[f];
            patch.info.face = mesh_.sourceFaces[f];
            patch.info.patchClass = patchClassOf(mesh_.classes[f]);
            patch.info.cornerCount = cage_.sides(f);
            for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
                const uint32_t c = mesh_.corner(f, i);
                patch.cageCorners[i] = c;
                patch.info.corners[i] = cage_.faceVertices[c];
            }
        }
        sortPatches(patches_);
    }

    /// v, t, f, then what the facet stage adds, patch by patch.
    void layOutPool() {
        const auto slots = static_cast<uint32_t>(mesh_.slotSpokes.size());
        tables_.tangents = static_cast<uint32_t>(mesh_.sectors.size());
        tables_.faces = tables_.tangents + slots;
        uint32_t next = tables_.faces + slots;
        for (const DraftPatch& patch : patches_) {
            inner_.push_back(next);
            next += patch.info.patchClass == PatchClass::regular ? 0
                    : patch.info.patchClass == PatchClass::polar ? 2
                                                                 : 1 + 3 * patch.info.cornerCount;
        }
        tables_.poolStride = (next + 15) / 16 * 16;
    }

    void writeRing() {
        tables_.ring = 4 * writer_.element();
        for (const Sector& sector : mesh_.sectors) {
            for (uint32_t j = 0; j < sector.edges(); ++j) {
                const uint32_t spoke = mesh_.slotSpokes[sector.firstSlot + j];
                uint32_t far[2] = {sector.vertex, sector.vertex};
                if (j < sector.facets) {
                    const uint32_t c = mesh_.topology.sectorCorners[spoke];
                    const uint32_t f = mesh_.topology.cornerFaces[c], first = cage_.faceStarts[f], m = cage_.sides(f);
                    const auto at = [&](uint32_t steps) { return cage_.faceVertices[first + (c - first + steps) % m]; };
                    far[0] = at(2);
                    far[1] = at(m - 2);
                }
                writer_.put({mesh_.topology.spokeVertices[spoke], far[0], far[1]});
            }
        }
    }

    uint32_t writeSmoothWeights(const Sector& sector) {
        const SectorWeights w = makeSectorWeights(sector.kind, sector.facets);
        const uint32_t element = writer_.element();
        writer_.put({sector.facets | (sector.closed() ? 0u : shared::kOpenSector), 0u, 0u, 0u});
        for (uint32_t j = 0; j < sector.edges(); ++j) {
            const bool facet = j < sector.facets;
            const auto [cosine, sine] = turn(j, sector.valence());
            writer_.put({floatBits(w.limitEdge[j]), floatBits(facet ? w.limitFace[j] : 0.0), floatBits(w.tau1Edge[j]),
                         floatBits(facet ? w.tau1Face[j] : 0.0), floatBits(w.tau2Edge[j]),
                         floatBits(facet ? w.tau2Face[j] : 0.0), floatBits(cosine), floatBits(sine)});
        }
        return element;
    }

    uint32_t writeCreasedWeights(const Sector& sector) {
        const SectorScales scales = sectorScales(sector.kind, sector.facets);
        const uint32_t element = writer_.element();
        writer_.put({sector.facets | (sector.closed() ? 0u : shared::kOpenSector) |
                         (sector.kind == SectorKind::corner ? shared::kCornerSector : 0u) |
                         (sector.pinned ? shared::kPinnedSector : 0u),
                     floatBits(scales.limit), floatBits(scales.tangent), 0u});
        for (uint32_t j = 0; j < sector.edges(); ++j) {
            const auto [cosine, sine] = turn(j, sector.valence());
            writer_.put({floatBits(mesh_.slotAlphas[sector.firstSlot + j]), floatBits(cosine), floatBits(sine), 0u});
        }
        return element;
    }

    void writeSectors() {
        std::vector<uint32_t> weights(mesh_.sectors.size(), 0);
        std::map<std::pair<SectorKind, uint32_t>, uint32_t> smooth;
        std::vector<uint32_t> order(mesh_.sectors.size());
        for (uint32_t s = 0; s < order.size(); ++s) {
            order[s] = s;
            const Sector& sector = mesh_.sectors[s];
            if (sectorKernel(sector) == Kernel::pmVertexCreased) {
                weights[s] = writeCreasedWeights(sector);
            } else if (sectorKernel(sector) == Kernel::pmVertex) {
                const auto [known, isNew] = smooth.try_emplace({sector.kind, sector.facets}, 0u);
                if (isNew) {
                    known->second = writeSmoothWeights(sector);
                }
                weights[s] = known->second;
            }
        }
        // By kernel, then by size, so that neighbouring lanes loop equally long.
        const auto rank = [&](uint32_t s) {
            return std::tuple(sectorKernel(mesh_.sectors[s]), mesh_.sectors[s].edges(), mesh_.sectors[s].kind, s);
        };
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
        uint32_t element = writer_.element();
        for (uint32_t s : order) {
            const Sector& sector = mesh_.sectors[s];
            addRecord(Stage::vertex, sectorKernel(sector), element, 1 + sector.edges() + sector.facets);
            writer_.put({sector.vertex, sector.firstSlot, weights[s], s});
            ++element;
        }
    }

    /// Counts the record that begins at `element` towards its kernel's section.
    void addRecord(Stage stage, Kernel kernel, uint32_t element, uint32_t coefficients) {
        if (tables_.constructions.empty() || tables_.constructions.back().kernel != kernel) {
            tables_.constructions.push_back({stage, kernel, {element, 0}, 0});
        }
        ++tables_.constructions.back().section.count;
        tables_.constructions.back().coefficients += coefficients;
    }

    [[nodiscard]] EdgeClass edgeClass(const DraftPatch& patch, uint32_t i) const {
        const FacetCorner &a = corner(patch, i), &b = corner(patch, i + 1);
        return {patch.info.cornerCount,
                {mesh_.sectors[a.sector].valence(), mesh_.sectors[b.sector].valence()},
                mesh_.edgeCut[mesh_.topology.cornerEdges[patch.cageCorners[i]]] != 0,
                {a.across == cage::kNone, b.acrossBack == cage::kNone}};
    }

    void writeFacets() {
        std::map<EdgeClass, uint32_t> edgeClasses;
        for (const DraftPatch& patch : patches_) {
            for (uint32_t i = 0; patch.info.patchClass >= PatchClass::p3 && i < patch.info.cornerCount; ++i) {
                const auto [known, isNew] = edgeClasses.try_emplace(edgeClass(patch, i), 0u);
                if (isNew) {
                    const EdgeFactors f = makeEdgeFactors(known->first);
                    known->second = writer_.element();
                    writer_.put({floatBits(f.along[0]), floatBits(f.own[0]), floatBits(f.across[0]),
                                 floatBits(f.across[1]), floatBits(f.along[1]), floatBits(f.own[1]), 0u, 0u});
                }
            }
        }
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            if (patch.info.patchClass == PatchClass::regular) {
                continue;
            }
            const uint32_t element = writer_.element();
            if (patch.info.patchClass == PatchClass::polar) {
                addRecord(Stage::edge, Kernel::pmPolar, element, 2);
                const FacetCorner& apex = corner(patch, 2);
                const double c = turn(1, mesh_.sectors[apex.sector].valence()).first;
                writer_.put({apex.sector, tangent(apex.slot), tangent(apex.slotBack), inner_[p], floatBits(c),
                             floatBits(1.5 * mesh_.slotAlphas[apex.slot]),
                             floatBits(1.5 * mesh_.slotAlphas[apex.slotBack]), 0u});
                continue;
            }
            constexpr Kernel kKernels[] = {Kernel::pmFacet3, Kernel::pmFacet4, Kernel::pmFacet5};
            addRecord(Stage::edge, kKernels[patch.info.cornerCount - 3], element, 1 + 3 * patch.info.cornerCount);
            for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
                const FacetCorner& c = corner(patch, i);
                writer_.put({c.sector, tangent(c.slot), tangent(c.slotBack), face(c.slot),
                             c.across == cage::kNone ? tangent(c.slot) : face(c.across),
                             c.acrossBack == cage::kNone ? tangent(c.slotBack) : face(c.acrossBack),
                             edgeClasses.at(edgeClass(patch, i)), inner_[p]});
            }
        }
    }

    void writePatches() {
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            const PatchClass patchClass = patch.info.patchClass;
            if (tables_.ranges.empty() || tables_.ranges.back().patchClass != patchClass) {
                tables_.ranges.push_back({patchClass, {writer_.element(), 0}, p, 0});
            }
            ++tables_.ranges.back().section.count;
            const auto v = [&](uint32_t i) { return corner(patch, i).sector; };
            const auto t0 = [&](uint32_t i) { return tangent(corner(patch, i).slot); };
            const auto t1 = [&](uint32_t i) { return tangent(corner(patch, i).slotBack); };
            if (patchClass <= PatchClass::polar) {
                for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
                    const FacetCorner& c = corner(patch, i);
                    writer_.put({c.sector, spokeWord(c.slot, c.slotBack)});
                }
                if (patchClass == PatchClass::polar) {
                    writer_.put({inner_[p], 0u});
                }
            } else {
                for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
                    writer_.put({v(i), t0(i), t1(i + 1), i == 0 ? inner_[p] : i == 1 ? singularCorners(patch) : 0u});
                }
            }
        }
    }

    /// A bit a corner whose sector is a crease of one facet: its two tangents lie on one line.
    [[nodiscard]] uint32_t singularCorners(const DraftPatch& patch) const {
        uint32_t bits = 0;
        for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
            const Sector& sector = mesh_.sectors[corner(patch, i).sector];
            bits |= sector.kind == SectorKind::crease && sector.facets == 1 ? 1u << i : 0u;
        }
        return bits;
    }

    const Mesh& mesh_;
    const cage::Cage& cage_;
    Tables tables_;
    TableWriter writer_;
    std::vector<DraftPatch> patches_;
    std::vector<uint32_t> inner_; ///< per patch: its first coefficient of the facet stage in the pool
};

} // namespace

Tables buildTables(const Mesh& mesh) {
    return Builder(mesh).build();
}

} // namespace supple::surface::pm
