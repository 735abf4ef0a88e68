// A group as docs/integration.md draws it: what a draw is told of its range comes as push constants or, with DRAW_ID, from a
// buffer with an entry per range, by the number of the draw within one vkCmdDrawIndexedIndirect.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 0
#include "supple_surface.glsl"

#ifdef DRAW_ID
layout(set = 0, binding = 4, std430) readonly buffer Ranges { SuppleRange ranges[]; };
layout(push_constant) uniform Push { vec4 window; };
#else
layout(push_constant) uniform Push {
    vec4 window; // of the picture: middle, half its height
    SuppleRange range;
};
#endif
layout(location = 0) out vec3 outPosition;

void main() {
#ifdef DRAW_ID
    SuppleRange range = ranges[gl_DrawID];
#endif
    outPosition = supplePosition(suppleVertex(range, gl_InstanceIndex, gl_VertexIndex));
    gl_Position = vec4((outPosition.xy - window.xy) / window.z, 0.5 + 0.01 * outPosition.z, 1.0);
}
