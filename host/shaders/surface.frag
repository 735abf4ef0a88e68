#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"
#include "lines.glsl"
#include "material.glsl"
#include "material_textures.glsl"
#include "layers.glsl"
#include "surface_trim.glsl"
#include "flat_views.glsl"
#include "stripes.glsl"

layout(set = 1, binding = kPatchBinding, std430) readonly buffer Patches { uint patchWords[]; };

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inUvs;
layout(location = 3) in vec4 inColor;
layout(location = 4) in vec3 inGrid; // see surface.vert
layout(location = 5) flat in uint inPatch;

layout(location = 6) in vec3 inSky;
layout(location = 7) in vec3 inKeyRimOpen;
layout(location = 8) in vec3 inTrim;
layout(location = 9) in vec4 inTangent; // views of values: x is the value
layout(location = 10) in vec3 inSquares;

layout(location = 0) out vec4 outColor;

layout(constant_id = 0) const bool kLightPerVertex = false; // see surface.vert

const vec3 kClay = vec3(0.50, 0.47, 0.44);

const uint kClassColors[kClassCount] = uint[kClassCount](SUPPLE_CLASS_COLORS);

/// Distances from the patch's border, in segments.
vec3 insideBorder() {
    const float kFar = 1e9;
    float rate = float(push.rate);
    if (push.domain == kDrawQuad) return vec3(min(inGrid.xy, rate - inGrid.xy), kFar);
    if (push.domain == kDrawPolar) return vec3(min(inGrid.x, rate - inGrid.x), inGrid.y, kFar);
    return push.domain == kDrawTriangle ? inGrid : vec3(kFar, kFar, inGrid.z); // pentagons and rings
}

float patchHash(uint x) {
    x = (x ^ 61u) ^ (x >> 16);
    x *= 9u;
    x ^= x >> 4;
    x *= 0x27d4eb2du;
    return float((x ^ (x >> 15)) & 0xffffu) / 65535.0;
}

/// The edge of a shadow crosses the triangle, or one of its vertices lies inside of another body: what is interpolated from
/// vertices means little there. The mean of squares is the square of the mean only if all agree.
bool verticesDisagree() { return strongest(inSquares - inKeyRimOpen * inKeyRimOpen) > 0.02; }

/// front: the surface's own unit normal.
vec3 normalFromMap(vec3 front) {
    if (!kMaps || !hasTexture(kNormal))
        return front;
    vec2 uv = placed(kNormal, inUvs);
    vec3 texel = normalTexelAt(uv);
    if ((push.flags & kDrawTangents) != 0u)
        return mappedNormal(front, inNormal, inTangent, texel);
    return mappedNormalHere(front, inPosition, uv, texel);
}

/// Where a normal map's +X points: as the vertices have it, else as the texture coordinates lie at this pixel.
vec3 shownTangent(vec3 front) {
    if ((push.flags & kDrawTangents) != 0u)
        return normalize(inTangent.xyz);
    return mappedNormalHere(front, inPosition, placed(kNormal, inUvs), vec3(1.0, 0.0, 0.0));
}

/// Which way highlights are stretched: along the surface's tangents, else as the texture coordinates lie at this pixel.
vec3 stretchHere(Layers layers, vec3 front) {
    if (!materialHas(kMaterialAnisotropy) || kView != kViewShaded)
        return vec3(0.0);
    if ((push.flags & kDrawTangents) != 0u)
        return stretchedAlong(layers, front, inTangent.xyz, inTangent.w);
    return mappedNormalHere(front, inPosition, placed(kAnisotropy, inUvs), vec3(layers.stretch.xy, 0.0));
}

/// The material, or what the view paints in its place.
Material paintedMaterial(vec3 albedo) {
    if (kView == kViewPatches && push.domain != kDrawMesh) {
        uint number = inPatch & ~kPatchIsMirrored;
        vec3 color = fromSrgb(unpackUnorm4x8(kClassColors[patchWords[kPatchWords * number]]).bgr);
        return plainMaterial(color * (1.0 + 0.34 * (patchHash(number) - 0.5)), 0.5);
    }
    return kView == kViewShaded || isFlatView(kView) ? materialAt(albedo, inUvs) : plainMaterial(kClay, 0.55);
}

