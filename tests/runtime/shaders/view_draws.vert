// The groups of a view, as docs/integration.md draws them: what a draw is told comes as push constants or, with GATHERED, from
// what host/view_draws.h has gathered.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 0
#define SUPPLE_SURFACE_LOD
#define SUPPLE_SURFACE_VERTEX_24
#include "supple_surface.glsl"
#include "../../../host/shaders/view_draws.h"

#ifdef GATHERED
layout(set = 0, binding = 6, std430) readonly buffer Drawn { ViewDraw drawn[]; };
layout(push_constant) uniform Push {
    vec4 window; // of the picture: middle, half its height
    uint firstDraw;
};
#else
layout(push_constant) uniform Push {
    vec4 window;
    SuppleDraw draw;
    uint surface;
    uint material;
};
#endif
layout(location = 0) out vec3 outPosition;
layout(location = 1) flat out uvec4 outDraw; // slot, surface, material

void main() {
#ifdef GATHERED
    ViewDraw own = drawn[firstDraw + gl_DrawID];
    SuppleDraw draw = SuppleDraw(own.index, own.verticesPerInstance, own.samplesPerPatch, own.previousWords);
    uint surface = own.surface, material = own.material;
#endif
    SuppleVertex at = suppleLodVertex(draw, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    outDraw = uvec4(at.slot, surface, material, 0u);
    gl_Position = vec4((outPosition.xy - window.xy) / window.z, 0.5 + 0.01 * outPosition.z, 1.0);
}
