#include "surface/chains/smooth_uvs.h"

#include "shaders/shared/chains.h"
#include "surface/chains/corners.h"
#include "surface/chains/net_lists.h"
#include "surface/chains/triangles.h"
#include "surface/chains/uv_points.h"
#include "surface/smooth_uvs.h"

#include <array>
#include <bit>
#include <memory>
#include <string>

namespace supple::surface::chains {
namespace {

/// One UV set.
class UvSet {
public:
    /// `netSize`: points of a patch's net.
    UvSet(const UvDemand& demand, ChannelLevel level, size_t netSize)
        : points_(demand.subdivision, std::move(level), demand.lastLevel), netSize_(netSize) {}
    virtual ~UvSet() = default;
    UvSet(const UvSet&) = delete;
    UvSet& operator=(const UvSet&) = delete;

    void write(const std::vector<DraftPatch>& patches, FanTables& fans, TableWriter& writer) {
        points_.addFans(fans);
        nets_.resize(netSize_ * patches.size());
        const RefinedMesh& mesh = points_.mesh();
        for (const uint32_t p : patchesByNeighbours(patches, mesh.cage, mesh.topology)) {
            const std::vector<uint32_t> net = netOf(patches[p]);
            std::copy(net.begin(), net.end(), numbersOf(p).begin());
            points_.needNet(numbersOf(p));
        }
        points_.write(writer);
    }
    /// Behind write(). `p`: its index in device order.
    virtual void writePatch(uint32_t p, const DraftPatch& patch, FanTables& fans, TableWriter& writer) = 0;
    void setSharp(bool sharp) { sharp_ = sharp; }
    /// Behind write().
    [[nodiscard]] Status checkSize() const { return points_.checkSize(); }

protected:
    /// Points of level 1.
    [[nodiscard]] virtual std::vector<uint32_t> netOf(const DraftPatch& patch) const = 0;
    /// The net of a patch: what points() numbers.
    [[nodiscard]] std::span<uint32_t> numbersOf(uint32_t p) { return std::span(nets_).subspan(netSize_ * p, netSize_); }
    template <class HasChain>
    void setChains(const HasChain& hasChain) {
        std::vector<uint8_t> chains;
        for (uint32_t v = 0; v < points_.mesh().cage.vertexCount(); ++v) {
            chains.push_back(hasChain(v) ? 1 : 0);
        }
        points_.setChains(std::move(chains));
    }

    UvPoints points_;
    bool sharp_ = false; ///< triangles have the sharpness of their sides (haveSharpUvs())

private:
    size_t netSize_;
    std::vector<uint32_t> nets_; ///< patch by patch
};

class UvQuads final : public UvSet {
public:
    UvQuads(const UvDemand& demand, ChannelLevel level)
        : UvSet(demand, std::move(level), shared::kNetPoints), corners_(points_.mesh()), steps_(points_.mesh()) {
        setChains([&](uint32_t v) { return corners_.kind(v) == VertexKind::chain; });
    }

    void writePatch(uint32_t p, const DraftPatch& patch, FanTables& fans, TableWriter& writer) override {
        const RefinedMesh& mesh = points_.mesh();
        std::array<uint32_t, 4> limits{}, chains{}, netLists{}, sharpness{};
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t c = patch.cageCorners[i];
            const UvPoints::Corner corner = points_.cornerOf(c, fans);
            limits[i] = points_.limit(mesh.cage.faceVertices[c]);
            sharpness[i] = std::bit_cast<uint32_t>(softened(mesh.edgeSharpness[mesh.topology.cornerEdges[c]], 1));
            chains[i] = corner.chain;
            netLists[i] = corner.netLists;
        }
        for (const auto& words : {limits, chains, netLists}) {
            writer.put(words);
        }
        const uint32_t first = firstOfNet(numbersOf(p));
        const uint32_t last = (points_.firstPoint() + first) << shared::kNetFirstShift; // every side is two halves
        writeNetList(numbersOf(p), first, shared::kNetListElements, {shared::kNetListNormals, {}, last, true}, writer);
        writer.put(sharpness);
    }

private:
    [[nodiscard]] std::vector<uint32_t> netOf(const DraftPatch& patch) const override {
        const QuadNet net = corners_.netOf(patch.facet, patch.cageCorners[0] % 4, steps_);
        return {net.begin(), net.end()};
    }

