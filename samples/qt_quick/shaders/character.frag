#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(push_constant) uniform Push {
    layout(offset = 24) float metallic; // see range.glsl
    float roughness;
};
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
    Material material = plainMaterial(albedo, roughness);
    material.metallic = metallic;
    vec3 lampLight = kLamp * (lamp * 0.42); // radiance of a white surface that faces it
    vec3 diffuse = lampLight * nl + roomLight(n) * (room * 0.72);
    vec3 f0 = mirrorColor(material);
    vec3 share = mirroredShare(f0, roughness, clamp(dot(n, v), 1e-3, 1.0));
    vec3 color = albedo * (1.0 - metallic) * (1.0 - share) * diffuse;
    color += lampLight * mirroredLight(n, v, l, roughness, f0) + share * roomLight(reflect(-v, n)) * room;
    outColor = onScreen(color);
}
