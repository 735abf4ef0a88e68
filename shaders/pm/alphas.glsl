// What an instance says of its crease sets (shared/surface.h). Needs tables.glsl.
LOADED_BUFFER(vec4, creaseAlphas, Alphas, kAlphaBinding, samplerBuffer, kAlphaTexelBinding, xyzw)
// By the set's number + 1. Negative for 0, and where the instance leaves the edge its own.
float alphaOfSet(uint instance, uint set) {
    if (set == 0u) return -1.0;
    return creaseAlphas(instance * kCreaseSetElements + (set - 1u) / 4u)[(set - 1u) % 4u];
}
