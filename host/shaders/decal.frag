#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH AttachmentPush
#include "frame.glsl"
#include "studio.glsl"

layout(set = 1, binding = kDecalColorBinding) uniform sampler2D colors;
layout(set = 1, binding = kDecalNormalBinding) uniform sampler2D normals; // +Y is up in the picture

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inTangent;
layout(location = 3) in vec3 inBitangent;
layout(location = 4) in vec3 inPlace;

layout(location = 0) out vec4 outColor;

void main() {
    vec3 v = normalize(frame.eye.xyz - inPosition), n = normalize(inNormal);
    vec4 color = texture(colors, inPlace.xy);
    vec3 texel = 2.0 * texture(normals, inPlace.xy).xyz - 1.0;
    float alpha = color.a * inPlace.z;
    if (dot(n, v) <= 0.0 || alpha < 1.0 / 512.0)
        discard;
    vec3 mapped = normalize(texel.x * inTangent + texel.y * inBitangent + texel.z * n);
    Material material = plainMaterial(color.rgb, push.roughness);
    // Without noise: what is printed has sharp edges and even colors, on which noise would show.
    Incident light = gatherLight(inPosition, n, kLookAlongAxes, vec3(0.0));
    outColor = vec4(studioTone(material, studioShade(material, light, mapped, n, v)), alpha);
}
