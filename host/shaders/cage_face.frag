#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"
#include "material.glsl"
#include "material_textures.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) flat in vec3 inNormal;
layout(location = 2) in vec4 inUv;
layout(location = 3) in vec4 inColor;

layout(location = 0) out vec4 outColor;

void main() {
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 n = inNormal * inversesqrt(max(dot(inNormal, inNormal), 1e-30));
    if (!gl_FrontFacing)
        n = -n;
    vec4 base = baseColorAt(inUv.xy, inColor);
    vec2 metallicRoughness = metallicRoughnessAt(inUv.zw);
    if (materialHas(kMaterialMask) && base.a < materialData.cutoff)
        discard;
    if (push.view == kViewNormals) {
        outColor = vec4(fromSrgb((gl_FrontFacing ? n : -n) * 0.5 + 0.5), 1.0);
        return;
    }
    Material material = Material(base.rgb, metallicRoughness.y, metallicRoughness.x);
    if (push.view != kViewShaded)
        material = Material(vec3(0.50, 0.47, 0.44), 0.6, 0.0);
    if (!gl_FrontFacing && !materialHas(kMaterialDoubleSided))
        material.albedo *= 0.35;
    float alpha = materialHas(kMaterialTranslucent) ? base.a : 1.0;
    outColor = vec4(toneMap(studioShade(material, gatherLight(inPosition, n), n, v)), alpha);
}
