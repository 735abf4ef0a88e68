// What a record says of an irregular quad, and its sides (docs/catmull_clark.md, "Borders"). Before the include: tables.glsl, basis.glsl,
// frame.glsl, net.glsl, what chain_place.glsl needs, and
//   const bool kSharp                                 whether sides may be creases
#include "shaders/chains/leaf.glsl"
#include "shaders/chains/chain_place.glsl"

struct IrregularQuad {
    uvec4 points, spokes, netLists;
    vec4 sharpness;
    uint flags, first; // what its net counts from
    uvec4 normals;
};
// `end`: the last element of its net.
bool isSharpNet(uvec4 end) { return halfOf(end.x, kNetListSharp) != 0u; }
IrregularQuad quadOf(uint record) {
    uvec4 spokes = tableElement(record + 1u), end = tableElement(record + kQuadNetElement + kNetListElements - 1u);
    vec4 sharpness = vec4(0.0);
    if (kSharp && isSharpNet(end)) sharpness = uintBitsToFloat(tableElement(record + kQuadSharpnessElement));
    return IrregularQuad(tableElement(record), spokes, tableElement(record + kQuadNetListElement), sharpness, end.w,
                         end.w >> kNetFirstShift, normalsBefore(spokes, end.yz));
}
// Point k of the quad's own net.
vec3 ownPoint(const PatchPlace at, uint first, uint k) { return poolPoint(at, first + netListPoint(at.record + kQuadNetElement, k)); }
float sharpnessOf(IrregularQuad quad, uint side, uint level) {
    vec2 pair = SELECT2(side < 2u, quad.sharpness.xy, quad.sharpness.zw);
    return kSharp ? softened(SELECT((side & 1u) == 0u, pair.x, pair.y), level - 1u) : 0.0;
}
bool isCubic(IrregularQuad quad, uint side) { return (quad.flags >> (kCubicSide + side) & 1u) != 0u; }
bool hasChain(IrregularQuad quad, uint corner) { return componentOf(quad.netLists, corner) != 0u; }

Chain chainOf(const PatchPlace at, IrregularQuad quad, uint corner) {
    return chainOf(at, componentOf(quad.netLists, corner), componentOf(quad.spokes, corner), kNetListLastWord);
}

// Where a corner of the quad lies, without a branch.
bool isRight(uint corner) { return ((corner + 1u) & 2u) != 0u; }
bool isUpper(uint corner) { return corner >= 2u; }
// The frame of the quad, of derivatives along a corner's two edges.
Frame turnedFrame(uint corner, vec3 da, vec3 db) {
    bool odd = (corner & 1u) != 0u;
    vec3 du = odd ? db : da, dv = odd ? da : db;
    return Frame(SELECT3(isRight(corner), -du, du), SELECT3(isUpper(corner), -dv, dv), cross(da, db));
}
Frame withStoredNormal(const PatchPlace at, IrregularQuad quad, uint corner, Frame frame) {
    uint normal = componentOf(quad.normals, corner);
    if (normal == kNoNormal) return frame;
    return withNormal(frame, poolPoint(at, normal));
}

// A border that is one cubic, between two plain ends; the side runs from its corner to the next. Of another side, whose ends may
// have chains in the place of spokes, nothing is to be used: what it reads lies in the pool.
vec3[4] sideCubic(const PatchPlace at, IrregularQuad quad, uint side) {
    uint next = (side + 1u) & 3u;
    vec3 a = poolPoint(at, componentOf(quad.points, side)), b = poolPoint(at, componentOf(quad.points, next));
    uint spokes = isCubic(quad, side) ? 0xFFFFFFFFu : 0u;
    precise vec3 aTangent = a + poolPoint(at, header.tangents + (SUPPLE_SPOKE(componentOf(quad.spokes, side)) & spokes));
    precise vec3 bTangent = b + poolPoint(at, header.tangents + (SUPPLE_NEXT_SPOKE(componentOf(quad.spokes, next)) & spokes));
    return vec3[4](a, aTangent, bTangent, b);
}
// `pair`: along the quad's own parameter.
vec3 onCubic(vec3 g[4], uint side, vec2 pair) {
    return sum4(bernstein3(side < 2u ? pair : pair.yx), g[0], g[1], g[2], g[3]);
}
// Inside a quad no neighbor looks: a sum there need not read the same backwards.
vec3 sumInside(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r = w.x * a;
    r = fma(vec3(w.y), b, r);
    r = fma(vec3(w.z), c, r);
    r = fma(vec3(w.w), d, r);
    return r;
}
vec3 placed(vec3 origin, vec3 first, vec3 offset) {
    precise vec3 p = origin + (first + offset);
    return p;
}
