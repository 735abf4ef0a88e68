#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 0) out vec4 outColor;

void main() {
    vec2 tile = abs(fract(inPosition.xz / 3.0) - 0.5), span = max(fwidth(inPosition.xz / 3.0), 1e-5);
    vec2 line = clamp((0.012 - (0.5 - tile)) / span + 0.5, 0.0, 1.0) * clamp(0.012 / span, 0.0, 1.0);
    vec3 albedo = mix(vec3(0.47, 0.49, 0.43), vec3(0.36, 0.38, 0.33), max(line.x, line.y));
    float sun = sunVisibility(inPosition, vec3(0.0, 1.0, 0.0)) * scene.sunDirection.y;
    outColor = vec4(shown(hazed(albedo * (kSun * sun * 0.5 + kSky * 0.62), inPosition)), 1.0);
}
