// P_m as a scheme: the tables of shaders/shared/{surface,pm}.h.
#include "shaders/shared/pm.h"
#include "surface/build.h"
#include "surface/patch_records.h"
#include "surface/pm/kernels.h"
#include "surface/pm/smooth_uvs.h"
#include "surface/pm/weights.h"
#include "surface/valence.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace supple::surface::pm {

namespace {

uint32_t fanKind(const Fan& fan) {
    if (fan.variable) {
        return shared::kVariableFan;
    }
    if (fan.creased || fan.pinned || !fan.plainEnds()) {
        return shared::kCreasedFan;
    }
    if (fan.closed() && fan.facets == 4) {
        return shared::kRegularFan;
    }
    return fan.edges() <= shared::kFewSpokes ? shared::kFewFan : shared::kManyFan;
}

/// Coefficients of a patch that the facet stage makes.
uint32_t innerCount(PatchClass patchClass) {
    return patchClass == PatchClass::regular ? 0
           : patchClass == PatchClass::polar ? 2
                                             : 1 + 3 * cornerCount(domainOf(patchClass));
}

class Builder {
public:
    Builder(const Mesh& mesh, const Recipe& recipe, PatchEdges* edges)
        : mesh_(mesh), cage_(mesh.cage), recipe_(recipe), edges_(edges), writer_(tables_.words) {}

    Result<Tables> build() {
        tables_.notes = mesh_.notes;
        patches_ = draftPatches({cage_, cage_.vertexCount(), mesh_.sourceFaces, mesh_.firstCorners},
                                [&](const DraftPatch& patch) { return mesh_.classes[patch.facet]; });
        sortFans();
        layOutPool();
        writeFans();
        const Status numbered = writeEdgeClasses();
        if (!numbered) {
            return numbered.error();
        }
        writePatches();
        addFacets();
        writeRing();
        finishTables(recipe_, cage_, patches_, writer_, tables_, edges_);
        const Status smooth = writeUvs();
        if (!smooth) {
            return smooth.error();
        }
        return std::move(tables_);
    }

private:
    [[nodiscard]] const FacetCorner& corner(const DraftPatch& patch, uint32_t i) const {
        return mesh_.corners[patch.cageCorners[i % patch.info.cornerCount]];
    }
    /// By kind, regular ones first, then by size, so that neighbouring lanes loop equally long. Slots lie in this
    /// order.
    void sortFans() {
        const auto count = static_cast<uint32_t>(mesh_.fans.size());
        order_.resize(count);
        std::iota(order_.begin(), order_.end(), 0u);
        const auto rank = [&](uint32_t s) {
            return std::tuple(fanKind(mesh_.fans[s]), mesh_.fans[s].edges(), mesh_.fans[s].kind, s);
        };
        std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
        slots_.resize(mesh_.slotSpokes.size());
        uint32_t next = 0;
        for (const uint32_t s : order_) {
            for (uint32_t j = 0; j < mesh_.fans[s].edges(); ++j) {
                slots_[mesh_.fans[s].firstSlot + j] = next++;
            }
        }
        uint32_t others = cage_.vertexCount();
        for (uint32_t s = 0; s < count; ++s) {
            const bool first = s == 0 || mesh_.fans[s - 1].vertex != mesh_.fans[s].vertex;
            points_.push_back(first ? mesh_.fans[s].vertex : others++);
        }
    }

    /// v, t, f, then what the facet stage adds, patch by patch.
    void layOutPool() {
        const auto slots = static_cast<uint32_t>(mesh_.slotSpokes.size());
        tables_.tangents = static_cast<uint32_t>(mesh_.fans.size());
        tables_.faces = tables_.tangents + slots;
        uint32_t next = tables_.faces + slots;
        for (const DraftPatch& patch : patches_) {
            inner_.push_back(next);
            next += innerCount(patch.info.patchClass);
        }
        tables_.poolStride = poolStrideFor(next);
    }

    Status writeUvs() {
        const auto makeSet = [&](const std::vector<glm::vec2>& uvs) -> Result<UvPatches> {
            const cage::UvSharpness sharpness{mesh_.features.edgeSharpness, mesh_.features.vertexSharpness};
            const Result<cage::UvChannel> channel =
                cage::buildUvChannel(cage_, mesh_.topology, sharpness, uvs, recipe_.uvMode);
            if (!channel) {
                return channel.error();
            }
            return UvPatches(
                [made = UvConstruction(mesh_, *channel)](const DraftPatch& patch) { return made.patch(patch.facet); });
        };
        return writeSmoothUvs(recipe_, cage_, patches_, makeSet, writer_, tables_);
    }

