// Smooth texture coordinates: patches of two coordinates with the classes, coefficients and sums of the surface's own
// (docs/smooth_uvs.md). Their third coordinate is 0. Needs tables.glsl, basis.glsl and domain.glsl. One of these macros is defined:
//   BICUBIC   regular, perturbed and polar patches
//   SECTORS   P_3, P_4 and P_5
//   BLEND     the blending surface
//   SAMPLES   fragments of Catmull-Clark and Loop: the samples of a rate themselves
//   QUADS     exact Catmull-Clark patches: quads of leaves, all of the form of irregular ones
//   TRIANGLES Loop patches: likewise, triangles
// For each there are SmoothPatch, which a lane loads once, SmoothPlace, where a sample lies in it, and smoothAt().

const bool kTangents = true;
#include "shaders/evaluate/frame.glsl"

struct SmoothUv {
    vec2 uv, a, b; // and its derivatives, as evaluation has those of positions
};
SmoothUv smoothUv(vec3 position, Frame f) { return SmoothUv(position.xy, f.du.xy, f.dv.xy); }

// Coefficient i of those that begin at an element.
vec3 uvCoefficient(uint first, uint i) {
    uvec4 two = tableElement(first + i / 2u);
    return vec3(uintBitsToFloat((i & 1u) == 0u ? two.xy : two.zw), 0.0);
}

#ifdef BICUBIC
layout(constant_id = kKindConstant) const uint kClass = kRegularPatch;
const uint kDomain = kClass == kPolarPatch ? kPolarDomain : kQuadDomain;
#include "shaders/evaluate/rows.glsl"

const uint kSmoothElements = kPerturbed ? 16u : kPolar ? 7u : 8u;
struct SmoothPatch {
    vec3 g[16], h[16];
};
struct SmoothPlace {
    vec2 u, v;
};
SmoothPatch loadSmooth(uint first) {
    SmoothPatch c;
    for (uint k = 0u; k < 16u; ++k) {
        c.g[k] = uvCoefficient(first, kPolar ? min(k, 12u) : k);
        c.h[k] = kPerturbed ? uvCoefficient(first, 16u + k) : vec3(0.0);
    }
    return c;
}
// A row by the sums of a border: all coefficients are points.
Row collapseSmooth(SmoothPatch c, vec2 v) {
    Row row;
    vec4 b = bernstein3(v);
    vec3 d = derivativeWeights3(v), fromFirst[4];
    // Du of a polar patch as in collapseColumn().
    vec4 along = kPolar ? vec4(polarWeights(v), 0.0) : b;
    for (uint i = 0u; i < 4u; ++i) {
        row.g[i] = sum4(b, c.g[i], c.g[4u + i], c.g[8u + i], c.g[12u + i]);
        fromFirst[i] = blend4(along, c.g[i] - c.g[0], c.g[4u + i] - c.g[0], c.g[8u + i] - c.g[0], c.g[12u + i] - c.g[0]);
        row.gv[i] = blend3(d, c.g[4u + i] - c.g[i], c.g[8u + i] - c.g[4u + i], c.g[12u + i] - c.g[8u + i]);
    }
    for (uint i = 0u; i < 3u; ++i) row.gu[i] = fromFirst[i + 1u] - fromFirst[i];
    if (kPerturbed) collapsePerturbation(c.h, v, row);
    return row;
}
SmoothUv smoothAt(SmoothPatch c, SmoothPlace at) {
    vec3 position;
    Frame frame;
    borderSample(collapseSmooth(c, at.v), at.u, position, frame);
    if (kPolar && at.v.y == 0.0) position = c.g[12];
    return smoothUv(position, frame);
}
SmoothPlace quadPlace(vec2 u, vec2 v) { return SmoothPlace(u, v); }
SmoothPlace placeAtRate(uint index) {
    uvec3 at = gridSample(kDomain, dispatchRate(), index);
    return SmoothPlace(parameterPair(at.x, dispatchRate()), parameterPair(at.y, dispatchRate()));
}
#endif

#ifdef SECTORS
#include "shaders/pm/pm.glsl"
#include "shaders/pm/sector.glsl"
#include "shaders/pm/point.glsl"
const uint kDomain = kClass == kP5Patch ? kPentagonDomain : kClass == kP4Patch ? kQuadDomain : kTriangleDomain;

