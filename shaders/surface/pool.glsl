// The coefficient pool, read and written. A pass that only reads it defines POOL_READ_ONLY before the include. Needs tables.glsl.
#ifdef POOL_READ_ONLY
BUFFER(readonly, Pool, kPoolBinding, std430, vec4, pool)
#else
BUFFER(, Pool, kPoolBinding, std430, vec4, pool)
#endif
#ifndef POOL_WRITE_ONLY
#ifdef WIDE
vec4 poolElement(uint i) { return pool.at[i]; }
#else
layout(set = 0, binding = kPoolTexelBinding) uniform samplerBuffer poolTexels;
vec4 poolElement(uint i) { return texelFetch(poolTexels, int(i)); }
#endif
vec3 poolVector(uint i) { return poolElement(i).xyz; }
#endif
// Where the coefficients of the instance in a slot begin.
uint poolBaseIn(uint pools, uint instance) {
    if (pools == 0u) return instance * header.poolStride;
    uint place = min(instanceWord(pools + 2u * (push.window.firstSlot + instance)), push.window.lastPool);
    return place * kPoolUnit + push.window.firstCoefficient;
}
uint poolBase(uint instance) { return poolBaseIn(push.window.pools, instance); }
