// What a vertex shader makes of a range of a group with SUPPLE_GROUP_DIRECT, stored as other groups store it: positions and normals; with
// DERIVATIVES these instead.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 0
#define SUPPLE_PATCH_SET 0
#include "supple_patch.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 4, std430) writeonly buffer Made { float made[]; };
layout(push_constant) uniform Push {
    SupplePatchRange range;
    uint verticesPerInstance;
    uint count; // of vertices that are drawn
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    SuppleRange drawn = suppleRangeOf(range);
    uint instance = i / range.samplesPerPatch, vertex = i % range.samplesPerPatch;
    SuppleVertex at = suppleVertex(drawn, instance, vertex);
    SuppleSample s = suppleEvaluate(range, suppleDrawnPatch(drawn, 0u, instance), at.slot, vertex);
    vec3 position = s.position, behind = s.normal;
#ifdef DERIVATIVES
    position = s.du;
    behind = s.dv;
#endif
    uint to = 6u * (at.slot * verticesPerInstance + at.own);
    for (uint k = 0u; k < 3u; ++k) {
        made[to + k] = position[k];
        made[to + 3u + k] = behind[k];
    }
}