const uint kSmoothElements = (6u * kSides + 2u) / 2u;
struct SmoothPatch {
    vec3 centre;
    SectorSide sides[5];
    uint singular; // a bit a corner, as in the patch's record
};
struct SmoothPlace {
    uint sector;
    vec3 weights;
    vec2 along; // on the border, the pair along it
    bool border, corner;
};
SmoothPatch loadSmooth(uint first) {
    SmoothPatch c;
    c.centre = uvCoefficient(first, 0u);
    for (uint i = 0u; i < kSides; ++i) {
        uint k = 1u + 6u * i;
        c.sides[i] = SectorSide(uvCoefficient(first, k), uvCoefficient(first, k + 1u), uvCoefficient(first, k + 2u),
                                uvCoefficient(first, k + 3u), uvCoefficient(first, k + 4u), uvCoefficient(first, k + 5u));
    }
    c.singular = tableElement(first + 3u * kSides).z;
    return c;
}
// The sample of these weights as sums in one order, not of halves as finishInside() makes it: on the line between two sectors, where
// the weight of one corner is 0, both have the same bits.
void finishPlainly(Sector s, vec3 w, out vec3 position, out Frame frame) {
    precise float x = w.x, y = w.y, z = w.z;
    precise float b[10] = float[10](x * x * x, 3.0 * (x * x * y), 3.0 * (x * y * y), y * y * y, 3.0 * (x * x * z),
                                    6.0 * (x * y * z), 3.0 * (y * y * z), 3.0 * (x * z * z), 3.0 * (y * z * z), z * z * z);
    // One step of de Casteljau's algorithm short of the point: rows of the cubics' coefficients in the quartic's, from 400, 310, 301.
    precise vec3 p = ((b[0] * s.c[0] + b[1] * s.c[1]) + (b[2] * s.c[2] + b[3] * s.c[3])) +
                     ((b[4] * s.c[5] + b[5] * s.c[6]) + b[6] * s.c[7]) + ((b[7] * s.c[9] + b[8] * s.c[10]) + b[9] * s.c[12]);
    precise vec3 q = ((b[0] * s.c[1] + b[1] * s.c[2]) + (b[2] * s.c[3] + b[3] * s.c[4])) +
                     ((b[4] * s.c[6] + b[5] * s.c[7]) + b[6] * s.c[8]) + ((b[7] * s.c[10] + b[8] * s.c[11]) + b[9] * s.c[13]);
    precise vec3 r = ((b[0] * s.c[5] + b[1] * s.c[6]) + (b[2] * s.c[7] + b[3] * s.c[8])) +
                     ((b[4] * s.c[9] + b[5] * s.c[10]) + b[6] * s.c[11]) + (b[7] * s.c[12] + b[8] * s.c[13]); // 004 is 0
    precise vec3 sum = s.centre + ((x * p + y * q) + z * r);
    position = sum;
    frame = frameOf(q - p, r - p);
}

SmoothUv smoothAt(SmoothPatch c, SmoothPlace at) {
    SectorSide last = c.sides[0], own = c.sides[0], next = c.sides[0];
    for (uint i = 0u; i < kSides; ++i) { // lanes ask for different ones: GPUs keep arrays that they index in memory
        if (i == at.sector) own = c.sides[i];
        if ((i + 1u) % kSides == at.sector) last = c.sides[i];
        if (i == (at.sector + 1u) % kSides) next = c.sides[i];
    }
    Sector s = makeSector(vec2(kRayMiddle, kRaySide), c.centre, last, own, next);
    bool singular = at.corner && (c.singular >> at.sector & 1u) != 0u;
    vec3 position;
    Frame frame;
    finishPlainly(s, singular ? kSingularWeights : at.weights, position, frame);
    if (at.weights.z == 1.0) position = c.centre;
    if (at.border) position = borderPosition(bernstein3(at.along), s.border);
    return smoothUv(position, frame);
}
SmoothPlace ringPlace(uint sector, vec3 weights, vec2 along, bool border, bool corner) {
    return SmoothPlace(sector, weights, along, border, corner);
}
SmoothPlace placeAtRate(uint index) {
    uvec3 s = sectorOf(kDomain, dispatchRate(), index);
    vec3 weights = vec3(parameterPair(dispatchRate() - s.x - s.y, dispatchRate()).x,
                        parameterPair(s.x, dispatchRate()).x, parameterPair(s.y, dispatchRate()).x);
    bool border = s.y == 0u;
    return SmoothPlace(s.z, weights, parameterPair(s.x, dispatchRate()), border, border && s.x == 0u);
}
#endif

#ifdef BLEND
layout(constant_id = kKindConstant) const uint kClass = kBlendPatch;
const uint kDomain = kQuadDomain;
const bool kSharp = kClass == kBlendSharpPatch;
const uint kVertexFormat = kVertex24;
#include "shaders/shared/lod.h"
#include "shaders/blend/sample.glsl"

const uint kSmoothElements = 4u;
struct SmoothPatch {
    Corner corners[4];
};
#ifdef LEVELS
struct SmoothPlace {
    vec2 u, v;
};
#else
struct SmoothPlace {
    uint i, j;
};
#endif
SmoothPatch loadSmooth(uint first) {
    SmoothPatch c;
    for (uint k = 0u; k < 4u; ++k) {
        uint chart;
        c.corners[k] = cornerOf(first + k, chart);
        for (uint i = 0u; i < 9u; ++i) c.corners[k].c[i] = uvCoefficient(chart, i);
    }
    return c;
}
SmoothUv smoothAt(SmoothPatch c, SmoothPlace at) {
    vec3 position;
    Frame frame;
#ifdef LEVELS
    evaluateLevels(c.corners, at.u, at.v, position, frame);
#else
    evaluateAtRate(c.corners, at.i, at.j, false, position, frame);
    if (kSharp && liesStill(c.corners, at.i, at.j)) {
        vec3 unused;
        evaluateAtRate(c.corners, at.i, at.j, true, unused, frame);
    }
#endif
    return smoothUv(position, frame);
}
#ifdef LEVELS
SmoothPlace quadPlace(vec2 u, vec2 v) { return SmoothPlace(u, v); }
#else
SmoothPlace placeAtRate(uint index) {
    uvec3 at = gridSample(kDomain, dispatchRate(), index);
    return SmoothPlace(at.x, at.y);
}
#endif
#endif

