#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(location = 0) in vec3 inPosition;

layout(location = 0) out vec4 outColor;

void main() {
    const vec3 n = vec3(0.0, 1.0, 0.0);
    vec3 albedo = vec3(0.37, 0.255, 0.265);
    vec3 light = kLamp * (lampVisibility(inPosition, n) * frame.sun.y * 0.36) +
                 kRoomAbove * (roomVisibility(inPosition) * 0.62);
    // The floor becomes the wall without an edge, as in a photographer's studio.
    float away = length(inPosition.xz);
    outColor = onScreen(mix(albedo * light, wall(gl_FragCoord.xy), smoothstep(1.6, 6.5, away)));
}
