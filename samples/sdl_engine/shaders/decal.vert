#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(set = 1, binding = 0, std430) readonly buffer Instances { uint slots[]; };
layout(set = 1, binding = 1, std430) readonly buffer Points { vec4 points[]; }; // SUPPLE_POINT_FRAME_64
layout(set = 1, binding = 2, std430) readonly buffer Places { vec4 places[]; }; // u, v, opacity, sag
layout(push_constant) uniform Push {
    uint pointCount;
    float lift;
};

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outPlace;
layout(location = 3) out vec4 outNow;
layout(location = 4) out vec4 outBefore;

void main() {
    uint element = 4u * (slots[gl_InstanceIndex] * pointCount + gl_VertexIndex);
    mat4x3 place = transpose(mat3x4(points[element], points[element + 1u], points[element + 2u]));
    outPosition = place[3];
    outNormal = place[2];
    vec4 own = places[gl_VertexIndex];
    outPlace = own.xyz;
    outNow = frame.viewProjection * vec4(outPosition, 1.0);
    outBefore = frame.previousViewProjection * vec4(points[element + 3u].xyz, 1.0);
    // Along the ray to the eye: it stays where it is in the picture, and comes before the surface's own triangles.
    vec3 toEye = frame.eye.xyz - outPosition;
    float away = length(toEye), facing = max(dot(outNormal, toEye) / away, 0.15);
    vec3 lifted = outPosition + toEye * min((lift + own.w) / (facing * away), 0.5);
    gl_Position = frame.jitteredViewProjection * vec4(lifted, 1.0);
}
