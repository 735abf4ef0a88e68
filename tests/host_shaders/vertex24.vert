// shaders/supple_surface.glsl with vertices of 24 bytes and a binding of the host's own.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 2
#define SUPPLE_SURFACE_VERTEX_24
#define SUPPLE_ATTRIBUTES_BINDING 7
#include "supple_surface.glsl"

layout(push_constant) uniform Push { SuppleRange range; };
layout(location = 0) out vec4 outAll;

void main() {
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    outAll = vec4(suppleNormal(at) + supplePreviousPosition(at), suppleUv(at).x) + suppleColor(at);
    gl_Position = vec4(supplePosition(at), 1.0);
}
