// Bindings and loads the passes share. Loads go through one function each: storage buffers on GPUs, texel buffers on
// CPU devices, whose drivers gather texels without a loop over the lanes. A pass with push constants of its own defines
// PUSH_CONSTANTS before the include.
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/surface.h"

layout(set = 0, binding = kTableBinding, std430) readonly buffer Table4 { uvec4 tableElements[]; };
layout(set = 0, binding = kTableBinding, std430) readonly buffer Table1 { uint tableWords[]; };
layout(set = 0, binding = kTable4TexelBinding) uniform usamplerBuffer tableElementTexels;
layout(set = 0, binding = kTable1TexelBinding) uniform usamplerBuffer tableWordTexels;

#ifndef PUSH_CONSTANTS
#define PUSH_CONSTANTS SurfacePush
#endif
layout(push_constant) uniform Push { PUSH_CONSTANTS push; };
#include "shaders/shared/instances.glsl"

// A dispatch works on items: each is one of the `push.count` elements of one instance.
uint itemCount() { return push.count * instanceCount(); }
uint itemOfLane() { return min(invocationIndex(), itemCount() - 1u); } // idle lanes repeat the last
uint elementOf(uint item) { return item - item / push.count * push.count; }
uint entryOf(uint item) { return instanceEntry(item / push.count); }
uint instanceOf(uint item) { return instanceSlot(item / push.count); }

uvec4 tableElement(uint i) {
    if (kWide) return tableElements[i];
    return texelFetch(tableElementTexels, int(i));
}
uint tableWord(uint i) {
    if (kWide) return tableWords[i];
    return texelFetch(tableWordTexels, int(i)).x;
}
