// Two sums over words, each of a mix of the word and its place (docs/recording.md).
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/instances.h"
#include "shaders/shared/word_hash.h"

layout(set = 0, binding = kHashedWordBinding, std430) readonly buffer Words { uint at[]; } words;
layout(set = 0, binding = kHashListBinding, std430) readonly buffer List { uint at[]; } list;
layout(set = 0, binding = kHashSumBinding, std430) buffer Sums { uint at[]; } sums;

uvec2 hashOf(uint word, uint place) {
    const uvec2 kOdd = uvec2(0x9E3779B1u, 0x85EBCA77u);
    uvec2 h = uvec2(word) ^ ((uvec2(place) + uvec2(0u, 0x165667B1u)) * kOdd);
    h ^= h >> 16u;
    h *= 0x85EBCA6Bu;
    h ^= h >> 13u;
    h *= 0xC2B2AE35u;
    h ^= h >> 16u;
    h = ((h + uvec2(place)) * kOdd) ^ uvec2(word >> 7u);
    h ^= h >> 15u;
    h *= 0x2C1B3C6Du;
    return h ^ (h >> 12u);
}

void addTo(uint target, uvec2 sum) {
    atomicAdd(sums.at[2u * target], sum.x);
    atomicAdd(sums.at[2u * target + 1u], sum.y);
}
