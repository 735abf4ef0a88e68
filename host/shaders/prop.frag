#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH AttachmentPush
#include "frame.glsl"
#include "studio.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inColor;
layout(location = 3) in vec2 inFinish;

layout(location = 0) out vec4 outColor;

void main() {
    vec3 v = normalize(frame.eye.xyz - inPosition), n = normalize(inNormal);
    n = dot(n, v) < 0.0 ? -n : n; // feathers have two sides
    Material material = plainMaterial(inColor.rgb, inFinish.x);
    material.metallic = inFinish.y;
    material.emission = inColor.rgb * inColor.w;
    Incident light = gatherLight(inPosition, n, kLookAsFits, pixelNoise(gl_FragCoord.xy));
    outColor = vec4(studioTone(material, studioShade(material, light, n, n, v)), 1.0);
}
