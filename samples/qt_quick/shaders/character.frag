#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(set = 2, binding = 0) uniform sampler2D baseColor;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inColor;
layout(location = 3) in vec2 inUv;

layout(location = 0) out vec4 outColor;

void main() {
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 l = frame.sun.xyz;
    vec3 albedo = inColor.rgb * texture(baseColor, inUv).rgb;
    float nl = max(dot(n, l), 0.0);
    float lamp = nl > 0.0 ? lampVisibility(inPosition, n) : 0.0;
    float room = mix(roomVisibility(inPosition), 1.0, 0.5 + 0.5 * n.y);
    vec3 color = albedo * (kLamp * (lamp * nl * 0.42) + roomLight(n) * (room * 0.72));
    float rim = pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 4.0);
    color += kLamp * (lamp * glossy(n, v, l, 0.42)) + roomLight(reflect(-v, n)) * ((0.03 + 0.28 * rim) * room * 0.6);
    outColor = onScreen(color);
}
