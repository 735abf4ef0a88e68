// Where the samples of a Loop patch lie: of a grid, or with LEVELS of rings. Before the include: pairs.glsl, and what
// triangle_sample.glsl needs.
#include "shaders/loop/sample.glsl"

// Derivatives along two edges as those of a sector: along the side and towards the centre.
Frame ofSector(Frame f) { return Frame(f.du, (f.du + f.dv) / 3.0, f.normal); }

#ifdef LEVELS
// Where a sample of a ring lies.
TrianglePoint ringPoint(uint side, bool border, vec2 along, vec3 w) {
    if (border) return pointOnSide(side, along);
    float third = w.z / 3.0;
    vec3 own = vec3(w.x + third, w.y + third, third);
    vec3 weights = side == 0u ? own : side == 1u ? own.zxy : own.yzx;
    return TrianglePoint(weights, 0.0, kInside, vec2(0.0));
}
#else
TrianglePoint gridPoint(uvec2 at, uint rate) {
    uint rest = rate - at.x - at.y;
    uint side = at.y == 0u ? 0u : rest == 0u ? 1u : at.x == 0u ? 2u : kInside;
    if (side == 0u) return pointOnSide(0u, parameterPair(at.x, rate));
    if (side == 1u) return pointOnSide(1u, parameterPair(at.y, rate));
    if (side == 2u) return pointOnSide(2u, parameterPair(rest, rate));
    vec3 w = vec3(parameterPair(rest, rate).x, parameterPair(at.x, rate).x,
                  parameterPair(at.y, rate).x);
    return TrianglePoint(w, parameterPair(rate - max(max(at.x, at.y), rest), rate).x, kInside, vec2(0.0));
}
#endif
