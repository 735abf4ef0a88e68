#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"
#include "material.glsl"
#include "material_textures.glsl"
#include "layers.glsl"
#include "flat_views.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) flat in vec3 inNormal;
layout(location = 2) in vec4 inUvs;
layout(location = 3) in vec4 inColor;
layout(location = 4) flat in uint inMirrored;

layout(location = 0) out vec4 outColor;

void main() {
    vec3 v = normalize(frame.eye.xyz - inPosition);
    vec3 front = inNormal * inversesqrt(max(dot(inNormal, inNormal), 1e-30));
    bool back = gl_FrontFacing == (inMirrored != 0u);
    vec3 n = back ? -front : front;
    vec4 base = baseColorAt(inUvs, inColor);
    bool shaded = kView == kViewShaded;
    Material material = shaded || isFlatView(kView) ? materialAt(base.rgb, inUvs) : plainMaterial(vec3(0.50, 0.47, 0.44), 0.6);
    vec3 mapped = front;
    if (kMaps && shaded && hasTexture(kNormal)) {
        vec2 uv = placed(kNormal, inUvs);
        mapped = mappedNormalHere(front, inPosition, uv, normalTexelAt(uv));
    }
    vec3 coat = front;
    if (shaded && materialHas(kMaterialClearcoat) && kClearcoatNormalSlot != kNoLayerSlot) {
        vec2 uv = placed(kClearcoatNormal, inUvs);
        coat = mappedNormalHere(front, inPosition, uv, clearcoatTexelAt(uv));
    }
    Layers layers = layersAt(inUvs);
    vec3 stretch = vec3(0.0);
    if (shaded && materialHas(kMaterialAnisotropy))
        stretch = mappedNormalHere(front, inPosition, placed(kAnisotropy, inUvs), vec3(layers.stretch.xy, 0.0));
    vec3 flatly = vec3(0.0);
    if (isFlatView(kView)) {
        vec3 tangent = mappedNormalHere(front, inPosition, placed(kNormal, inUvs), vec3(1.0, 0.0, 0.0));
        flatly = flatColor(kView, base, material, inUvs, tangent, inColor.rgb, -1.0);
        if (isShadedFlat(kView))
            flatly *= formShade(kView, n, v);
    }
    float opacity = materialHas(kMaterialTranslucent) ? base.a : 1.0;
    bool masked = materialHas(kMaterialMask) && base.a < materialData.cutoff;
    if (masked || isLeftOut(opacity * (1.0 - layers.transmission)) || isOtherSide(back))
        discard;
    if (kView == kViewNormals) {
        outColor = vec4(fromSrgb(front * 0.5 + 0.5), 1.0);
        return;
    }
    if (isFlatView(kView)) {
        outColor = vec4(flatly, 1.0);
        return;
    }
    float alpha = shaded && materialHas(kMaterialTranslucent) ? base.a : 1.0;
    if (shaded && materialHas(kMaterialUnlit)) {
        outColor = vec4(base.rgb, alpha);
        return;
    }
    if (back && !materialHas(kMaterialDoubleSided))
        material.albedo *= 0.35;
    vec3 noise = pixelNoise(gl_FragCoord.xy);
    Incident light = gatherLight(inPosition, n, kLookAsFits, noise);
    vec3 bumps = back ? -mapped : mapped;
    vec3 color;
    if (shaded && isLayered())
        color = layeredColor(material, layeredShade(material, layers, light, Place(inPosition, bumps, back ? -coat : coat, n, v, stretch, noise)), alpha);
    else
        color = studioTone(material, studioShade(material, light, bumps, n, v));
    outColor = vec4(color, alpha);
}