    void writeRing() {
        std::vector<uint32_t> points; // per corner, where they have the numbers of vertices
        for (uint32_t c = 0; c < cage_.cornerCount(); ++c) {
            const uint32_t vertex = cage_.faceVertices[c];
            points.push_back(points_[mesh_.corners[c].fan] == vertex ? vertex : cage::kNone);
        }
        RingWriter ring(cage_, mesh_.topology, points, mesh_.firstCorners, writer_);
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            ring.setRecord(patches_[p].facet, records_[p]);
        }
        for (const uint32_t f : order_) {
            const Fan& fan = mesh_.fans[f];
            ring.add(fan.vertex, std::span(mesh_.slotSpokes).subspan(fan.firstSlot, fan.edges()), !fan.closed());
        }
        tables_.ring = ring.write();
    }

    /// What the weights of a variable fan say of the crease set of an edge.
    [[nodiscard]] uint32_t setWord(uint32_t slot) const {
        const uint32_t set = mesh_.slotSets[slot];
        return (set == cage::kNone ? 0u : set + 1) | (mesh_.slotGivens[slot] != 0 ? shared::kGivenAlpha : 0u);
    }

    uint32_t writeCreasedWeights(const Fan& fan) {
        const FanScales scales = fanScales(fan.kind, fan.facets);
        const uint32_t element = writer_.element();
        writer_.put({fan.facets | (fan.closed() ? 0u : shared::kOpenSector) |
                         (fan.kind == FanKind::corner ? shared::kCornerSector : 0u) |
                         (fan.kind == FanKind::straight ? shared::kStraightSector : 0u) |
                         (fan.pinned ? shared::kPinnedSector : 0u) | (fan.plainEnds() ? 0u : shared::kOwnEndsSector),
                     floatBits(scales.limit), floatBits(scales.tangent), 0u});
        for (uint32_t j = 0; j < fan.edges(); ++j) {
            const auto [cosine, sine] = tangentTurn(fan, j);
            const uint32_t slot = fan.firstSlot + j;
            const uint32_t last = fan.variable ? setWord(slot) : floatBits(mesh_.slotRims[slot]);
            writer_.put({floatBits(mesh_.slotAlphas[slot]), floatBits(cosine), floatBits(sine), last});
        }
        for (size_t end = 0; !fan.plainEnds() && end < 2; ++end) {
            const FanEnd& at = fan.ends[end];
            const bool joined = at.partner != cage::kNone;
            writer_.put({joined ? slots_[at.partner] + 1 : 0u, floatBits(at.own), floatBits(at.other), 0u});
        }
        return element;
    }

    void writeFans() {
        std::vector<uint32_t> weights(mesh_.fans.size(), 0);
        std::map<std::tuple<FanKind, uint32_t, uint32_t>, uint32_t> smooth;
        for (uint32_t s = 0; s < weights.size(); ++s) {
            const Fan& fan = mesh_.fans[s];
            if (fanKind(fan) == shared::kCreasedFan || fan.variable) {
                weights[s] = writeCreasedWeights(fan);
            } else if (fanKind(fan) != shared::kRegularFan) {
                const auto [known, isNew] = smooth.try_emplace({fan.kind, fan.facets, fan.width}, 0u);
                if (isNew) {
                    known->second =
                        writeFanWeights(makeFanWeights(fan), fan.closed() ? 0u : shared::kOpenSector, writer_);
                }
                weights[s] = known->second;
            }
        }
        for (const uint32_t s : order_) {
            const Fan& fan = mesh_.fans[s];
            const KindOfKernel& kernel = kVertexKernels[fanKind(fan)];
            countVertex(kernel, 1 + fan.edges() + fan.facets, writer_, tables_);
            if (kernel.kind != shared::kRegularFan) {
                writer_.put({slots_[fan.firstSlot], weights[s], points_[s]});
            }
        }
    }

    [[nodiscard]] EdgeClass edgeClass(const DraftPatch& patch, uint32_t i) const {
        const FacetCorner &a = corner(patch, i), &b = corner(patch, i + 1);
        return {patch.info.cornerCount,
                {mesh_.fans[a.fan].angle(), mesh_.fans[b.fan].angle()},
                mesh_.features.hard(mesh_.topology.cornerEdges[patch.cageCorners[i]]),
                {a.across == cage::kNone, b.acrossBack == cage::kNone}};
    }

