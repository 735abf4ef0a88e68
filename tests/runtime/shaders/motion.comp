// What a vertex shader that writes motion vectors finds: how far each vertex of a range has moved.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 0
#ifdef VERTEX_24
#define SUPPLE_SURFACE_VERTEX_24
#endif
#include "supple_surface.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 4, std430) writeonly buffer Moved { float moved[]; };
layout(push_constant) uniform Push {
    SuppleRange range;
    uint count; // of vertices that are drawn
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    SuppleVertex at = suppleVertex(range, i / range.samplesPerPatch, i % range.samplesPerPatch);
    moved[at.index] = distance(supplePosition(at), supplePreviousPosition(at));
}
