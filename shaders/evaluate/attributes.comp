// Surface attributes that no pose changes: UV sets and color, interpolated between the corners of each patch. Run once a
// group. One invocation a patch sample; output per sample (u, v, linear color as RG and BA in 16-bit unorm: 8 bits would
// band in the dark), and the second UV set and the face UVs where there are any.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface/tables.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/domain.glsl"

layout(constant_id = 3) const uint kDomain = kQuadDomain;

layout(set = 0, binding = kAttributeBinding, std430) writeonly buffer Attributes { uvec4 attributes[]; };
layout(set = 0, binding = kUv1Binding, std430) writeonly buffer Uvs1 { vec2 uvs1[]; };
layout(set = 0, binding = kFaceUvBinding, std430) writeonly buffer FaceUvs { vec2 faceUvs[]; };

const uint kCorners = kDomain == kPentagonDomain ? 5u : kDomain == kQuadDomain ? 4u : 3u;

// Linear on triangles, bilinear on quads; pentagons are linear between an edge and the centre, the mean of the corners;
// on polar patches the corner at the apex takes over linearly.
float[5] cornerWeights(uint index) {
    uvec3 at = uvec3(index % (push.rate + 1u), index / (push.rate + 1u), 0u);
    if (kDomain == kTriangleDomain) at.xy = triangleSample(push.rate + 1u, index);
    if (kDomain == kPentagonDomain) at = pentagonSample(push.rate, index);
    vec2 u = parameterPair(at.x, push.rate, push.pairs), v = parameterPair(at.y, push.rate, push.pairs);
    if (kDomain == kQuadDomain) return float[5](u.y * v.y, u.x * v.y, u.x * v.x, u.y * v.x, 0.0);
    if (kDomain == kPolarDomain) return float[5](u.y * v.y, u.x * v.y, v.x, 0.0, 0.0);
    float rest = parameterPair(push.rate - at.x - at.y, push.rate, push.pairs).x;
    if (kDomain == kTriangleDomain) return float[5](rest, u.x, v.x, 0.0, 0.0);
    float w[5];
    for (uint k = 0u; k < 5u; ++k)
        w[k] = v.x * 0.2 + (k == at.z ? rest : 0.0) + (k == (at.z + 1u) % 5u ? u.x : 0.0);
    return w;
}

void main() {
    uint id = invocationIndex();
    if (id >= push.count) return;
    uint patchIndex = id / push.samples;
    float w[5] = cornerWeights(id - patchIndex * push.samples);
    bool second = push.uvSets == 2u, face = push.faceUvs != 0u;
    uint elements = second || face ? 2u : 1u;
    vec2 uv = vec2(0.0);
    vec4 more = vec4(0.0);
    vec4 color = vec4(0.0);
    for (uint k = 0u; k < kCorners; ++k) {
        uint element = push.table + elements * (kCorners * patchIndex + k);
        uvec4 corner = tableElement(element);
        uv += w[k] * uintBitsToFloat(corner.xy);
        color += w[k] * vec4(unpackUnorm2x16(corner.z), unpackUnorm2x16(corner.w));
        if (elements == 2u) more += w[k] * uintBitsToFloat(tableElement(element + 1u));
    }
    attributes[push.firstVertex + id] = uvec4(floatBitsToUint(uv), packUnorm2x16(color.xy), packUnorm2x16(color.zw));
    if (second) uvs1[push.firstVertex + id] = more.xy;
    if (face) faceUvs[push.firstVertex + id] = more.zw;
}
