// The picture of ranges.vert, of a group with SUPPLE_GROUP_DIRECT.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 0
#define SUPPLE_PATCH_SET 0
#include "supple_patch.glsl"

layout(push_constant) uniform Push {
    vec4 window; // of the picture: middle, half its height
    SupplePatchRange range;
};
layout(location = 0) out vec3 outPosition;

void main() {
    SuppleRange drawn = suppleRangeOf(range);
    SuppleVertex at = suppleVertex(drawn, gl_InstanceIndex, gl_VertexIndex);
    outPosition = suppleEvaluate(range, suppleDrawnPatch(drawn, 0u, gl_InstanceIndex), at.slot, gl_VertexIndex).position;
    gl_Position = vec4((outPosition.xy - window.xy) / window.z, 0.5 + 0.01 * outPosition.z, 1.0);
}
