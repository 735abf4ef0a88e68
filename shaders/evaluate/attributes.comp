// Surface attributes that no pose changes: UV and color, bilinear over each patch. Run once a group. One invocation a patch
// sample; output per sample (u, v, linear color as RG and BA in 16-bit unorm: 8 bits would band in
// the dark).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/prep/tables.glsl"
#include "shaders/evaluate/basis.glsl"

layout(set = 0, binding = kAttributeBinding, std430) writeonly buffer Attributes { uvec4 attributes[]; };

void main() {
    uint id = invocationIndex();
    if (id >= push.count) return;
    uint side = push.rate + 1u, samples = side * side;
    uint patchIndex = id / samples, sampleIndex = id - patchIndex * samples;
    uint j = sampleIndex / side, i = sampleIndex - j * side;
    vec2 u = parameterPair(i, push.rate, push.pairs), v = parameterPair(j, push.rate, push.pairs);
    vec4 w = vec4(u.y * v.y, u.x * v.y, u.x * v.x, u.y * v.x); // corners 0..3
    vec2 uv = vec2(0.0);
    vec4 color = vec4(0.0);
    for (uint k = 0u; k < 4u; ++k) {
        uvec4 corner = tableElement(push.table + 4u * patchIndex + k);
        uv += w[k] * uintBitsToFloat(corner.xy);
        color += w[k] * vec4(unpackUnorm2x16(corner.z), unpackUnorm2x16(corner.w));
    }
    attributes[id] = uvec4(floatBitsToUint(uv), packUnorm2x16(color.xy), packUnorm2x16(color.zw));
}
