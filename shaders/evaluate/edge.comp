// Indexed mesh: evaluates the samples along edges, each once, and at corners, each with one of the edges that begin there. An
// edge comes from one of its patches, which it has on its left. Positions come from the border's cubic by the operations of the
// patches' own evaluation, and thus have the same bits. Normals come from the border and from what lies one step inside. Narrow
// mapping: one lane per edge. Wide mapping: one lane per sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS EdgePush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/pm/border.glsl"
#include "shaders/shared/pm.h"

layout(constant_id = kKindConstant) const uint kEdges = kPlainEdges;
layout(constant_id = kCornerNormalsConstant) const bool kCornerNormals = false;

const bool kPerturbed = kEdges == kPerturbedEdges;
const bool kMixed = kEdges == kMixedEdges;

// Derivatives along and across the border have lost a common factor, and come from offsets alone: beside sharp creases they
// are small. `across` are the coefficients of a cubic that points inwards.
struct Edge {
    vec3 border[4];
    vec3 along[3];
    vec3 across[4];
    vec3 h[4];        // perturbation: h20 h30 on the border, h21 h31 beside it
    vec3 firstNormal; // of the beginning, where a perturbation vanishes
    bool singular;    // there both derivatives lie on one line
    float perAlong;   // factor that `along` has lost, of what `across` has
};

vec3 placed(vec3 corner, vec3 offset) {
    precise vec3 p = corner + offset;
    return p;
}

Edge loadEdge(uint record, uvec4 own, uint base) {
    uvec4 border = base + tableElement(record), inside = base + tableElement(record + 1u);
    vec3 v0 = poolVector(border.x), t0 = poolVector(border.y), t1 = poolVector(border.z), v1 = poolVector(border.w);
    vec3 q0 = poolVector(inside.x), q1 = poolVector(inside.y), q2 = poolVector(inside.z), q3 = poolVector(inside.w);
    Edge e;
    e.border = vec3[4](v0, placed(v0, t0), placed(v1, t1), v1);
    vec3 chord = v1 - v0;
    e.along = alongBorder(chord, t0, t1);
    e.across = vec3[4](q0, q1 - t0, q2 - t1, q3);
    vec3 firstNormal = cross(t0, q0); // outwards
    e.singular = false;
    e.perAlong = 1.0;
    if (kMixed) {
        vec3 a[4] = e.across;
        // Towards the apex of a polar patch the derivative across has the factor that is the distance to it: without it,
        // it is of degree 2, here raised to 3.
        if ((own.z & kApexLastEdge) != 0u)
            e.across = vec3[4](a[0], a[0] * (1.0 / 3.0) + a[1], a[1] + a[2], 3.0 * a[2]);
        if ((own.z & kApexFirstEdge) != 0u)
            e.across = vec3[4](3.0 * a[1], a[1] + a[2], a[3] * (1.0 / 3.0) + a[2], a[3]);
        uint sides = own.z & kEdgeSidesMask;
        float ray = sides == 3u ? SUPPLE_PM_RAY_SIDE(3u) : sides == 4u ? SUPPLE_PM_RAY_SIDE(4u) : SUPPLE_PM_RAY_SIDE(5u);
        if (sides != 0u) e.across = acrossSector(ray, chord, t0, t1, q0, q3, q1, q2);
        if (sides != 0u) e.perAlong = 0.75; // cubics along, quartics across
        firstNormal = cross(e.along[0], e.across[0]);
        e.singular = (own.z & kSingularEdge) != 0u;
        if (e.singular)
            firstNormal = singularNormal(ray, chord, t0, t1, e.across[0], q1, poolVector(base + own.w));
    }
    if (kCornerNormals && (own.z & kStoredNormalEdge) != 0u) firstNormal = poolVector(base + own.w);
    e.firstNormal = firstNormal;
    if (kPerturbed) {
        uint swap = (own.z & kSwappedEdge) != 0u ? 1u : 0u, h = base + own.w;
        for (uint s = 0u; s < 4u; ++s) e.h[s] = poolVector(h + (s ^ swap));
    }
    return e;
}

// Its derivatives along and across the border.
Frame finish(Edge e, vec2 t, out vec3 position) {
    vec4 b = bernstein3(t);
    precise vec3 p = sum4(b, e.border[0], e.border[1], e.border[2], e.border[3]);
    vec3 along = t.y * t.y * e.along[0] + 2.0 * t.x * t.y * e.along[1] + t.x * t.x * e.along[2];
    vec3 across = blend4(b, e.across[0], e.across[1], e.across[2], e.across[3]);
    if (kPerturbed) {
        Basis5 b5 = bernstein5(t), d5 = bernsteinDerivative5(t);
        precise vec3 h = sum2(b5.inner, e.h[0], e.h[1]);
        p = p + h;
        along += (1.0 / 3.0) * blend2(d5.inner, e.h[0], e.h[1]);
        across += (5.0 / 3.0) * blend2(b5.inner, e.h[2] - e.h[0], e.h[3] - e.h[1]);
    }
    position = p;
    return Frame(e.perAlong * along, across, cross(along, across)); // outwards
}

void storeBeginning(Edge e, uint vertex, uint own) {
    Frame f = Frame(e.perAlong * e.along[0], e.across[0], e.firstNormal);
    if (kTangents) {
        vec3 position;
        if (e.singular) f = finish(e, vec2(SUPPLE_PM_SINGULAR_STEP, 1.0 - SUPPLE_PM_SINGULAR_STEP), position);
        f = withNormal(f, e.firstNormal);
    }
    storeSurfaceVertex(vertex, own, e.border[0], f);
}

void evaluateNarrow() {
    uint item = itemOfLane(), instance = instanceOf(item), record = push.table + elementOf(item) * kEdgeElements;
    uvec4 own = tableElement(record + 2u);
    Edge e = loadEdge(record, own, instance * header.poolStride);
    uint first = instance * push.verticesPerInstance;
    if (own.x != kNoEdgeSample) storeBeginning(e, first + push.firstCorner + own.x, push.firstCorner + own.x);
    uint rate = fixedRate();
    if (rate == 1u) return;
    vec3 position;
    uint vertex = push.firstVertex + own.y * (rate - 1u), k = 1u;
    [[unroll]] do {
        Frame f = finish(e, parameterPair(k, rate), position);
        storeSurfaceVertex(first + vertex, vertex, position, f);
        ++vertex;
    } while (++k < rate);
}

void evaluateWide() {
    uint rate = fixedRate(), id = invocationIndex(), lanes = push.count * rate;
    if (id >= lanes * instanceCount()) return;
    uint entry = id / lanes, instance = instanceSlot(entry), lane = id - entry * lanes;
    uint edge = lane / rate, k = lane - edge * rate;
    uint record = push.table + edge * kEdgeElements;
    uvec4 own = tableElement(record + 2u);
    if (k == 0u && own.x == kNoEdgeSample) return;
    Edge e = loadEdge(record, own, instance * header.poolStride);
    uint first = instance * push.verticesPerInstance;
    if (k == 0u) {
        storeBeginning(e, first + push.firstCorner + own.x, push.firstCorner + own.x);
        return;
    }
    vec3 position;
    Frame f = finish(e, parameterPair(k, rate), position);
    uint vertex = push.firstVertex + own.y * (rate - 1u) + k - 1u;
    storeSurfaceVertex(first + vertex, vertex, position, f);
}

void main() {
    if (kWide) evaluateWide();
    else evaluateNarrow();
}
