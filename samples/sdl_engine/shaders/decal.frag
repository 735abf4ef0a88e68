#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(set = 1, binding = 3) uniform sampler2D picture;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inPlace;
layout(location = 3) in vec4 inNow;
layout(location = 4) in vec4 inBefore;

layout(location = 0) out vec4 outColor;
layout(location = 1) out vec4 outMotion; // alpha: it is blended as the color is

void main() {
    vec4 color = texture(picture, clamp(inPlace.xy, 0.0, 1.0));
    float alpha = color.a * inPlace.z;
    vec3 n = normalize(inNormal);
    if (dot(n, frame.eye.xyz - inPosition) <= 0.0 || alpha < 1.0 / 512.0)
        discard;
    outColor = vec4(lit(plainMaterial(color.rgb, 0.45), inPosition, n), alpha);
    outMotion = vec4(motion(inNow, inBefore), 0.0, alpha);
}
