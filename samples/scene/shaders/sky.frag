#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) in vec2 inAt;
layout(location = 0) out vec4 outColor;

void main() {
    vec3 direction = normalize(scene.ahead.xyz + inAt.x * scene.right.xyz - inAt.y * scene.up.xyz);
    vec3 color = skyLight(vec3(direction.x, max(direction.y, 0.02), direction.z));
    vec2 at = direction.xz / (direction.y + 0.12);
    float clouds = 0.55 * noise(at * 1.4) + 0.3 * noise(at * 3.1 + 4.0) + 0.15 * noise(at * 7.3);
    color = mix(color, vec3(1.25, 1.14, 1.02), smoothstep(0.52, 0.82, clouds) * smoothstep(0.02, 0.25, direction.y));
    outColor = shown(color);
}
