// Levels of edges: what both patches at an edge draw it with, from its curve alone (docs/lod.md, "Levels"). One invocation
// an edge and instance, once for both sides; every expression reads the same from either end, so that an edge that two
// patches know by different coefficients of equal value has one level all the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS LodPush
#include "shaders/shared/lod.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/lod/levels.glsl"

// An edge: its ends, its length, and the larger second difference of its cubic.
struct EdgeCurve {
    vec3 x0, x1;
    float curveLength, bend;
};

EdgeCurve cubicCurve(uvec4 indices) {
    vec3 x0 = poolVector(indices.x), o0 = poolVector(indices.y), o1 = poolVector(indices.z), x1 = poolVector(indices.w);
    precise vec3 t0 = x0 + o0, t1 = x1 + o1;
    precise vec3 bend0 = (x0 + t1) - 2.0 * t0, bend1 = (x1 + t0) - 2.0 * t1;
    precise vec3 chord = x1 - x0, inner = t1 - t0;
    precise float curveLength = 0.5 * (((lengthOf(o0) + lengthOf(o1)) + lengthOf(inner)) + lengthOf(chord));
    // A polar patch's side at the apex, whose coefficients are all the apex, is a point.
    if (indices.x == indices.y) curveLength = 0.0;
    return EdgeCurve(x0, x1, curveLength, max(lengthOf(bend0), lengthOf(bend1)));
}

// Any other curve is measured at its quarters: second differences at a step h are those of a cubic times 6 h^2.
EdgeCurve quarteredCurve(vec3 p[5]) {
    precise vec3 s0 = p[1] - p[0], s1 = p[2] - p[1], s2 = p[3] - p[2], s3 = p[4] - p[3];
    precise float curveLength = (lengthOf(s0) + lengthOf(s3)) + (lengthOf(s1) + lengthOf(s2));
    precise vec3 b1 = (p[0] + p[2]) - 2.0 * p[1], b2 = (p[1] + p[3]) - 2.0 * p[2], b3 = (p[2] + p[4]) - 2.0 * p[3];
    precise float bend = max(max(lengthOf(b1), lengthOf(b3)), lengthOf(b2)) * (16.0 / 6.0);
    return EdgeCurve(p[0], p[4], curveLength, bend);
}

// Sets p[k]. Lanes have p in registers, which k cannot index. With k in a loop there is a third of the code to compile.
void setQuarter(inout vec3 p[5], uint k, vec3 point) {
    [[unroll]] for (uint i = 1u; i < 4u; ++i) p[i] = i == k ? point : p[i];
}

#if defined(CHARTS)
// The border is the blend of two charts.
const bool kSharp = true;
#include "shaders/blend/blend.glsl"

// What an end gives to the point at a distance t from it.
vec3 endShare(uvec4 end, vec3 c[9], float t) {
    vec3 offset, dx, dy;
    ChartPoint at = chartPoint(vec2(t, 0.0), uintBitsToFloat(end.w), (end.x & kCreasedChart) != 0u,
                               vec4(uintBitsToFloat(end.yz), 0.0, 0.0));
    localGeometry(c, at, offset, dx, dy);
    precise vec3 p = hermite(t).x * (c[0] + offset);
    return p;
}

EdgeCurve curveOf(uint base, uint edge) {
    uvec4 end0 = tableElement(push.table + 2u * edge), end1 = tableElement(push.table + 2u * edge + 1u);
    vec3 c0[9], c1[9];
    for (uint c = 0u; c < 9u; ++c) {
        c0[c] = poolVector(base + (end0.x & kPoolIndexMask) + c);
        c1[c] = poolVector(base + (end1.x & kPoolIndexMask) + c);
    }
    precise vec3 p1 = endShare(end0, c0, 0.25) + endShare(end1, c1, 0.75);
    precise vec3 p2 = endShare(end0, c0, 0.5) + endShare(end1, c1, 0.5);
    precise vec3 p3 = endShare(end0, c0, 0.75) + endShare(end1, c1, 0.25);
    return quarteredCurve(vec3[5](c0[0], p1, p2, p3, c1[0]));
}
#elif defined(HALVES)
// The border is two halves of an irregular quad (docs/catmull_clark.md, "Borders").
#include "shaders/shared/chains.h"
#include "shaders/surface/net.glsl"
#include "shaders/evaluate/basis.glsl"
const bool kTangents = false, kSharp = true;
#include "shaders/evaluate/frame.glsl"

