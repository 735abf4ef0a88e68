#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) centroid in vec3 inPosition;
layout(location = 1) centroid in vec3 inNormal;
layout(location = 0) out vec4 outColor;

void main() {
    vec3 n = normalize(inNormal), v = normalize(scene.eye.xyz - inPosition), l = scene.sunDirection.xyz;
    float sun = sunVisibility(inPosition + n * 0.03), nl = max(dot(n, l), 0.0);
    vec3 h = normalize(v + l);
    vec3 color = vec3(0.30, 0.20, 0.12) * (kSun * sun * nl * 0.62 + skyLight(n));
    outColor = developed(color + kSun * sun * nl * 0.25 * pow(max(dot(n, h), 0.0), 40.0));
}