    Status writeEdgeClasses() {
        tables_.edgeClasses = writer_.element();
        uint32_t firstTooMany = cage::kNone; // face
        for (const DraftPatch& patch : patches_) {
            for (uint32_t i = 0; patch.info.patchClass >= PatchClass::p3 && i < patch.info.cornerCount; ++i) {
                const auto number = static_cast<uint32_t>(edgeClasses_.size());
                const auto [known, isNew] = edgeClasses_.try_emplace(edgeClass(patch, i), number);
                if (isNew) {
                    if (number == shared::kMaxPmEdgeClasses) {
                        firstTooMany = patch.info.face;
                    }
                    const EdgeFactors f = makeEdgeFactors(known->first);
                    writer_.putFloats({f.along[0], f.own[0], f.across[0], f.across[1], f.along[1], f.own[1], 0.0, 0.0});
                }
            }
        }
        if (firstTooMany != cage::kNone) {
            return Error{ErrorCode::limit,
                         "face " + std::to_string(firstTooMany) + ": the cage has edges of " +
                             std::to_string(edgeClasses_.size()) +
                             " kinds, by the valences of their ends and the sides of their faces; patch "
                             "records hold " +
                             std::to_string(shared::kMaxPmEdgeClasses) + ", and this face has the first one more"};
        }
        return success();
    }

    /// The facet stage reads the records of the patches.
    void addFacets() {
        for (const PatchRange& range : tables_.ranges) {
            if (range.patchClass == PatchClass::regular) {
                continue;
            }
            const auto kernel = static_cast<size_t>(range.patchClass) - static_cast<size_t>(PatchClass::polar);
            tables_.constructions.push_back({Stage::assemble, kFacetKernels[kernel], range.section,
                                             innerCount(range.patchClass) * range.section.count});
        }
    }

