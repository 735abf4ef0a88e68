// A cylinder from a to b, as a strip round it and a cap at its end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(push_constant) uniform Push {
    vec4 a; // w: radius
    vec4 b; // w: 1 for the sun's map
};

layout(location = 0) centroid out vec3 outPosition;
layout(location = 1) centroid out vec3 outNormal;

const int kSides = 24;

void main() {
    vec3 axis = normalize(b.xyz - a.xyz);
    vec3 x = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0))), y = cross(axis, x);
    bool cap = gl_VertexIndex >= 2 * (kSides + 1);
    int at = cap ? gl_VertexIndex - 2 * (kSides + 1) : gl_VertexIndex;
    float angle = 6.28318531 * float(at / 2) / float(kSides);
    vec3 around = cos(angle) * x + sin(angle) * y;
    bool end = cap || (at & 1) == 1;
    outNormal = cap ? axis : around;
    outPosition = (end ? b.xyz : a.xyz) + (cap && (at & 1) == 1 ? vec3(0.0) : around * a.w);
    gl_Position = (b.w != 0.0 ? scene.sunViewProjection : scene.viewProjection) * vec4(outPosition, 1.0);
}