void main() {
    vec3 v = normalize(frame.eye.xyz - inPosition);
    // A vanishing normal (a collapsed pole) takes the triangle's own.
    vec3 flatNormal = cross(dFdx(inPosition), dFdy(inPosition));
    vec3 front = normalize(dot(inNormal, inNormal) > 1e-6 ? inNormal : flatNormal);
    bool back = gl_FrontFacing == ((inPatch & kPatchIsMirrored) != 0u);
    vec3 n = back ? -front : front;
    vec4 base = baseColorAt(inUvs, inColor);
    Material material = paintedMaterial(base.rgb);
    vec3 mapped = kView == kViewShaded ? normalFromMap(front) : front;
    vec3 coat = front;
    if (kView == kViewShaded && materialHas(kMaterialClearcoat) && kClearcoatNormalSlot != kNoLayerSlot) {
        vec2 uv = placed(kClearcoatNormal, inUvs);
        coat = mappedNormalHere(front, inPosition, uv, clearcoatTexelAt(uv));
    }
    if (back) {
        mapped = -mapped; // seen from behind, a bump is a dent
        coat = -coat;
    }
    Layers layers = layersAt(inUvs);
    vec3 stretch = stretchHere(layers, front);
    vec3 segments = fwidth(inGrid);
    vec3 flatly = vec3(0.0);
    if (isFlatView(kView)) {
        vec3 tangent = kView == kViewTangents ? shownTangent(front) : vec3(0.0);
        flatly = flatColor(kView, base, material, inUvs, tangent, inColor.rgb, inTangent.x);
        if (isShadedFlat(kView))
            flatly *= formShade(kView, n, v);
    }
    vec2 striped = hasStripes(kView) ? stripesAt(kView, inPosition, n) : vec2(0.0);
    float trim = 1.0, covered = 1.0;
    if (materialHas(kMaterialTrim)) {
        trim = trimValue(inTrim);
        if ((push.flags & kDrawCoverage) != 0u)
            covered = suppleTrimCoverage(trim, materialData.cutoff);
    }
    // All that asks for neighboring pixels is done: some may end here.
    float opacity = materialHas(kMaterialTranslucent) ? base.a : 1.0;
    if (isLeftOut(opacity * (1.0 - layers.transmission)) || isOtherSide(back))
        discard;
    float alpha = kView == kViewShaded && materialHas(kMaterialTranslucent) ? base.a : 1.0;
    if (materialHas(kMaterialTrim)) {
        alpha *= covered;
        if ((push.flags & kDrawCoverage) == 0u && suppleTrimmed(trim, materialData.cutoff))
            discard;
    }

    vec3 color;
    if (kView == kViewNormals) {
        color = fromSrgb(front * 0.5 + 0.5);
    } else if (hasStripes(kView)) {
        color = stripes(striped, n, v);
    } else if (isFlatView(kView)) {
        color = flatly;
    } else if (kView == kViewShaded && materialHas(kMaterialUnlit)) {
        color = base.rgb;
    } else {
        // The inside of a skin that is not meant to be seen: still there, but plainly inside.
        if (back && !materialHas(kMaterialDoubleSided) && (push.flags & kDrawBothSides) == 0u)
            material.albedo *= 0.35;
        Incident light = Incident(inSky, inKeyRimOpen.x, inKeyRimOpen.y, inKeyRimOpen.z);
        if (!kLightPerVertex)
            light = gatherLight(inPosition, n, kLookAsFits, pixelNoise(gl_FragCoord.xy));
        else if (areCones() && verticesDisagree())
            light = gatherLight(inPosition, n, kLookIntoCones, pixelNoise(gl_FragCoord.xy));
        Place place = Place(inPosition, mapped, coat, n, v, stretch, pixelNoise(gl_FragCoord.xy));
        if (kView == kViewShaded && isLayered())
            color = layeredColor(material, layeredShade(material, layers, light, place), alpha);
        else
            color = studioTone(material, studioShade(material, light, mapped, n, v));
    }

    bool lines = push.domain != kDrawMesh;
    if (kView == kViewWire && lines)
        color = mix(color, vec3(0.012, 0.016, 0.025), 0.72 * gridLines(inGrid, segments, 0.9 * frame.pixelScale));
    if (kView == kViewWire && lines)
        color = mix(color, vec3(0.78, 0.22, 0.035), borderLine(insideBorder(), segments, float(push.rate), 1.1 * frame.pixelScale));
    else if ((kView == kViewPatches || kView == kViewLevels) && lines)
        color = mix(color, vec3(0.01, 0.012, 0.018), 0.85 * borderLine(insideBorder(), segments, float(push.rate), 0.9 * frame.pixelScale));
    outColor = vec4(color, alpha);
}
