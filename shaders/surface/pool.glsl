// The coefficient pool, read and written. A pass that only reads it defines POOL_READ_ONLY before the include.
#ifdef POOL_READ_ONLY
layout(set = 0, binding = kPoolBinding, std430) readonly buffer Pool { vec4 pool[]; };
#else
layout(set = 0, binding = kPoolBinding, std430) buffer Pool { vec4 pool[]; };
#endif
#ifndef POOL_WRITE_ONLY
layout(set = 0, binding = kPoolTexelBinding) uniform samplerBuffer poolTexels;

vec3 poolVector(uint i) {
    if (kWide) return pool[i].xyz;
    return texelFetch(poolTexels, int(i)).xyz;
}
#endif
