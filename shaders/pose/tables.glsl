// Bindings and loads of the pose pass.
#include "shaders/shared/deform.h"
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/pose.h"

#define PUSH_CONSTANTS PosePush
#include "shaders/shared/push.glsl"
#define INSTANCE_PUSH push
#include "shaders/shared/instances.glsl"

LOADED_BUFFER(uvec4, table, Table, kClipTableBinding, usamplerBuffer, kClipTableTexelBinding, xyzw)
LOADED_BUFFER(uvec4, state, States, kStateBinding, usamplerBuffer, kStateTexelBinding, xyzw)
LOADED_BUFFER(vec4, maskValues, Masks, kMaskBinding, samplerBuffer, kMaskTexelBinding, xyzw)
vec4 tableFloats(uint i) { return uintBitsToFloat(table(i)); }
vec4 stateFloats(uint i) { return uintBitsToFloat(state(i)); }

layout(constant_id = kListedConstant) const bool kListed = true;
layout(constant_id = kKeyedClipsConstant) const bool kKeyedClips = true;
layout(constant_id = kPackedClipsConstant) const bool kPackedClips = true;
layout(constant_id = kCoarseTwinsConstant) const bool kCoarseTwins = true;

// What is posed: an entry of the group's list of instances, at the group's time; in groups with update rates one of a list of
// their own, which says for which of the instance's ends, and at which time.
bool isListed() { return kListed && push.times != 0u; }
uint posedWord = 0u;
uint posedEntry = 0u;
vec2 posedSeconds = vec2(0.0);
void beginEntry(uint n) {
    posedEntry = n;
    posedWord = instanceEntry(n);
    posedSeconds = vec2(push.timeHigh, push.timeLow);
    if (isListed()) {
        uint word = push.times + 2u * n;
        posedSeconds = uintBitsToFloat(uvec2(instanceWord(word), instanceWord(word + 1u)));
    }
}
uint posedSlot() { return slotOf(posedWord); }
uint posedEnd() { return isListed() ? SUPPLE_POSED_END(posedWord) : 0u; } // 0: what is shown
uint firstOfEnd(uint slot, uint end) { return (slot * kPoseEnds + end - 1u) * push.endStride; }
// Nobody sees it: a step of what swings.
bool isStep() { return kListed && posedEntry >= push.shown; }
bool isShown() { return posedEnd() == 0u && !isStep(); }
// Where the pose of one that is not shown begins.
uint firstUnshown() {
    return isStep() ? (posedEntry - push.shown) * push.endStride : firstOfEnd(posedSlot(), posedEnd());
}
bool stepsHavePoses() { return (push.stepNodes & kStepsHavePoses) != 0u; }
// First element of what the instance plays.
uint posedState() {
    bool before = isListed() && (posedWord & kPosedBefore) != 0u;
    return posedSlot() * push.stateStride + (before ? push.stateBefore : 0u);
}
// Ends are in model space: mix.comp places them, as the host may move the instance while its ends stay.
bool isPlaced() { return posedEnd() == 0u; }
vec2 posedTime() { return posedSeconds; }

float component(vec4 v, uint k) {
    vec2 two = SELECT2((k & 2u) == 0u, v.xy, v.zw);
    return SELECT((k & 1u) == 0u, two.x, two.y);
}
// The i-th of floats packed from an element on.
float packedFloat(uint first, uint i) { return component(tableFloats(first + i / 4u), i & 3u); }
