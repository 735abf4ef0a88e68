#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"

layout(set = 2, binding = kBaseColorBinding) uniform sampler2D baseColorTexture;

layout(location = 0) in vec3 inPosition;
layout(location = 1) flat in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 3) in vec4 inColor;

layout(location = 0) out vec4 outColor;

void main() {
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 n = inNormal * inversesqrt(max(dot(inNormal, inNormal), 1e-30));
    if (!gl_FrontFacing)
        n = -n;
    vec4 base = push.baseColor * inColor * texture(baseColorTexture, inUv);
    if ((push.flags & kDrawMask) != 0u && base.a < push.alphaCutoff)
        discard;
    if (push.view == kViewNormals) {
        outColor = vec4(fromSrgb((gl_FrontFacing ? n : -n) * 0.5 + 0.5), 1.0);
        return;
    }
    vec3 albedo = push.view == kViewShaded ? base.rgb : vec3(0.50, 0.47, 0.44);
    if (!gl_FrontFacing && (push.flags & kDrawDoubleSided) == 0u)
        albedo *= 0.35;
    float alpha = (push.flags & kDrawTranslucent) != 0u ? base.a : 1.0;
    outColor = vec4(toneMap(studioShade(Material(albedo, 0.6), gatherLight(inPosition, n), n, v)), alpha);
}
