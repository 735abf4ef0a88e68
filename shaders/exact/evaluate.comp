// Evaluates irregular quads of exact Catmull-Clark patches (docs/exact.md): every sample is that of a leaf.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/shared/exact.h"
#include "shaders/shared/lod.h"

const uint kRecordElements = kExactRecordElements;
const uint kForm = kLodQuadForm;
const uint kParts = kNetSide * kNetSide; // points of level 1
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/surface/net.glsl"

vec3 poolPoint(const PatchPlace at, uint i) { return coefficient(at.base + i, at.isNew); }
uint netWord(const PatchPlace at, uint k) { return tableWord(4u * (at.record + kExactNetElement) + 1u + k); }

#ifndef WIDE
vec3 netPoint(const PatchPlace at, uint k) { return poolPoint(at, netWord(at, k)); }
#include "shaders/exact/sample.glsl"

// The samples of a leaf, by their numbers from the quarter's corner along its two edges.
struct LeafSamples {
    uint level, cell;
    int a0, a1, b0, b1;
};
// Leaf n of a quarter; a1, b1: the last numbers of the quarter. 2^-level <= max(a, b) / rate < 2^(1 - level), as leafOf() has it.
LeafSamples leafSamples(uint n, bool chain, int a1, int b1) {
    if (!chain) return LeafSamples(1u, 0u, 0, a1, 0, b1);
    int rate = int(push.rate), level = int(2u + n / 3u);
    int near = (rate + (1 << level) - 1) >> level, end = ((rate + (1 << (level - 1)) - 1) >> (level - 1)) - 1;
    if (level == 2) end = rate; // the middle belongs to it
    uint cell = n % 3u;
    return LeafSamples(uint(level), cell, cell == 2u ? 0 : near, min(cell == 2u ? near - 1 : end, a1), cell == 0u ? 0 : near,
                       min(cell == 0u ? near - 1 : end, b1));
}

// On the quad's border the middle may come to them.
bool hasSamples(LeafSamples s) {
    int middle = int(push.rate) / 2;
    return s.a0 <= (s.b0 == 0 ? max(s.a1, middle) : s.a1) && s.b0 <= (s.a0 == 0 ? max(s.b1, middle) : s.b1);
}

void storeSample(const PatchPlace at, uint corner, uint a, uint b, vec3 position, Frame frame) {
    uint last = push.rate, i = corner == 0u ? a : corner == 1u ? last - b : corner == 2u ? last - a : b;
    uint j = corner == 0u ? b : corner == 1u ? a : corner == 2u ? last - b : last - a;
    uint own = j * (last + 1u) + i;
    storeSurfaceVertex(at.vertex + own, at.own + own, position, frame);
}

