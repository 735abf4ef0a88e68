#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"
#include "../../../host/shaders/normal_map.glsl"

layout(push_constant) uniform Push {
    layout(offset = 24) float metallic; // behind SuppleRange
    float roughness;
    vec4 baseColor;
};
layout(set = 2, binding = 0) uniform sampler2D colorTexture;
layout(set = 2, binding = 1) uniform sampler2D surfaceTexture; // roughness in green, metal in blue
layout(set = 2, binding = 2) uniform sampler2D normalTexture;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTangent;
layout(location = 3) in vec3 inColor;
layout(location = 4) in vec2 inUv;
layout(location = 0) out vec4 outColor;

void main() {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 surface = normalize(side * inNormal);
    vec3 texel = 2.0 * texture(normalTexture, inUv).xyz - 1.0;
    vec3 n = side * mappedNormal(normalize(inNormal), inNormal, inTangent, texel);
    Material material = plainMaterial(inColor * baseColor.rgb * texture(colorTexture, inUv).rgb, roughness);
    vec2 look = texture(surfaceTexture, inUv).gb;
    material.roughness *= look.x;
    material.metallic = metallic * look.y;
    outColor = shown(lit(material, inPosition, n, surface, mix(0.62, 1.0, 0.5 + 0.5 * n.y)));
}
