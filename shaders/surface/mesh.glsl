// The vertices of a mesh: of the cage, or of what steps of subdivision made of it, in the pool. Needs tables.glsl.
#include "shaders/surface/pool.glsl"
#include "shaders/surface/cage.glsl"

layout(constant_id = kKindConstant) const uint kFromPool = 0u;

vec3 vertexAt(uint instance, uint i) {
    if (kFromPool != 0u) return poolVector(instance * push.poolStride + i);
    return cageVertex(instance * push.cageStride + i);
}
