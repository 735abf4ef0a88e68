// Indexed mesh: evaluates the samples along sides of irregular quads of exact Catmull-Clark patches, each once, and at corners, each
// with one of the sides that begin there (evaluate/edge.comp). Frames are those of the quad, turned so that the side comes first.
// Narrow mapping: one lane per side. Wide mapping: one lane per sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/shared/exact.h"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/surface/net.glsl"

const bool kChains = true, kSharp = true;

struct PatchPlace {
    uint record, base;
    uint first;   // vertex of the instance
    uint corner;  // vertices within the instance: the corner's, if it is stored, and the first along the side
    uint along;
    bool begins;  // the corner's is stored
};
PatchPlace placeOf(uint instance, uint record, uvec4 edge) {
    return PatchPlace(tableElement(record).x, instance * push.poolStride, instance * push.verticesPerInstance,
                      push.firstCorner + edge.x, push.firstVertex + edge.y * (fixedRate() - 1u), edge.x != kNoEdgeSample);
}
vec3 poolPoint(const PatchPlace at, uint i) { return poolVector(at.base + i); }

#ifndef WIDE
const bool kInside = false;
const uint kSides = 1u;
uint last;
void store(const PatchPlace at, bool own, uint i, uint j, vec3 position, Frame frame) {
    if (!own || (i == 0u && !at.begins)) return;
    uint to = i == 0u ? at.corner : at.along + i - 1u;
    storeSurfaceVertex(at.first + to, to, position, frame);
}
#include "shaders/exact/nets.glsl"

// Turned so that a side comes first.
uvec4 turned(uvec4 v, uint side) {
    uvec4 once = (side & 1u) != 0u ? v.yzwx : v;
    return (side & 2u) != 0u ? once.zwxy : once;
}
IrregularQuad turnedQuad(IrregularQuad quad, uint side) {
    uint flags = quad.flags >> kCubicSide & 15u;
    return IrregularQuad(turned(quad.points, side), turned(quad.spokes, side), turned(quad.windows, side), turned(quad.sizes, side),
                         uintBitsToFloat(turned(floatBitsToUint(quad.sharpness), side)),
                         (flags >> side | flags << (4u - side)) << kCubicSide, turned(quad.normals, side));
}
Net turnedNet(const PatchPlace at, uint side) {
    Net net;
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k) {
        uint place = SUPPLE_EXACT_NET_PLACE(side, k % kNetSide, k / kNetSide);
        net.p[k] = ownPoint(at, place);
    }
    return net;
}

void main() {
    uint item = itemOfLane(), record = push.table + elementOf(item) * kEdgeElements;
    PatchPlace at = placeOf(instanceOf(item), record, tableElement(record + 2u));
    uint side = tableElement(record).y;
    last = fixedRate();
    QuadCells q;
    q.quad = turnedQuad(quadOf(at.record), side);
    q.net = turnedNet(at, side);
    q.sides[0] = quadSide(at, q.quad, q.net, 0u);
    q.sides[1] = q.sides[2] = q.sides[3] = q.sides[0]; // not read
    q.limits = cornerLimits(at, q.quad);
    storeCells(at, q, 0u);
    // Quarters without a chain have none of the samples.
    Quarter begin = quarterOf(at, q, 0u), end = quarterOf(at, q, 1u);
    if (hasChain(q.quad, 0u)) storeQuarter(at, q.quad, begin, true, false);
    if (hasChain(q.quad, 1u)) storeQuarter(at, q.quad, end, false, true);
}
#else
#include "shaders/exact/sample.glsl"

void main() {
    uint rate = fixedRate(), id = invocationIndex(), lanes = push.count * rate;
    if (id >= lanes * instanceCount()) return;
    uint entry = id / lanes, lane = id - entry * lanes, edge = lane / rate, k = lane - edge * rate;
    uint record = push.table + edge * kEdgeElements;
    PatchPlace at = placeOf(instanceSlot(entry), record, tableElement(record + 2u));
    if (k == 0u && !at.begins) return;
    vec3 position;
    Frame f;
    sampleOnSide(at, tableElement(record).y, parameterPair(k, rate, push.pairs), position, f);
    uint to = k == 0u ? at.corner : at.along + k - 1u;
    storeSurfaceVertex(at.first + to, to, position, f);
}
#endif
