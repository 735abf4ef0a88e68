// The points of smooth texture coordinates that quads and triangles of leaves have (docs/smooth_uvs.md): what level 1
// and chains are to positions, two numbers a point. Everything is computed once. Private to chains/.
#pragma once

#include "surface/build.h"
#include "surface/chains/arrangement.h"
#include "surface/chains/fan_tables.h"
#include "surface/chains/needed_rows.h"
#include "surface/subdivision/mesh.h"
#include "surface/uv_levels.h"

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

namespace supple::surface::chains {

/// The points of one UV set.
class UvPoints {
public:
    /// `level`: the channel of the UV set on the level of the patches. `lastLevel`: of chains.
    UvPoints(Subdivision subdivision, ChannelLevel level, uint32_t lastLevel);
    UvPoints(const UvPoints&) = delete;
    UvPoints& operator=(const UvPoints&) = delete;

    [[nodiscard]] const RefinedMesh& mesh() const { return isolation_.parent; }
    /// By vertex, whether it has a chain. To be called before write() and addFans().
    void setChains(std::vector<uint8_t> chains) { hasChain_ = std::move(chains); }
    /// Puts numbers in the place of the points of level 1 that a net has. Before write().
    void needNet(std::span<uint32_t> net) { levelOne_.needNet(net); }
    void write(TableWriter& writer);
    /// Has the tables of all fans written that corners name.
    void addFans(FanTables& fans) const;

    /// Numbers of the table's pairs of floats, behind write().
    [[nodiscard]] uint32_t limit(uint32_t vertex) const { return firstLimit_ + vertex; }
    [[nodiscard]] uint32_t firstPoint() const { return firstPoint_; } ///< of level 1
    /// Refuses more of them than records of patches can name.
    [[nodiscard]] Status checkSize() const;
    /// What records say of a corner of the mesh, behind write() and addFans(). Without a chain: 0.
    struct Corner {
        uint32_t chain = 0, netLists = 0;
    };
    [[nodiscard]] Corner cornerOf(uint32_t corner, FanTables& fans) const;

private:
    using Points = std::vector<glm::dvec2>;

    [[nodiscard]] subdivision::Fan fanOf(uint32_t vertex) const;
    [[nodiscard]] Arrangement arrangementOf(uint32_t vertex) const;
    [[nodiscard]] uint32_t netPoint(uint32_t vertex, uint32_t i) const;
    [[nodiscard]] glm::dvec2 limitAt(uint32_t vertex);
    void writeChain(uint32_t vertex, TableWriter& writer) const;

    Subdivision subdivision_;
    subdivision::Isolation isolation_;
    Points points_; ///< of level 1
    NeededRows levelOne_;
    std::vector<uint8_t> hasChain_;
    uint32_t lastLevel_;
    std::map<Arrangement, subdivision::CentreMask> limits_;
    uint32_t firstLimit_ = 0, firstPoint_ = 0;
    std::vector<uint32_t> chains_; ///< by vertex: the first point of level 2
};

/// The channel of a UV set on the level of the mesh. `cage`: as the first step takes it (subdivision::beginSteps).
/// `steps`: patches are made of what one step makes of it.
[[nodiscard]] Result<ChannelLevel> channelOf(const RefinedMesh& cage, const std::vector<glm::vec2>& uvs,
                                             Subdivision subdivision, cage::UvMode mode, bool steps);

} // namespace supple::surface::chains
