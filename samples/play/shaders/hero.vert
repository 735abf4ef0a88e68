#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#define SUPPLE_TANGENTS_BINDING 4
#include "supple_surface.glsl"
#include "scene.glsl"

layout(push_constant) uniform Push { SuppleRange range; };

#ifndef SUN
layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outTangent;
layout(location = 3) out vec3 outColor;
layout(location = 4) out vec2 outUv;
#endif

void main() {
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    vec3 position = supplePosition(at);
#ifdef SUN
    gl_Position = scene.sunViewProjection * vec4(position, 1.0);
#else
    outPosition = position;
    outNormal = suppleNormal(at);
    outTangent = suppleTangent(at);
    outColor = suppleColor(at).rgb;
    outUv = suppleUv(at);
    gl_Position = scene.viewProjection * vec4(position, 1.0);
#endif
}
