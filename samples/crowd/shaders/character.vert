#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#define SUPPLE_SURFACE_LOD
#define SUPPLE_USER_DATA_BINDING 6
#include "supple_surface.glsl"
#include "scene.glsl"

layout(push_constant) uniform Push {
    SuppleDraw draw;
    uint capacity; // of its grids
    uint paint;    // 1: capacities as colors
    uint sun;      // 1: into the sun's map
};

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outColor;

// Every instance has a tint of its own (crowd.cpp): turned round the grey axis by x, then lighter or darker by y.
vec3 tinted(vec3 color, vec2 tint) {
    float angle = tint.x;
    vec3 turned = cos(angle) * color + sin(angle) * cross(vec3(0.57735), color) + (1.0 - cos(angle)) * dot(vec3(1.0 / 3.0), color);
    return max(turned, vec3(0.0)) * tint.y;
}

// From blue, coarse, to red, fine.
vec3 capacityColor() {
    float t = clamp(log2(float(capacity) + 1.0) / 6.0 - 0.12, 0.0, 1.0);
    return clamp(vec3(2.2 * t - 0.5, 1.0 - abs(2.6 * t - 1.1), 1.25 - 2.4 * t), 0.04, 1.0);
}

void main() {
    SuppleVertex at = suppleLodVertex(draw, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    if (sun != 0u) {
        outNormal = outColor = vec3(0.0);
        gl_Position = scene.sunViewProjection * vec4(outPosition, 1.0);
        return;
    }
    outNormal = suppleNormal(at);
    outColor = paint != 0u ? capacityColor() : tinted(suppleColor(at).rgb, suppleUserData(at).xy);
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
