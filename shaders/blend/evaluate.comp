// Evaluates the blending surface: four local geometries per face, blended by Hermite weights (docs/blend.md). At a rate, tables
// say where samples lie in the charts: nothing transcendental is computed here. Narrow mapping: a lane has all coefficients of a
// patch in registers. Wide mapping: the parts that lanes load are single coefficients. Both use blend() and checkedFrame(), so
// positions agree bit for bit. Regular faces go by rows (blend/regular.glsl); at levels in the wide mapping a lane has a row inside, or
// a side.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/shared/blend.h"
#include "shaders/shared/lod.h"

const uint kRecordElements = 4u;
const uint kForm = kLodQuadForm;
const uint kParts = 4u * kChartCoefficients; // coefficients
#define CHOOSES_WIDE
#ifndef LEVELS
#define LANE_PATCH
#endif
layout(constant_id = kKindConstant) const uint kClass = kBlendPatch;
const bool kSharp = kClass == kBlendSharpPatch; // some chart is creased, or the surface lies still somewhere
const bool kRegular = kClass == kBlendRegularPatch;
#include "shaders/evaluate/harness.glsl"

#include "shaders/evaluate/pairs.glsl"
#include "shaders/blend/sample.glsl"
#include "shaders/blend/regular.glsl"

Along alongOf(vec2 pair) {
    vec2 eta = hermite(pair.x);
    return Along(pair.x, pair.y, eta.x, hermite(pair.y).x, eta.y);
}

#if !defined(WIDE) || !defined(LEVELS)
Corner[4] loadCorners(const PatchPlace at) {
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint poolIndex;
        corners[k] = cornerOf(at.record + k, poolIndex);
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = coefficient(at.base + poolIndex + c, at.isNew);
    }
    return corners;
}
vec3[36] loadRegular(const PatchPlace at) {
    vec3 net[36];
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        uvec4 words = tableElement(at.record + k);
        uint first = at.base + (words.x & kPoolIndexMask);
        [[unroll]] for (uint n = 0u; n < 9u; ++n)
            net[9u * k + n] = withQuarterSign(words.w, n, coefficient(first + quarterSource(words.w, n), at.isNew));
    }
    return net;
}

// A row on a border, then what lies between, row by row. Loops are tested at the bottom, see evaluate/bicubic.comp.
#ifdef LEVELS
LodPattern patterns[6];
Along alongRow(uint i, uint j, uint last) {
    vec2 u = vec2(i == 0u ? 0.0 : 1.0, i == 0u ? 1.0 : 0.0);
    if (i > 0u && i < last) u = lodPair(j == 0u ? patterns[2] : j == last ? patterns[4] : patterns[0], i, last);
    return alongOf(u);
}
Along acrossRow(uint i, uint j, uint last) {
    vec2 v = vec2(j == 0u ? 0.0 : 1.0, j == 0u ? 1.0 : 0.0);
    if (j > 0u && j < last) v = lodPair(i == last ? patterns[3] : i == 0u ? patterns[5] : patterns[1], j, last);
    return alongOf(v);
}
#else
Along alongRow(uint i, uint j, uint last) { return alongOf(parameterPair(i, last)); }
Along acrossRow(uint i, uint j, uint last) { return alongOf(parameterPair(j, last)); }
#endif

struct RegularFace {
    vec3 diagonal, other;
    uint vertex, own, last;
    bool empty;
};
void storeRegular(RegularFace face, uint i, uint j, vec3 position, vec3 du, vec3 dv) {
    uint at = j * (face.last + 1u) + i;
    Frame frame = checkedFrame(face.diagonal, face.other, frameOf(du, dv));
    storeSurfaceVertex(face.vertex + at, face.own + at, face.empty ? vec3(0.0) : position, frame);
}
// An end of an inner row.
void endOfRow(RegularFace face, vec3 net[36], RegularRow row, bool isRight, uint j) {
    uint i = isRight ? face.last : 0u;
    Along v = acrossRow(i, j, face.last);
#ifdef LEVELS // which lies elsewhere than the row
    row = collapseRegular(net, v);
#endif
    vec3 position, du, dv;
    regularSample(row, alongRow(i, j, face.last), position, du, dv);
    RegularBorder border = leftBorder(net);
    if (isRight) border = rightBorder(net);
    storeRegular(face, i, j, onBorder(border, v), du, dv);
}
void evaluateRegular(const PatchPlace at, uint last) {
    vec3 net[36] = loadRegular(at), position, du, dv;
    RegularFace face = RegularFace(net[18] - net[0], net[27] - net[9], at.vertex, at.own, last, at.empty);
    uint j = 0u;
    [[dont_unroll]] do {
        RegularRow row = collapseRegular(net, acrossRow(1u, j, last));
        RegularBorder border = chosen(j == 0u, bottomBorder(net), topBorder(net));
        uint i = 0u;
        [[unroll]] do {
            Along u = alongRow(i, j, last);
            regularSample(row, u, position, du, dv);
            storeRegular(face, i, j, onBorder(border, u), du, dv);
        } while (++i <= last);
        j += last;
    } while (j <= last);
    if (last == 1u) return;
    j = 1u;
    [[dont_unroll]] do {
        RegularRow row = collapseRegular(net, acrossRow(1u, j, last));
        uint i = 1u;
        [[unroll]] do {
            regularSample(row, alongRow(i, j, last), position, du, dv);
            storeRegular(face, i, j, position, du, dv);
        } while (++i < last);
        endOfRow(face, net, row, false, j);
        endOfRow(face, net, row, true, j);
    } while (++j < last);
}

