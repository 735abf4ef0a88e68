// Indexed mesh: evaluates the samples along sides of irregular quads of exact Catmull-Clark patches, each once, and at corners, each
// with one of the sides that begin there (evaluate/edge.comp). Frames are those of the quad, turned so that the side comes first.
// Narrow mapping: one lane per side. Wide mapping: one lane per half of a side.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS EdgePush
#include "shaders/surface/tables.glsl"
#include "shaders/shared/chains.h"
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
    return PatchPlace(tableElement(record).x, instance * header.poolStride, instance * push.verticesPerInstance,
                      push.firstCorner + edge.x, push.firstVertex + edge.y * (fixedRate() - 1u), edge.x != kNoEdgeSample);
}
vec3 poolPoint(const PatchPlace at, uint i) { return poolVector(at.base + i); }

uint last;

#ifndef WIDE
const bool kInside = false;
const bool kSides = true;
void store(const PatchPlace at, bool own, uint i, uint j, vec3 position, Frame frame) {
    if (!own || (i == 0u && !at.begins)) return;
    uint to = i == 0u ? at.corner : at.along + i - 1u;
    storeSurfaceVertex(at.first + to, to, position, frame);
}
#include "shaders/catmull_clark/nets.glsl"

void main() {
    uint item = itemOfLane(), record = push.table + elementOf(item) * kEdgeElements;
    PatchPlace at = placeOf(instanceOf(item), record, tableElement(record + 2u));
    uint side = tableElement(record).y;
    last = fixedRate();
    // Turned so that the side comes first.
    IrregularQuad quad = turnedQuad(quadOf(at.record), side), next = turnedQuad(quad, 1u);
    Net net = turnedNet(at, quad, side), nextNet = turnedOnce(net);
    vec3 border[4] = sideCubic(at, quad, 0u);
    OwnQuarter begin = ownQuarter(at, quad, net, 0u), end = ownQuarter(at, next, nextNet, 1u);
    begin.first = begin.second = ownFirst(at, quad, net, border); // the second is not read, nor is the end's first
    end.first = end.second = ownSecond(at, next, nextNet, border);
    storeOwnQuarter(at, begin, true, false);
    storeOwnQuarter(at, end, false, true);
    // Quarters without a chain have none of the samples, and no words of one.
    vec3 middle = begin.first.middle;
    if (hasChain(quad, 0u)) storeQuarter(at, quad, quarterOf(at, quad, 0u, middle, middle), true, false);
    if (hasChain(quad, 1u)) storeQuarter(at, quad, quarterOf(at, quad, 1u, middle, middle), false, true);
}
#else
#include "shaders/lod/lines.h" // SampleRow
#include "shaders/catmull_clark/half_line.glsl"

vec2 linePair(uint k) { return parameterPair(k, last); }
uint frameCorner(HalfLine h) { return h.isSwapped ? 1u : 0u; }
void store(const PatchPlace at, HalfLine h, uint k, vec3 position, Frame frame) {
    uint to = k == 0u ? at.corner : h.samples.first + k * h.samples.step;
    storeSurfaceVertex(at.first + to, to, position, frame);
}

void main() {
    last = fixedRate();
    uint id = invocationIndex(), lanes = 2u * push.count;
    if (id >= lanes * instanceCount()) return;
    // First halves lie beside each other, and so do second ones.
    uint entry = id / lanes, lane = id - entry * lanes;
    bool isSecond = lane >= push.count;
    uint record = push.table + (isSecond ? lane - push.count : lane) * kEdgeElements, side = tableElement(record).y;
    PatchPlace at = placeOf(instanceSlot(entry), record, tableElement(record + 2u));
    SampleRow samples;
    samples.first = at.along + (isSecond ? last : 0u) - 1u;
    samples.step = isSecond ? 0u - 1u : 1u;
    // The middle belongs to the first half, and so does the corner where the side begins.
    uint corner = isSecond ? (side + 1u) & 3u : side, firstStep = !isSecond && at.begins ? 0u : 1u;
    uint endStep = isSecond ? (last + 1u) / 2u : last / 2u + 1u;
    evaluateHalf(at, quadOf(at.record), HalfLine(corner, firstStep, endStep, true, isSecond, 0.0, 0.0, samples));
}
#endif
