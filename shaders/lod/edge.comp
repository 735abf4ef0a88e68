// Levels of edges: what both patches at an edge draw it with, from its boundary cubic alone (docs/lod.md, section 4). One
// invocation an edge and instance, once for both sides; every expression reads the same from either end, so that an edge
// that two patches know by different coefficients of equal value has one level all the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS LodPush
#include "shaders/shared/lod.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/lod/levels.glsl"

void main() {
    uint id = min(invocationIndex(), push.count * instanceCount() - 1u);
    uint entry = id / push.count, instance = instanceSlot(entry), edge = id - entry * push.count;
    uvec4 curve = instance * push.poolStride + tableElement(push.edges + edge);
    vec3 x0 = poolVector(curve.x), o0 = poolVector(curve.y), o1 = poolVector(curve.z), x1 = poolVector(curve.w);
    precise vec3 t0 = x0 + o0, t1 = x1 + o1, middle = (x0 + x1) * 0.5;
    precise vec3 bend0 = (x0 + t1) - 2.0 * t0, bend1 = (x1 + t0) - 2.0 * t1;
    precise vec3 chord = x1 - x0, inner = t1 - t0;
    precise float curveLength = 0.5 * (((lengthOf(o0) + lengthOf(o1)) + lengthOf(inner)) + lengthOf(chord));
    precise float radius = 0.5 * curveLength;
    // A polar patch's side at the apex, whose coefficients are all the apex, is a point.
    float level = curve.x == curve.y ? 0.0 : levelOf(curveLength, max(lengthOf(bend0), lengthOf(bend1)), pixelsPerUnit(middle, radius));
    scratchWords[levelBase(instance) + edge] = floatBitsToUint(level);
}
