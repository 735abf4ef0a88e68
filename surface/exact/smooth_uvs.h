// Smooth texture coordinates of exact Catmull-Clark patches (docs/smooth_uvs.md): a quad is to its texture coordinates
// what an irregular quad is to positions, two numbers a point. Everything is computed once. Private to exact/.
#pragma once

#include "surface/build.h"
#include "surface/exact/arrangement.h"
#include "surface/exact/corners.h"
#include "surface/exact/fan_tables.h"
#include "surface/subdivision/mesh.h"
#include "surface/uv_levels.h"

#include <glm/glm.hpp>
#include <map>
#include <vector>

namespace supple::surface::exact {

/// One UV set of a mesh of quads.
class UvQuads {
public:
    /// `level`: the channel of the UV set on the level of the mesh. `lastLevel`: of chains.
    UvQuads(ChannelLevel level, uint32_t lastLevel);
    UvQuads(const UvQuads&) = delete;
    UvQuads& operator=(const UvQuads&) = delete;

    /// Writes the points.
    void writePoints(TableWriter& writer);
    /// Writes kExactRecordElements of a patch, behind writePoints(). Fans must have been written: see addFans().
    void writePatch(const DraftPatch& patch, FanTables& fans, TableWriter& writer) const;
    /// Has the tables of all fans written that patches name.
    void addFans(FanTables& fans) const;

private:
    using Points = std::vector<glm::dvec2>;

    [[nodiscard]] subdivision::Fan fanOf(uint32_t vertex) const;
    [[nodiscard]] Arrangement arrangementOf(uint32_t vertex) const;
    [[nodiscard]] uint32_t netPoint(uint32_t vertex, uint32_t i) const;
    [[nodiscard]] glm::dvec2 limitAt(uint32_t vertex);
    void writeChain(uint32_t vertex, TableWriter& writer) const;
    [[nodiscard]] bool hasChain(uint32_t vertex) const { return corners_.kind(vertex) == VertexKind::chain; }

    subdivision::Isolation isolation_;
    Points points_; ///< of level 1
    Corners corners_;
    StepPoints steps_;
    uint32_t lastLevel_;
    std::map<Arrangement, subdivision::CentreMask> limits_;
    // Numbers of the table's pairs of floats.
    uint32_t firstLimit_ = 0, firstPoint_ = 0;
    std::vector<uint32_t> chains_; ///< by vertex: the first point of level 2
};

/// The channel of a UV set on the level of the mesh. `cage`: as the first step takes it (subdivision::beginSteps).
[[nodiscard]] Result<ChannelLevel> channelOfQuads(const RefinedMesh& cage, const std::vector<glm::vec2>& uvs,
                                                  cage::UvMode mode, bool steps);

} // namespace supple::surface::exact