    void writePatches() {
        std::map<std::array<uint32_t, 4>, uint32_t> apexes;
        const auto apexWeights = [&](const DraftPatch& patch) -> std::array<uint32_t, 4> {
            const FacetCorner& apex = corner(patch, 2);
            const double c = turn(1, mesh_.fans[apex.fan].facets).first;
            const auto set = [&](uint32_t slot) { return setWord(slot) & shared::kAlphaSetMask; };
            return {floatBits(c), floatBits(1.5 * mesh_.slotAlphas[apex.slot]),
                    floatBits(1.5 * mesh_.slotAlphas[apex.slotBack]),
                    set(apex.slot) | set(apex.slotBack) << shared::kBackSetShift};
        };
        for (const DraftPatch& patch : patches_) {
            if (patch.info.patchClass == PatchClass::polar) {
                const std::array<uint32_t, 4> weights = apexWeights(patch);
                if (apexes.try_emplace(weights, writer_.element()).second) {
                    writer_.put(weights);
                }
            }
        }
        for (uint32_t p = 0; p < patches_.size(); ++p) {
            const DraftPatch& patch = patches_[p];
            const PatchClass patchClass = patch.info.patchClass;
            countPatch(patchClass, p, writer_, tables_);
            records_.push_back(writer_.element());
            if (edges_ != nullptr) {
                edges_->beginPatch();
            }
            if (patchClass > PatchClass::polar) {
                writeFacet(patch, inner_[p]);
                continue;
            }
            NetCorners corners;
            std::array<uint32_t, 4> spokes{};
            for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
                const FacetCorner& c = corner(patch, i);
                corners.points[i] = points_[c.fan];
                corners.spokes[i] = slots_[c.slot];
                corners.nextSpokes[i] = slots_[c.slotBack];
                spokes[i] = spokeWord(slots_[c.slot], slots_[c.slotBack]);
            }
            if (patchClass == PatchClass::polar) {
                corners.points[3] = inner_[p];
                spokes[3] = apexes.at(apexWeights(patch));
            }
            writer_.put(corners.points);
            writer_.put(spokes);
            if (edges_ != nullptr) {
                addNetSides(patch, corners);
            }
        }
    }

    /// A side of a facet, but for what its record is made of. Where a fan ends at the edge, each facet has a tangent of
    /// its own there.
    [[nodiscard]] PatchSide sideOf(const DraftPatch& patch, uint32_t i) const {
        const FacetCorner &own = corner(patch, i), &next = corner(patch, i + 1);
        PatchSide side;
        side.edge = edgeNumber(mesh_.topology, patch.cageCorners[i],
                               own.across != cage::kNone && next.acrossBack != cage::kNone);
        side.corner = points_[own.fan];
        return side;
    }

    /// The sides of a bicubic patch: its facet's, and the apex if it is polar.
    void addNetSides(const DraftPatch& patch, const NetCorners& corners) {
        const bool polar = patch.info.patchClass == PatchClass::polar;
        const NetIndices net(corners, tables_.tangents, tables_.faces, polar);
        for (uint32_t i = 0; i < 4; ++i) {
            const bool isApex = polar && i == 2;
            PatchSide& side = edges_->sides.emplace_back(isApex ? PatchSide{} : sideOf(patch, polar && i == 3 ? 2 : i));
            side.curve = net.curve(i);
            side.across = net.inside(i);
            if (isApex) { // one edge for all patches round it, behind those of the topology
                side.isPoint = true;
                side.corner = corners.points[2];
                side.edge = 2 * static_cast<uint32_t>(mesh_.topology.edges.size()) + corners.points[2];
            } else if (polar && i != 0) {
                side.kind = shared::kMixedEdges;
                side.flags = i == 1 ? shared::kApexLastEdge : shared::kApexFirstEdge;
            }
        }
    }

    /// The sides of a patch of sectors.
    void addSectorSides(const DraftPatch& patch, uint32_t inner) {
        const uint32_t m = patch.info.cornerCount, singular = singularCorners(patch);
        const uint32_t first = inner + 1; // b211, b121, b112 a sector
        for (uint32_t i = 0; i < m; ++i) {
            const FacetCorner &own = corner(patch, i), &next = corner(patch, i + 1);
            const uint32_t last = (i + m - 1) % m;
            PatchSide& side = edges_->sides.emplace_back(sideOf(patch, i));
            side.kind = shared::kMixedEdges;
            side.curve = {points_[own.fan], tables_.tangents + slots_[own.slot],
                          tables_.tangents + slots_[next.slotBack], points_[next.fan]};
            side.across = {tables_.tangents + slots_[own.slotBack], first + 3 * i, first + 3 * i + 1,
                           tables_.tangents + slots_[next.slot]};
            side.flags = m;
            if ((singular & 1u << i) != 0) {
                side.flags |= shared::kSingularEdge;
                side.extra = first + 3 * last + 1;
            }
        }
    }

    /// The record of a patch of sectors.
    void writeFacet(const DraftPatch& patch, uint32_t inner) {
        using namespace shared;
        const uint32_t m = patch.info.cornerCount;
        std::array<uint32_t, size_t{4} * SUPPLE_PM_RECORD_ELEMENTS(kMaxSides)> words{};
        for (uint32_t i = 0; i < m; ++i) {
            const FacetCorner& c = corner(patch, i);
            const uint32_t slot = slots_[c.slot], across = c.across == cage::kNone ? slot : slots_[c.across];
            words[SUPPLE_PM_POINT_WORD(i)] = spokeWord(points_[c.fan], points_[c.fan] + (across - slot)) |
                                             (c.acrossBack == cage::kNone ? kEndsBehind : 0u);
            words[SUPPLE_PM_SPOKE_WORD(i)] = spokeWord(slot, slots_[c.slotBack]);
            words[SUPPLE_PM_CLASS_WORD(m, i)] |= edgeClasses_.at(edgeClass(patch, i)) << kEdgeClassBits * (i % 3);
        }
        words[SUPPLE_PM_INNER_WORD(m)] = inner | singularCorners(patch) << kInnerBits;
        writer_.put(std::span(words).first(size_t{4} * SUPPLE_PM_RECORD_ELEMENTS(m)));
        if (edges_ != nullptr) {
            addSectorSides(patch, inner);
        }
    }

    /// A bit a corner whose fan is one facet on a smooth curve: its two tangents lie on one line.
    [[nodiscard]] uint32_t singularCorners(const DraftPatch& patch) const {
        uint32_t bits = 0;
        for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
            const Fan& fan = mesh_.fans[corner(patch, i).fan];
            bits |= fan.angle() == FacetAngle{1, 2} ? 1u << i : 0u;
        }
        return bits;
    }

    const Mesh& mesh_;
    const cage::Cage& cage_;
    const Recipe& recipe_;
    PatchEdges* edges_; ///< null: nobody asks
    Tables tables_;
    TableWriter writer_;
    std::vector<DraftPatch> patches_;
    std::vector<uint32_t> inner_;   ///< per patch: its first coefficient of the facet stage in the pool
    std::vector<uint32_t> records_; ///< per patch: the element its record begins with
    std::vector<uint32_t> order_;   ///< fans as the vertex stage takes them
    std::vector<uint32_t> slots_;   ///< per slot of the mesh: its number in the pool
    std::vector<uint32_t> points_;  ///< per fan: its limit point in the pool
    std::map<EdgeClass, uint32_t> edgeClasses_;
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges) {
    const Result<Mesh> mesh = buildMesh(cage);
    if (!mesh) {
        return mesh.error();
    }
    SpokeLimits spokes;
    for (const Fan& fan : mesh->fans) {
        spokes.add(fan.vertex, fan.edges());
    }
    const Status fits = spokes.check();
    if (!fits) {
        return fits.error();
    }
    return Builder(*mesh, recipe, edges).build();
}

float boundsMargin(const cage::Cage& cage) {
    // Hard creases may make corners of several facets, whose tangents reach further out.
    const bool corners = !cage.creases.empty() || !cage.sharpVertices.empty() || !cage.creaseScalars.empty();
    return corners ? 0.4f : 0.21f; // found: 0.3351, 0.1896
}

} // namespace supple::surface::pm
