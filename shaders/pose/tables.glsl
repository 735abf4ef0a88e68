// Bindings and loads of the pose pass.
#include "shaders/shared/deform.h"
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/pose.h"

layout(push_constant) uniform Push { PosePush push; };
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

layout(set = 0, binding = kClipTableBinding, std430) readonly buffer Table { uvec4 tableElements[]; };
layout(set = 0, binding = kClipTableTexelBinding) uniform usamplerBuffer tableTexels;
layout(set = 0, binding = kStateBinding, std430) readonly buffer States { uvec4 stateElements[]; };
layout(set = 0, binding = kStateTexelBinding) uniform usamplerBuffer stateTexels;
layout(set = 0, binding = kMaskBinding, std430) readonly buffer Masks { vec4 maskElements[]; };
layout(set = 0, binding = kMaskTexelBinding) uniform samplerBuffer maskTexels;
layout(set = 0, binding = kPosedBinding, std430) writeonly buffer Posed { vec4 posed[]; };

uvec4 table(uint i) {
    if (kWide) return tableElements[i];
    return texelFetch(tableTexels, int(i));
}
uvec4 state(uint i) {
    if (kWide) return stateElements[i];
    return texelFetch(stateTexels, int(i));
}
vec4 maskValues(uint i) {
    if (kWide) return maskElements[i];
    return texelFetch(maskTexels, int(i));
}
vec4 tableFloats(uint i) { return uintBitsToFloat(table(i)); }
vec4 stateFloats(uint i) { return uintBitsToFloat(state(i)); }

float component(vec4 v, uint k) {
    vec2 two = (k & 2u) == 0u ? v.xy : v.zw;
    return (k & 1u) == 0u ? two.x : two.y;
}
// The i-th of floats packed from an element on.
float packedFloat(uint first, uint i) { return component(tableFloats(first + i / 4u), i & 3u); }