#ifdef SAMPLES
layout(constant_id = kKindConstant) const uint kClass = kFragmentPatch;
const uint kDomain = kClass == kLoopPatch ? kTriangleDomain : kQuadDomain;

#define kSmoothElements push.samples
struct SmoothPatch {
    uint first;
};
struct SmoothPlace {
    uint index;
};
SmoothPatch loadSmooth(uint first) { return SmoothPatch(first); }
// Of the slopes the second coordinate's are known, in the frame of the normal map: a direction asks for no more.
SmoothUv smoothAt(SmoothPatch c, SmoothPlace at) {
    vec4 s = uintBitsToFloat(tableElement(c.first + at.index));
    return SmoothUv(s.xy, vec2(0.0, s.z), vec2(0.0, s.w));
}
SmoothPlace placeAtRate(uint index) { return SmoothPlace(index); }
#endif

#ifdef QUADS
#include "shaders/shared/chains.h"
#include "shaders/surface/net.glsl"
layout(constant_id = kKindConstant) const uint kDomain = kQuadDomain;

const bool kSharp = true;
struct PatchPlace {
    uint record;
};
vec3 poolPoint(const PatchPlace at, uint i) { return uvCoefficient(0u, i); }
#include "shaders/catmull_clark/sample.glsl"

const uint kSmoothElements = kSharpQuadElements;
struct SmoothPatch {
    uint record;
};
struct SmoothPlace {
    vec2 u, v;
};
SmoothPatch loadSmooth(uint first) { return SmoothPatch(first); }
SmoothUv smoothAt(SmoothPatch c, SmoothPlace at) {
    vec3 position;
    Frame frame;
    irregularSample(PatchPlace(c.record), quadOf(c.record), at.u, at.v, position, frame);
    return smoothUv(position, frame);
}
SmoothPlace quadPlace(vec2 u, vec2 v) { return SmoothPlace(u, v); }
SmoothPlace placeAtRate(uint index) {
    uvec3 at = gridSample(kDomain, dispatchRate(), index);
    return SmoothPlace(parameterPair(at.x, dispatchRate()), parameterPair(at.y, dispatchRate()));
}
// On a side, with its derivatives along it and inwards.
SmoothUv smoothOnSide(uint first, uint side, vec2 t) {
    vec3 position;
    Frame frame;
    sampleOnSide(PatchPlace(first), side, t, position, frame);
    return smoothUv(position, frame);
}
#endif

#ifdef TRIANGLES
#include "shaders/shared/chains.h"
#include "shaders/surface/net.glsl"
layout(constant_id = kKindConstant) const uint kDomain = kTriangleDomain;
layout(constant_id = kSemiSharpConstant) const bool kSemiSharp = false;

struct PatchPlace {
    uint record;
};
vec3 poolPoint(const PatchPlace at, uint i) { return uvCoefficient(0u, i); }
#include "shaders/loop/place.glsl"

// Records begin with the corners: no side is whole, so that none asks for the vertices round the triangle.
const uint kSmoothElements = (kSemiSharp ? kSharpTriangleElements : kIrregularTriangleElements) - kTriangleCornerElement;
struct SmoothPatch {
    uint record;
};
struct SmoothPlace {
    uint sector; // from whose corner derivatives are seen
    TrianglePoint point;
};
SmoothPatch loadSmooth(uint first) { return SmoothPatch(first - kTriangleCornerElement); }
SmoothUv smoothAt(SmoothPatch c, SmoothPlace at) {
    vec3 position;
    Frame frame;
    irregularTriangle(PatchPlace(c.record), triangleOf(c.record, true), at.point, at.sector, position, frame);
#ifdef RINGS
    frame = ofSector(frame);
#endif
    return smoothUv(position, frame);
}
// On a side, with its derivatives along it and towards the centre.
SmoothUv smoothOnSide(uint first, uint side, vec2 t) {
    vec3 position;
    Frame frame;
    SmoothPatch c = loadSmooth(first);
    irregularTriangle(PatchPlace(c.record), triangleOf(c.record, true), pointOnSide(side, t), side, position, frame);
    return smoothUv(position, ofSector(frame));
}
#ifdef RINGS
SmoothPlace ringPlace(uint sector, vec3 weights, vec2 along, bool border, bool corner) {
    return SmoothPlace(sector, ringPoint(sector, border, along, weights));
}
#else
SmoothPlace placeAtRate(uint index) {
    return SmoothPlace(0u, gridPoint(gridSample(kDomain, dispatchRate(), index).xy, dispatchRate()));
}
#endif
#endif