void evaluateLeaf(const PatchPlace at, IrregularQuad quad, uint corner, LeafSamples s) {
    uint before = (corner + 3u) & 3u, windows = componentOf(quad.windows, corner);
    bool chain = windows != 0u, farA = chain && s.cell != 2u, farB = chain && s.cell != 0u;
    vec3 origin = chain ? poolPoint(at, componentOf(quad.spokes, corner) - 1u) : vec3(0.0);
    LeafPoints l = leafPoints(at, corner, windows, s.cell,
                              levelPoints(componentOf(quad.spokes, corner), componentOf(quad.sizes, corner), s.level));
    float lineA = sharpnessOf(quad, corner, s.level), lineB = sharpnessOf(quad, before, s.level);
    float acrossA = farB ? 0.0 : lineA, acrossB = farA ? 0.0 : lineB, scale = powerOfTwo(float(s.level));
    bool cubicA = isCubic(quad, corner), cubicB = isCubic(quad, before);
    HalfLine halfA, halfB;
    SideCubic sideA, sideB;
    if (s.b0 == 0) {
        halfA = halfLine(l, true, besideLine(lineA));
        if (cubicA) sideA = sideCubic(at, quad.points, quad.spokes, corner);
    }
    if (s.a0 == 0) {
        halfB = halfLine(l, false, besideLine(lineB));
        if (cubicB) sideB = sideCubic(at, quad.points, quad.spokes, before);
    }
    // The middle of a border is evaluated from the end that it belongs to.
    int rate = int(push.rate), middle = (rate & 1) == 0 ? rate / 2 : -1;
    bool ownA = (quad.flags >> (kMiddleOfSecond + corner) & 1u) == 0u, ownB = (quad.flags >> (kMiddleOfSecond + before) & 1u) != 0u;
    bool outer = s.level <= 2u && middle > 0;
    int endA = outer ? (ownA ? middle : middle - 1) : s.a1, endB = outer && s.a0 == 0 && ownB ? max(s.b1, middle) : s.b1;
    vec3 limit = poolPoint(at, componentOf(quad.points, corner));
    int b = s.b0;
    do {
        vec2 pairB = parameterPair(uint(b), push.rate, push.pairs);
        precise float y0 = pairB.x * scale, y1 = farB ? y0 - 1.0 : y0;
        LeafWeights y = leafWeights(y1, acrossA);
        LeafRow row = collapseLeaf(l, y);
        int a = outer && s.a0 == 0 && b == middle && !ownB ? 1 : s.a0, last = b > s.b1 ? 0 : b == 0 ? endA : s.a1;
        while (a <= last) {
            vec2 pairA = parameterPair(uint(a), push.rate, push.pairs);
            precise float x0 = pairA.x * scale, x1 = farA ? x0 - 1.0 : x0;
            LeafWeights x = leafWeights(x1, acrossB);
            vec3 position;
            Frame frame;
            finishLeaf(row, x, corner, origin, l.p[5], position, frame);
            if (b == 0) position = cubicA ? onCubic(sideA, pairA) : onHalf(origin, halfA, x.w);
            if (a == 0) position = b == 0 ? limit : cubicB ? onCubic(sideB, pairB.yx) : onHalf(origin, halfB, y.w);
            storeSample(at, corner, uint(a), uint(b), position, frame);
            ++a;
        }
    } while (++b <= endB);
    // The corner of a chain: directions are those of the last leaf on its first edge.
    if (chain && s.cell == 0u && s.level == chainLevels(componentOf(quad.sizes, corner))) {
        vec3 position;
        Frame frame;
        finishLeaf(collapseLeaf(l, leafWeights(0.0, lineA)), leafWeights(0.0, 0.0), corner, origin, l.p[5], position, frame);
        uint normal = componentOf(tableElement(at.record + kExactNormalElement), corner);
        storeSample(at, corner, 0u, 0u, limit, withNormal(frame, poolPoint(at, normal)));
    }
}

// Leaf by leaf.
void evaluatePatch(const PatchPlace at) {
    IrregularQuad quad = quadOf(at.record);
    for (uint corner = 0u; corner < 4u; ++corner) {
        bool chain = componentOf(quad.windows, corner) != 0u;
        // Inside, the middle is the lower corner's.
        int below = int(push.rate) / 2, above = (int(push.rate) - 1) / 2;
        bool right = corner == 1u || corner == 2u, up = corner >= 2u, turned = (corner & 1u) != 0u;
        int mostU = right ? above : below, mostV = up ? above : below;
        uint levels = chainLevels(componentOf(quad.sizes, corner)), leaves = chain ? 3u * (levels - 1u) : 1u;
        for (uint n = 0u; n < leaves; ++n) {
            LeafSamples s = leafSamples(n, chain, turned ? mostV : mostU, turned ? mostU : mostV);
            bool hasCorner = chain && n == leaves - 3u;
            if (hasCorner || hasSamples(s)) evaluateLeaf(at, quad, corner, s);
        }
    }
}
#else
shared vec4 localPoints[kMaxPatchesPerGroup * kParts];
uint localPlace; // of the lane's patch

vec3 netPoint(const PatchPlace at, uint k) { return localPoints[localPlace * kParts + k].xyz; }
#include "shaders/exact/sample.glsl"

void loadPart(uint to, const PatchPlace at, uint k) { localPoints[to] = vec4(poolPoint(at, netWord(at, k)), 0.0); }

void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
    localPlace = place;
    uint j = index / (push.rate + 1u), i = index - j * (push.rate + 1u);
    vec2 u = parameterPair(i, push.rate, push.pairs), v = parameterPair(j, push.rate, push.pairs);
    irregularSample(at, quadOf(at.record), u, v, position, frame);
}
#endif
