// The coefficient pool, read and written. A pass that only reads it defines POOL_READ_ONLY before the include.
#ifdef POOL_READ_ONLY
BUFFER(readonly, Pool, kPoolBinding, std430, vec4, pool)
#else
BUFFER(, Pool, kPoolBinding, std430, vec4, pool)
#endif
#ifndef POOL_WRITE_ONLY
#ifdef WIDE
vec3 poolVector(uint i) { return pool.at[i].xyz; }
#else
layout(set = 0, binding = kPoolTexelBinding) uniform samplerBuffer poolTexels;
vec3 poolVector(uint i) { return texelFetch(poolTexels, int(i)).xyz; }
#endif
#endif
