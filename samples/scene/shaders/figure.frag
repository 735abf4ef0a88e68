#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "figure.glsl"
#include "scene.glsl"

layout(set = 1, binding = 8, std430) readonly buffer Materials { Material materials[]; };
layout(set = 2, binding = 0) uniform sampler2D colorTexture;
layout(set = 2, binding = 1) uniform sampler2D surfaceTexture; // roughness in green, metal in blue

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inColor;
layout(location = 3) in vec2 inUv;
layout(location = 4) flat in uvec3 inDraw;
layout(location = 0) out vec4 outColor;

// Turned round the grey axis by x, away from grey by y, lighter by z.
vec3 tinted(vec3 color, vec3 tint) {
    vec3 turned =
        cos(tint.x) * color + sin(tint.x) * cross(vec3(0.57735), color) + (1.0 - cos(tint.x)) * dot(vec3(1.0 / 3.0), color);
    float gray = dot(turned, vec3(0.2126, 0.7152, 0.0722));
    return clamp(mix(vec3(gray), turned, tint.y) * tint.z, 0.0, 0.95);
}

// From blue, coarse, to red, fine.
vec3 capacityColor(uint capacity) {
    float t = clamp(log2(float(capacity) + 1.0) / 6.0 - 0.12, 0.0, 1.0);
    return clamp(vec3(2.2 * t - 0.5, 1.0 - abs(2.6 * t - 1.1), 1.25 - 2.4 * t), 0.04, 1.0);
}

void main() {
    Material material = materials[inDraw.y];
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    vec3 albedo = inColor * material.baseColor.rgb * texture(colorTexture, inUv).rgb;
    vec2 surface = texture(surfaceTexture, inUv).gb;
    if (material.tint < 4u)
        albedo = tinted(albedo, looks[inDraw.x].tints[material.tint].xyz);
    float metallic = material.metallic * surface.y, roughness = material.roughness * surface.x;
    if (push.paint != 0u) {
        albedo = capacityColor(inDraw.z);
        metallic = 0.0;
    }
    float open = mix(openness(inPosition), 1.0, 0.5) * mix(0.72, 1.0, smoothstep(0.0, 1.2, inPosition.y));
    bool isSkin = material.tint == 3u;
    outColor = shown(hazed(lit(albedo, metallic, roughness, inPosition, n, open, isSkin ? 0.22 : 0.05), inPosition));
}