#ifndef LEVELS
void evaluatePatch(const PatchPlace at) {
    if (kRegular) {
        evaluateRegular(at, fixedRate());
        return;
    }
    Corner corners[4] = loadCorners(at);
    uint side = dispatchRate() + 1u, vertex = at.vertex, j = 0u;
    do {
        uint i = 0u;
        do {
            vec3 position;
            Frame frame;
            evaluateAtRate(corners, i, j, false, position, frame);
            storeSurfaceVertex(vertex + j * side + i, at.own + j * side + i, position, frame);
        } while (++i < side);
    } while (++j < side);
    if (!kSharp) return;
    // Once more along the border: lanes pay for a second blend, and inside none asks for it.
    for (uint n = 0u; n < 4u * dispatchRate(); ++n) {
        uint edge = n / dispatchRate(), along = n - edge * dispatchRate();
        uint i = edge == 0u ? along : edge == 1u ? dispatchRate() : edge == 2u ? dispatchRate() - along : 0u;
        uint j = edge == 0u ? 0u : edge == 1u ? along : edge == 2u ? dispatchRate() : dispatchRate() - along;
        vec3 position;
        Frame frame;
        evaluateAtRate(corners, i, j, true, position, frame);
        if (liesStill(corners, i, j)) storeSurfaceVertex(vertex + j * side + i, at.own + j * side + i, position, frame);
    }
}

#else
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    uint last = at.capacity, side = last + 1u;
    for (uint k = 0u; k < 6u; ++k) patterns[k] = recordPattern(lodRecord, k, at.capacityIndex);
    if (kRegular) {
        evaluateRegular(at, last);
        return;
    }
    Corner corners[4] = loadCorners(at);
    uint j = 0u;
    do {
        uint i = 0u;
        do {
            vec2 u = vec2(i == 0u ? 0.0 : 1.0, i == 0u ? 1.0 : 0.0), v = vec2(j == 0u ? 0.0 : 1.0, j == 0u ? 1.0 : 0.0);
            if (i > 0u && i < last) u = lodPair(j == 0u ? patterns[2] : j == last ? patterns[4] : patterns[0], i, last);
            if (j > 0u && j < last) v = lodPair(i == last ? patterns[3] : i == 0u ? patterns[5] : patterns[1], j, last);
            vec3 position;
            Frame frame;
            evaluateLevels(corners, u, v, position, frame);
            uint own = at.vertex + j * side + i;
            storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, frame);
        } while (++i < side);
    } while (++j < side);
}

#endif
#endif
#ifdef WIDE

#ifdef LEVELS
const uint kLocalStride = kParts;
shared vec4 localElements[kLines ? 1u : kMaxPatchesPerGroup * kLocalStride];
#else
const uint kLocalStride = kRegular ? kWideBlendElements : kParts; // an odd number keeps neighboring faces in different banks
shared vec4 localElements[kLanePatch ? 1u : kRegular ? SUPPLE_WIDE_ELEMENTS(kVertexFormat) : kMaxPatchesPerGroup * kLocalStride];
#endif

void loadCoefficient(uint place, const PatchPlace at, uint c) {
    uint corner = c / kChartCoefficients, n = c - corner * kChartCoefficients;
    uvec4 words = tableElement(at.record + corner);
    uint first = at.base + (words.x & kPoolIndexMask);
    vec3 value = coefficient(first + (kRegular ? quarterSource(words.w, n) : n), at.isNew);
    if (kRegular) value = withQuarterSign(words.w, n, value);
    localElements[place * kLocalStride + c].xyz = value;
}
void loadPart(uint to, const PatchPlace at, uint c) { loadCoefficient(to / kParts, at, c); }

void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
#ifdef LEVELS
    uint last = at.capacity, j = index / (last + 1u), i = index - j * (last + 1u);
    vec2 u = lodU(place, last, i, j), v = lodV(place, last, i, j);
