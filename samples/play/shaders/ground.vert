#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

struct Vertex {
    vec4 position, normal;
};
layout(set = 0, binding = 2, std430) readonly buffer Vertices { Vertex vertices[]; };

#ifndef SUN
layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec4 outNormal; // w: the part of the sky that is seen
#endif

void main() {
    Vertex at = vertices[gl_VertexIndex];
#ifdef SUN
    gl_Position = scene.sunViewProjection * vec4(at.position.xyz, 1.0);
#else
    outPosition = at.position.xyz;
    outNormal = at.normal;
    gl_Position = scene.viewProjection * vec4(at.position.xyz, 1.0);
#endif
}