struct PatchPlace {
    uint record, base;
};
vec3 poolPoint(const PatchPlace at, uint i) { return poolVector(at.base + i); }
#include "shaders/catmull_clark/sample.glsl"

EdgeCurve curveOf(uint base, uint edge) {
    uvec4 words = tableElement(push.table + edge);
    PatchPlace at = PatchPlace(words.x, base);
    IrregularQuad quad = quadOf(at.record);
    uint side = words.y;
    vec3 p[5];
    p[0] = poolPoint(at, componentOf(quad.points, side < 2u ? side : (side + 1u) & 3u));
    p[4] = poolPoint(at, componentOf(quad.points, side < 2u ? side + 1u : side));
    uint k = 1u;
    [[dont_unroll]] do {
        setQuarter(p, k, pointOnHalves(at, quad, side, vec2(0.25 * float(k), 1.0 - 0.25 * float(k))));
    } while (++k < 4u);
    return quarteredCurve(p);
}
#elif defined(TRIANGLES)
// The border is that of a Loop patch (docs/loop.md): one curve, or two halves.
layout(constant_id = kKindConstant) const uint kMeasures = kMeasuresWholeSides;
#include "shaders/shared/chains.h"
#include "shaders/surface/net.glsl"
const bool kTangents = false, kSemiSharp = kMeasures == kMeasuresSharpHalves;
#include "shaders/evaluate/frame.glsl"

struct PatchPlace {
    uint record, base;
};
vec3 poolPoint(const PatchPlace at, uint i) { return poolVector(at.base + i); }
#include "shaders/loop/sample.glsl"

EdgeCurve curveOf(uint base, uint edge) {
    uvec4 words = tableElement(push.table + edge);
    PatchPlace at = PatchPlace(words.x, base);
    uint side = words.y;
    const bool kHalves = kMeasures != kMeasuresWholeSides;
    Triangle t = triangleOf(at.record, kHalves);
    LeafSide whole;
    if (!kHalves) whole = leafSide(cageLeaf(at, t), side, false, hasFlag(t, kSharpTriangleSide, side));
    vec3 p[5];
    p[0] = cornerLimit(at, t, side);
    p[4] = cornerLimit(at, t, nextOf(side));
    uint k = 1u;
    [[dont_unroll]] do {
        vec2 along = vec2(0.25 * float(k), 1.0 - 0.25 * float(k));
        setQuarter(p, k, kHalves ? pointOnHalves(at, t, pointOnSide(side, along)) : onSide(whole, along));
    } while (++k < 4u);
    return quarteredCurve(p);
}
#else
EdgeCurve curveOf(uint base, uint edge) { return cubicCurve(base + tableElement(push.table + edge)); }
#endif

void main() {
    uint item = itemOfLane(), instance = instanceOf(item), edge = elementOf(item), base = poolBase(instance);
    EdgeCurve curve = curveOf(base, edge);
    edge += push.first;
    vec3 x0 = curve.x0, x1 = curve.x1;
    precise vec3 middle = (x0 + x1) * 0.5;
    precise float radius = 0.5 * curve.curveLength;
    float level = levelOf(curve.curveLength, curve.bend, pixelsPerUnit(middle, radius));
    scratchWords.at[levelBase(instance) + edge] = floatBitsToUint(level);
    if (edge == 0u && header.depths != 0u) scratchWords.at[levelBase(instance) + header.depths] = 0u; // what patches raise
}