    Corners corners_;
    StepPoints steps_;
};

class UvTriangles final : public UvSet {
public:
    UvTriangles(const UvDemand& demand, ChannelLevel level)
        : UvSet(demand, std::move(level), shared::kTriangleNetPoints), triangles_(points_.mesh()) {
        setChains([&](uint32_t v) { return !triangles_.isPlain(v); });
    }

    void writePatch(uint32_t p, const DraftPatch& patch, FanTables& fans, TableWriter& writer) override {
        std::array<uint32_t, 4> limits{}, chains{}, netLists{};
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t c = patch.cageCorners[i];
            const UvPoints::Corner corner = points_.cornerOf(c, fans);
            limits[i] = points_.limit(points_.mesh().cage.faceVertices[c]);
            chains[i] = corner.chain;
            netLists[i] = corner.netLists;
        }
        limits[3] = triangles_.flagsOf(patch.cageCorners); // no side is whole: each is two halves
        for (const auto& words : {limits, chains, netLists}) {
            writer.put(words);
        }
        const uint32_t first = firstOfNet(numbersOf(p));
        writeNetList(numbersOf(p), first, shared::kTriangleNetListElements,
                     {shared::kTriangleNetListNormals, {}, points_.firstPoint() + first}, writer);
        if (sharp_) {
            writer.put(triangles_.sharpnessOf(patch.cageCorners));
        }
    }

private:
    [[nodiscard]] std::vector<uint32_t> netOf(const DraftPatch& patch) const override {
        const loop::TriangleNet net = triangles_.netOf(patch.facet, patch.cageCorners[0] % 3);
        return {net.begin(), net.end()};
    }

    loop::Triangles triangles_;
};

std::unique_ptr<UvSet> makeSet(const UvDemand& demand, ChannelLevel level) {
    if (demand.subdivision == Subdivision::loop) {
        return std::make_unique<UvTriangles>(demand, std::move(level));
    }
    return std::make_unique<UvQuads>(demand, std::move(level));
}

} // namespace

Status writeUvLeaves(const Recipe& recipe, const cage::Cage& cage, const UvDemand& demand,
                     const std::vector<DraftPatch>& patches, FanTables& fans, TableWriter& writer, Tables& tables) {
    if (recipe.uvMode == cage::UvMode::all || !recipe.attributes || uvSetsOf(cage).empty()) {
        return success();
    }
    std::vector<std::string> notes; // known
    const Result<RefinedMesh> begin = subdivision::beginSteps(cage, demand.subdivision, notes);
    if (!begin) {
        return begin.error();
    }
    std::vector<std::unique_ptr<UvSet>> sets;
    for (const std::vector<glm::vec2>* uvs : uvSetsOf(begin->cage)) {
        Result<ChannelLevel> level = channelOf(*begin, *uvs, demand.subdivision, recipe.uvMode, demand.steps);
        if (!level) {
            return level.error();
        }
        UvSet& set = *sets.emplace_back(makeSet(demand, std::move(*level)));
        set.write(patches, fans, writer);
        if (const Status fits = set.checkSize(); !fits) {
            return fits.error();
        }
    }
    tables.uvMode = recipe.uvMode;
    tables.uvLeaves = true;
    for (const std::unique_ptr<UvSet>& set : sets) {
        set->setSharp(haveSharpUvs(tables));
    }
    for (PatchRange& range : tables.ranges) {
        range.smoothUvs = writer.element();
        for (uint32_t p = range.firstPatch; p < range.firstPatch + range.section.count; ++p) {
            for (const std::unique_ptr<UvSet>& set : sets) {
                set->writePatch(p, patches[p], fans, writer);
            }
        }
    }
    return success();
}

} // namespace supple::surface::chains
