#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(push_constant) uniform Push {
    layout(offset = 24) float metallic; // behind SuppleRange
    float roughness;
};

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inColor;
layout(location = 3) in vec4 inNow;
layout(location = 4) in vec4 inBefore;

layout(location = 0) out vec4 outColor;
layout(location = 1) out vec2 outMotion;

void main() {
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    Material material = plainMaterial(inColor, roughness);
    material.metallic = metallic;
    outColor = vec4(lit(material, inPosition, n), 1.0);
    outMotion = motion(inNow, inBefore);
}
