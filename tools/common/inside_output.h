// What a group of one surface hands out, for programs that look inside the library.
#pragma once

#include "host/group_output.h"
#include "runtime/group.h"

namespace supple::tools {

[[nodiscard]] inline host::GroupOutput insideOutput(const runtime::Group& group) {
    const runtime::Tessellation& surface = group.surfaces()[0];
    host::GroupOutput out;
    group.fill(out.info);
    group.fill(out.surface, 0);
    if (const runtime::VertexStreams* streams = surface.streams()) {
        streams->fill(out.streams);
    }
    surface.fillGrid(out.grid);
    surface.fillLevels(out.levels);
    if (group.culling() != nullptr) {
        out.bounds = group.culling()->bounds();
    }
    return out;
}

} // namespace supple::tools
