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
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 l = frame.sunDirection.xyz;
    float nl = max(dot(n, l), 0.0);
    float sun = nl > 0.0 ? sunVisibility(inPosition, n, gl_FragCoord.xy) : 0.0;
    Material material = plainMaterial(inColor, roughness);
    material.metallic = metallic;
    // Light from the floor, and less sky near it.
    float near = mix(0.55, 1.0, clamp(inPosition.y * 1.4, 0.0, 1.0));
    vec3 sunLight = kSun * (sun / kPi * 1.6); // radiance of a white surface that faces it
    vec3 diffuse = sunLight * nl + skyLight(n) * mix(near, 1.0, 0.5 + 0.5 * n.y) * 0.75;
    vec3 f0 = mirrorColor(material);
    vec3 share = mirroredShare(f0, material.roughness, clamp(dot(n, v), 1e-3, 1.0));
    vec3 mirrored = sunLight * mirroredLight(n, v, l, material.roughness, f0) + share * skyLight(reflect(-v, n)) * near;
    outColor = vec4(inColor * (1.0 - metallic) * (1.0 - share) * diffuse + mirrored, 1.0);
    outMotion = motion(inNow, inBefore);
}
