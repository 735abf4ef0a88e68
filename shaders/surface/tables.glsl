// Bindings and loads of the surface passes. A pass says in PUSH_CONSTANTS what its push constants are; where it does not, it is
// evaluation, at a rate or with LEVELS at levels.
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/surface.h"

#ifndef PUSH_CONSTANTS
#ifdef LEVELS
#define PUSH_CONSTANTS LevelsPush
#else
#define PUSH_CONSTANTS EvaluatePush
#endif
#endif
#include "shaders/shared/push.glsl"
#include "shaders/shared/instances.glsl"

#ifdef TASKS
layout(buffer_reference, std430) readonly buffer Header { TableHeader words; };
TableHeader header = Header(bufferOfTask(kTableHeaderBinding)).words;
#else
layout(set = 0, binding = kTableHeaderBinding) uniform Header { TableHeader header; };
#endif

// A dispatch works on items: each is one of the `push.count` elements of one instance.
uint itemCount() { return push.count * instanceCount(); }
uint itemOfLane() { return min(invocationIndex(), itemCount() - 1u); } // idle lanes repeat the last
uint elementOf(uint item) { return item - item / push.count * push.count; }
uint entryOf(uint item) { return instanceEntry(item / push.count); }
uint instanceOf(uint item) { return instanceSlot(item / push.count); }

LOADED_BUFFER(uvec4, tableElement, Table4, kTableBinding, usamplerBuffer, kTable4TexelBinding, xyzw)
LOADED_BUFFER(uint, tableWord, Table1, kTableBinding, usamplerBuffer, kTable1TexelBinding, x)
// Number k of 16 bits, where a word holds two.
uint halfOf(uint word, uint k) { return word >> 16u * (k & 1u) & 0xFFFFu; }
