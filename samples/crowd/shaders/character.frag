#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inColor;
layout(location = 0) out vec4 outColor;

void main() {
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    float nl = max(dot(n, scene.sunDirection.xyz), 0.0);
    float sun = nl > 0.0 ? sunVisibility(inPosition, n) * nl : 0.0;
    float open = mix(0.5, 1.0, clamp(inPosition.y, 0.0, 1.0));
    vec3 light = kSun * sun * 0.5 + mix(kGround, kSky, 0.5 + 0.5 * n.y) * open * 0.75;
    outColor = vec4(shown(hazed(inColor * light, inPosition)), 1.0);
}
