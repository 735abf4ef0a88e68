#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#include "supple_surface.glsl"
#include "frame.glsl"

layout(push_constant) uniform Push { SuppleRange range; };

void main() {
    gl_Position =
        frame.sunViewProjection * vec4(supplePosition(suppleVertex(range, gl_InstanceIndex, gl_VertexIndex)), 1.0);
}
