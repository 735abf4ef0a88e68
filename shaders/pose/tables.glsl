// Bindings and loads of the pose pass.
#include "shaders/shared/deform.h"
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/pose.h"

#define PUSH_CONSTANTS PosePush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

BUFFER(writeonly, Posed, kPosedBinding, std430, vec4, posed)

LOADED_BUFFER(uvec4, table, Table, kClipTableBinding, usamplerBuffer, kClipTableTexelBinding, xyzw)
LOADED_BUFFER(uvec4, state, States, kStateBinding, usamplerBuffer, kStateTexelBinding, xyzw)
LOADED_BUFFER(vec4, maskValues, Masks, kMaskBinding, samplerBuffer, kMaskTexelBinding, xyzw)
vec4 tableFloats(uint i) { return uintBitsToFloat(table(i)); }
vec4 stateFloats(uint i) { return uintBitsToFloat(state(i)); }

float component(vec4 v, uint k) {
    vec2 two = SELECT2((k & 2u) == 0u, v.xy, v.zw);
    return SELECT((k & 1u) == 0u, two.x, two.y);
}
// The i-th of floats packed from an element on.
float packedFloat(uint first, uint i) { return component(tableFloats(first + i / 4u), i & 3u); }
