// What a group hands out, for programs that look inside the library.
#pragma once

#include "host/group_output.h"
#include "runtime/group.h"

namespace supple::tools {

[[nodiscard]] inline host::GroupOutput insideOutput(const runtime::Group& group) {
    host::GroupOutput out;
    group.fill(out.info);
    if (const runtime::VertexStreams* streams = group.tessellation().streams()) {
        streams->fill(out.streams);
    }
    group.tessellation().fillGrid(out.grid);
    group.tessellation().fillLevels(out.levels);
    if (group.culling() != nullptr) {
        out.bounds = group.culling()->bounds();
    }
    return out;
}

} // namespace supple::tools
