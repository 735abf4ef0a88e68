#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inColor;
layout(location = 3) in vec4 inNow;
layout(location = 4) in vec4 inBefore;

layout(location = 0) out vec4 outColor;
layout(location = 1) out vec2 outMotion;

void main() {
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 l = frame.sunDirection.xyz;
    float nl = max(dot(n, l), 0.0);
    float sun = nl > 0.0 ? sunVisibility(inPosition, n, gl_FragCoord.xy) : 0.0;
    // Light from the floor, and less sky near it.
    float near = mix(0.55, 1.0, clamp(inPosition.y * 1.4, 0.0, 1.0));
    vec3 diffuse = kSun * (sun * nl / kPi * 1.6) + skyLight(n) * mix(near, 1.0, 0.5 + 0.5 * n.y) * 0.75;
    vec3 shine = kSun * (sun * glossy(n, v, l, 0.45));
    float rim = pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 4.0);
    shine += skyLight(reflect(-v, n)) * (0.04 + 0.30 * rim) * 0.6;
    outColor = vec4(inColor * diffuse + shine, 1.0);
    outMotion = motion(inNow, inBefore);
}
