// What an instance says of its crease sets (shared/surface.h). Needs tables.glsl.
LOADED_BUFFER(vec4, creaseAlphas, Alphas, kAlphaBinding, samplerBuffer, kAlphaTexelBinding, xyzw)
// By the set's number + 1. Negative for 0, and where the instance leaves the edge its own.
float alphaOfSet(uint instance, uint set) {
    if (set == 0u) return -1.0;
    vec4 four = creaseAlphas(instance * kCreaseSetElements + (set - 1u) / 4u);
    uint k = (set - 1u) % 4u;
    vec2 two = SELECT2(k < 2u, four.xy, four.zw);
    return SELECT((k & 1u) == 0u, two.x, two.y);
}
