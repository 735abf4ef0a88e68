// Everything that a group hands out for one of its surfaces, whatever its tessellation.
#pragma once

#include "supple/supple.h"

namespace supple::host {

/// What the surface's tessellation lacks is zero.
struct GroupOutput {
    SuppleGroupInfo info{};
    SuppleSurfaceInfo surface{};
    SuppleVertexStreams streams{};
    SuppleGridOutput grid{};
    SuppleLevelOutput levels{};
    SuppleBufferRange bounds{}; ///< groups of a view

    [[nodiscard]] bool hasLevels() const { return surface.tessellation == SUPPLE_TESSELLATION_LEVELS; }
    [[nodiscard]] const SuppleBufferRange& indices() const { return hasLevels() ? levels.indices : grid.indices; }
    [[nodiscard]] const SuppleBufferRange& indirect() const { return hasLevels() ? levels.indirect : grid.indirect; }
};

[[nodiscard]] inline SuppleResult getGroupOutput(SuppleContext context, SuppleGroup group, GroupOutput& out,
                                                 uint32_t surface = 0) {
    out = {};
    out.info.structSize = sizeof out.info;
    out.surface.structSize = sizeof out.surface;
    out.streams.structSize = sizeof out.streams;
    out.grid.structSize = sizeof out.grid;
    out.levels.structSize = sizeof out.levels;
    SuppleResult result = suppleGetGroupInfo(context, group, &out.info);
    if (result == SUPPLE_OK)
        result = suppleGetSurfaceInfo(context, group, surface, &out.surface);
    const SuppleTessellation tessellation = out.surface.tessellation;
    if (result != SUPPLE_OK || tessellation == SUPPLE_TESSELLATION_NONE)
        return result;
    result = suppleGetVertexStreams(context, group, surface, &out.streams);
    if (result == SUPPLE_OK && out.hasLevels())
        result = suppleGetLevelOutput(context, group, surface, &out.levels);
    else if (result == SUPPLE_OK)
        result = suppleGetGridOutput(context, group, surface, &out.grid);
    const bool ofView = out.hasLevels() || tessellation == SUPPLE_TESSELLATION_RATES;
    return result == SUPPLE_OK && ofView ? suppleGetInstanceBounds(context, group, &out.bounds) : result;
}

} // namespace supple::host
