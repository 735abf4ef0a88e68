// Two sums over words, each of a mix of the word and its place (docs/recording.md).
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/instances.h"
#include "shaders/shared/word_hash.h"

layout(set = 0, binding = kHashedWordBinding, std430) readonly buffer Words { uint at[]; } words;
layout(set = 0, binding = kHashListBinding, std430) readonly buffer List { uint at[]; } list;
layout(set = 0, binding = kHashSumBinding, std430) buffer Sums { uint at[]; } sums;

uvec2 hashOf(uint word, uint place) { return uvec2(lowWordMix(word, place), highWordMix(word, place)); }

void addTo(uint target, uvec2 sum) {
    atomicAdd(sums.at[2u * target], sum.x);
    atomicAdd(sums.at[2u * target + 1u], sum.y);
}