#endif
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint poolIndex;
        corners[k] = cornerOf(at.record + k, poolIndex);
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = localElements[place * kLocalStride + 9u * k + c].xyz;
    }
#ifdef LEVELS
    evaluateLevels(corners, u, v, position, frame);
#else
    uint j = index / (dispatchRate() + 1u), i = index - j * (dispatchRate() + 1u);
    evaluateAtRate(corners, i, j, kSharp && liesStill(corners, i, j), position, frame);
#endif
}

#ifdef LEVELS
// The coefficients of a regular face that is turned so that a side lies at v = 0.
vec3[36] loadTurned(const PatchPlace at, uint side) {
    vec3 net[36];
    bool isSwapped = (side & 1u) != 0u;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        uvec4 words = tableElement(at.record + ((k + side) & 3u));
        uint first = at.base + (words.x & kPoolIndexMask);
        [[unroll]] for (uint c = 0u; c < 9u; ++c) {
            uint n = isSwapped ? c % 3u * 3u + c / 3u : c;
            net[9u * k + c] = withQuarterSign(words.w, n, coefficient(first + quarterSource(words.w, n), at.isNew));
        }
    }
    return net;
}
// Line n of a regular face: its four sides, then the rows inside.
void evaluateLine(const PatchPlace at, uint place, uint n) {
    bool isSide = n < 4u;
    uint last = at.capacity, side = isSide ? n : 0u, j = isSide ? 0u : n - 3u, k = isSide ? 0u : 1u;
    vec3 net[36] = loadTurned(at, side), position, du, dv, diagonal = net[18] - net[0], other = net[27] - net[9];
    turnBack(side, diagonal, other);
    RegularRow row = collapseRegular(net, alongOf(localPair(place, 1u, j, last)));
    RegularBorder border = bottomBorder(net);
    LodPattern along = localPattern(place, isSide ? 2u + side : 0u);
    SampleRow samples = innerRowOf(j, last, false);
    if (isSide) samples = sideRowOf(side, last);
    do {
        Along u = alongOf(lodPair(along, k, last));
        regularSample(row, u, position, du, dv);
        if (isSide) position = onBorder(border, u);
        turnBack(side, du, dv);
        Frame frame = checkedFrame(diagonal, other, frameOf(du, dv));
        uint vertex = at.vertex + samples.first;
        storeSurfaceVertex(vertex, vertex, at.empty ? vec3(0.0) : position, frame);
        samples.first += samples.step;
    } while (++k < last);
}
void evaluateLines() {
    Share share = shareOfGroup();
    uint lines = share.side + 2u, place = gl_LocalInvocationID.x / lines;
    if (place < share.count) evaluateLine(PATCH_IN_PLACE(share, place), place, gl_LocalInvocationID.x - place * lines);
}
void evaluateWide() {
    if (kLines) evaluateLines();
    else evaluateWideSamples();
}
#endif

#ifndef LEVELS
const uint kRowParts = kParts;
void loadRowPart(uint place, const PatchPlace at, uint c) { loadCoefficient(place, at, c); }
vec3[36] localNet(uint place) {
    vec3 net[36];
    [[unroll]] for (uint n = 0u; n < 36u; ++n) net[n] = localElements[place * kLocalStride + n].xyz;
    return net;
}

// The lane's row, and positions on borders: where the row lies on one, what that is made of, else its two ends.
RegularRow laneRow;
RegularBorder laneBorder;
vec3 laneLeft, laneRight, laneDiagonal, laneOther;
void makeRow(uint place, uint j, uint rate) {
    vec3 net[36] = localNet(place);
    Along v = alongOf(parameterPair(j, rate));
    laneRow = collapseRegular(net, v);
    laneBorder = chosen(j == 0u, bottomBorder(net), topBorder(net));
    laneLeft = onBorder(leftBorder(net), v);
    laneRight = onBorder(rightBorder(net), v);
    laneDiagonal = net[18] - net[0];
    laneOther = net[27] - net[9];
}
void sampleOfRow(Share share, uint place, uint i, uint j, uint rate, out vec3 position, out Frame frame) {
    vec3 du, dv;
    Along u = alongOf(parameterPair(i, rate));
    regularSample(laneRow, u, position, du, dv);
    if (j == 0u || j == rate) position = onBorder(laneBorder, u);
    else if (i == 0u) position = laneLeft;
    else if (i == rate) position = laneRight;
    frame = checkedFrame(laneDiagonal, laneOther, frameOf(du, dv));
}
uint rowRate() { return fixedRate(); }
const bool kHasRows = kRegular, kInterior = false;
#include "shaders/evaluate/wide_rows.glsl"

void evaluateWide() {
    if (kLanePatch) evaluateLanePatch();
    else if (kRegular) evaluateWideRows();
    else evaluateWideSamples();
}
#endif
#endif
