// Evaluates surface attributes: UV sets and color, interpolated between a patch's corners. No pose changes them. At a rate
// they are evaluated once per group, with one invocation per patch sample. At levels they are evaluated in every frame, where
// samples lie then. Output per sample: u, v, and linear color as RG and BA in 16-bit unorm, because 8 bits would band in the
// dark. If there are a second UV set and face UVs, these follow; with tangents, the direction word (docs/tangents.md).
// With a macro of smooth_uvs.glsl texture coordinates are smooth; colors and face UVs stay linear.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifndef LEVELS
#define PUSH_CONSTANTS AttributesPush
#endif
#include "shaders/surface/tables.glsl"
#include "shaders/shared/lod.h"
#include "shaders/shared/pm.h"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/domain.glsl"
#include "shaders/evaluate/sectors.glsl"
#include "shaders/evaluate/pentagon.glsl"

#if defined(BICUBIC) || defined(SECTORS) || defined(BLEND) || defined(SAMPLES) || defined(QUADS) || defined(TRIANGLES)
#define SMOOTH
#include "shaders/evaluate/smooth_uvs.glsl"
#else
layout(constant_id = kKindConstant) const uint kDomain = kQuadDomain;
#endif
#ifdef RINGS
const bool kRings = true; // with level of detail: samples lie in rings round a centre
#else
const bool kRings = false;
#endif
const uint kForm = !kRings ? kLodQuadForm : kDomain == kTriangleDomain ? kLodTriangleForm
                   : kDomain == kPentagonDomain ? kLodPentagonForm : kLodQuadRingsForm;
#include "shaders/lod/record.glsl"
layout(constant_id = kOutputsConstant) const uint kOutputs = 0u; // kOutputUvs1, .. where they are written
layout(constant_id = kSectorsConstant) const bool kSectors = false;
const bool kDirections = (kOutputs & kOutputDirections) != 0u;
// Corners have the frames of normal maps. Otherwise these are the first texture coordinates as they are.
const bool kMapFrames = (kOutputs & kOutputMapFrames) != 0u;
const bool kColors = (kOutputs & kOutputColors) != 0u; // else all are white
const bool kMoreUvs = (kOutputs & (kOutputUvs1 | kOutputFaceUvs | kOutputMapFrames)) != 0u;

BUFFER(writeonly, Attributes, kAttributeBinding, std430, uvec4, attributes)
BUFFER(writeonly, Uvs1, kUv1Binding, std430, vec2, uvs1)
BUFFER(writeonly, FaceUvs, kFaceUvBinding, std430, vec2, faceUvs)
BUFFER(writeonly, Directions, kDirectionOutputBinding, std430, uint, directions)

const uint kCorners = kDomain == kPentagonDomain ? 5u : kDomain == kQuadDomain ? 4u : kDomain == kEdgeDomain ? 2u
                      : kDomain == kVertexDomain ? 1u : 3u;

// Linear on triangles, bilinear on quads and on the quads of a pentagon. On polar patches the corner at the apex takes over
// linearly.
float[5] bilinear(vec2 u, vec2 v) { return float[5](u.y * v.y, u.x * v.y, u.x * v.x, u.y * v.x, 0.0); }
float[5] polar(vec2 u, vec2 v) { return float[5](u.y * v.y, u.x * v.y, v.x, 0.0, 0.0); }

float[5] cornerWeights(uint index) {
    uvec3 at = gridSample(kDomain, dispatchRate(), index);
    vec2 u = parameterPair(at.x, dispatchRate()), v = parameterPair(at.y, dispatchRate());
    if (kDomain == kQuadDomain) return bilinear(u, v);
    if (kDomain == kPolarDomain) return polar(u, v);
    float rest = parameterPair(dispatchRate() - at.x - at.y, dispatchRate()).x;
    if (kDomain == kTriangleDomain) return float[5](rest, u.x, v.x, 0.0, 0.0);
    return pentagonWeights(at.z, vec3(rest, u.x, v.x));
}

vec2 squareCorner(uint k) { return vec2(k == 1u || k == 2u, k >= 2u); }

// From the weights of corner `sector`, of the next corner and of the centre.
float[5] sectorWeights(uint sector, vec3 l) {
    if (kDomain == kQuadDomain) {
        vec2 p = l.x * squareCorner(sector & 3u) + l.y * squareCorner((sector + 1u) & 3u) + l.z * vec2(0.5);
        return bilinear(vec2(p.x, 1.0 - p.x), vec2(p.y, 1.0 - p.y));
    }
    if (kDomain == kPentagonDomain) return pentagonWeights(sector, l);
    float w[5];
    for (uint c = 0u; c < 5u; ++c)
        w[c] = c < kCorners ? l.z / float(kCorners) + (c == sector ? l.x : 0.0) + (c == (sector + 1u) % kCorners ? l.y : 0.0)
                            : 0.0;
    return w;
}

#if defined(WIDE) && defined(LEVELS)
// At corners where a record says that samples lie (surface/lod/grid.h).
float[5] lodCornerWeights(uint place, LodRecord r, uint index) {
    if (!kRings) {
        uint j = index / (r.capacity + 1u), i = index - j * (r.capacity + 1u);
        vec2 u = lodU(place, r.capacity, i, j), v = lodV(place, r.capacity, i, j);
        if (kDomain == kPolarDomain) return polar(u, v);
        return bilinear(u, v);
    }
    vec2 along;
    RingSample at = ringSample(kCorners, r.capacity, index);
    return sectorWeights(at.side, ringWeights(place, r.capacity, at, along));
}
#endif

// What a patch has at its corners. Colors in steps of 16-bit unorm: weights do not sum to more than 1, so that nothing has to
// be clamped; lavapipe spends a third of the pass on packUnorm2x16.
struct Corners {
    vec2 uv[5];
    vec4 color[5];
    vec4 more[5]; // second UV, face UV
    // With directions: in the frame of the normal map the texture coordinates, the sign of the face's area, which all of its
    // samples have, and its size.
    vec2 map[5];
    float side, size;
    vec3 frame; // a direction and a sign: see turned()
    bool second; // the map lies on the second UV set
#ifdef SMOOTH
    SmoothPatch smooth0, smooth1; // of the first and the second UV set
#endif
};
bool haveMore() { return header.uvSets == 2u || header.faceUvs != 0u; }
uint cornerElements() { return 1u + uint(haveMore()) + uint(kMapFrames); }
// Texture coordinates in the frame of the corners' normal map (cage::MapFrame::turn).
vec2 turned(Corners c, vec2 uv) {
    precise vec2 map = vec2(c.frame.z * (c.frame.y * uv.x - c.frame.x * uv.y), c.frame.x * uv.x + c.frame.y * uv.y);
    return map;
}
void loadCorner(inout Corners c, uint k, uint element) {
    uvec4 corner = tableElement(element);
    c.uv[k] = uintBitsToFloat(corner.xy);
    c.color[k] = vec4(0.0);
    if (kColors) c.color[k] = vec4(corner.z & 0xFFFFu, corner.z >> 16u, corner.w & 0xFFFFu, corner.w >> 16u);
    c.more[k] = kMoreUvs && haveMore() ? uintBitsToFloat(tableElement(element + 1u)) : vec4(0.0);
    if (kDirections) c.map[k] = c.uv[k];
    if (kMapFrames) {
        uvec4 frame = tableElement(element + cornerElements() - 1u);
        c.frame = uintBitsToFloat(frame.xyz);
        c.second = frame.w == 1u;
        c.map[k] = turned(c, c.second ? c.more[k].xy : c.uv[k]);
    }
}
vec2 mapCentre(Corners c, uint corners) {
    vec2 sum = vec2(0.0);
    for (uint k = 0u; k < corners; ++k) sum += c.map[k];
    return sum / float(corners);
}
void findSide(inout Corners c, uint corners) {
    vec2 centre = mapCentre(c, corners);
    float area = 0.0;
    c.size = 0.0;
    for (uint k = 0u; k < corners; ++k) {
        vec2 p = c.map[k] - c.map[0], q = c.map[k + 1u == corners ? 0u : k + 1u] - c.map[0];
        precise float twice = p.x * q.y - p.y * q.x;
        area += twice;
        c.size = max(c.size, distance(c.map[k], centre));
    }
    c.side = sign(area);
}
// `first`: the word with the first number of a list, or the half of a word, of which `place` is one.
uint cornerElement(uint first, uint place) {
    uint number = tableWord(first + (place >> header.attributeHalves));
    if (header.attributeHalves != 0u) number = number >> 16u * (place & 1u) & 0xFFFFu;
    return header.attributes + cornerElements() * number;
}
Corners loadCorners(uint patchIndex) {
    Corners c;
    for (uint k = 0u; k < kCorners; ++k) loadCorner(c, k, cornerElement(push.table, kCorners * patchIndex + k));
    if (kDirections) findSide(c, kCorners);
#ifdef SMOOTH
    uint first = push.smoothUvs + header.uvSets * kSmoothElements * patchIndex;
    c.smooth0 = loadSmooth(first);
    if ((kOutputs & kOutputUvs1) != 0u || (kMapFrames && header.uvSets == 2u)) c.smooth1 = loadSmooth(first + kSmoothElements);
#endif
    return c;
}

// What a sample has.
struct Sample {
    vec2 uv;
    vec4 color, more;
};
Sample blended(float a, Sample x, float b, Sample y) {
    precise Sample s = Sample(a * x.uv + b * y.uv, a * x.color + b * y.color, a * x.more + b * y.more);
    return s;
}
Sample atCorner(Corners c, uint k) { return Sample(c.uv[k], c.color[k], c.more[k]); }

void store(uint vertex, Sample s) {
    uvec2 color = uvec2(0xFFFFFFFFu);
    if (kColors) {
        uvec4 channels = uvec4(ivec4(s.color + 0.5));
        color = channels.xz | channels.yw << 16u;
    }
    attributes.at[vertex] = uvec4(floatBitsToUint(s.uv), color);
    if ((kOutputs & kOutputUvs1) != 0u) uvs1.at[vertex] = s.more.xy;
    if ((kOutputs & kOutputFaceUvs) != 0u) faceUvs.at[vertex] = s.more.zw;
}
Sample weighted(Corners c, float w[5]) {
    Sample s = Sample(vec2(0.0), vec4(0.0), vec4(0.0));
    for (uint k = 0u; k < kCorners; ++k) s = blended(1.0, s, w[k], atCorner(c, k));
    return s;
}
void store(uint vertex, Corners c, float w[5]) { store(vertex, weighted(c, w)); }

// Derivatives of the map's texture coordinates in the parameters whose derivatives evaluation has (docs/tangents.md): u and v of a
// patch, or along a sector's edge and towards the centre.
struct Slopes {
    vec2 a, b;
};
Slopes slopesAt(Corners c, vec2 u, vec2 v) {
    // On polar patches both derivatives along u lack the factor 1 - v.
    if (kDomain == kTriangleDomain) return Slopes(c.map[1] - c.map[0], c.map[2] - c.map[0]);
    if (kDomain == kPolarDomain) return Slopes(c.map[1] - c.map[0], c.map[2] - (u.y * c.map[0] + u.x * c.map[1]));
    return Slopes(v.y * (c.map[1] - c.map[0]) + v.x * (c.map[2] - c.map[3]),
                  u.y * (c.map[3] - c.map[0]) + u.x * (c.map[2] - c.map[1]));
}
Slopes slopesOnPentagon(Corners c, uint sector, vec3 l) {
    Slopes slopes;
    pentagonSlopes(c.map, sector, l, slopes.a, slopes.b);
    return slopes;
}
// In a sector, with the weights of its corners and the centre.
Slopes sectorSlopes(Corners c, uint sector, vec3 l) {
    uint next = sector + 1u == kCorners ? 0u : sector + 1u;
    if (kDomain == kQuadDomain) {
        vec2 own = squareCorner(sector), along = squareCorner(next) - own, inwards = vec2(-along.y, along.x);
        vec2 p = own + l.y * along + l.z * (vec2(0.5) - own);
        Slopes uv = slopesAt(c, vec2(p.x, 1.0 - p.x), vec2(p.y, 1.0 - p.y));
        vec2 a = along.x * uv.a + along.y * uv.b, across = inwards.x * uv.a + inwards.y * uv.b;
        return Slopes(a, 0.5 * (a + across));
    }
    if (kDomain == kPentagonDomain) return slopesOnPentagon(c, sector, l);
    return Slopes(c.map[next] - c.map[sector], mapCentre(c, kCorners) - c.map[sector]);
}

// The tangent is the direction in which the second texture coordinate stands still: a P_a + b P_b with (a, b) = side (t_b, -t_a).
// The frame's sign is glTF's, which is minus the side.
void storeDirection(uint vertex, Corners c, Slopes slopes) {
    const float kFlat = 1e-5; // of the face's size: there is no direction
    vec2 d = c.side * vec2(slopes.b.y, -slopes.a.y);
    float longest = max(abs(d.x), abs(d.y));
    if (!(longest > kFlat * c.size) || isinf(longest)) {
        d = vec2(1.0, 0.0);
        longest = 1.0;
    }
    ivec2 q = ivec2(round(d / longest * vec2(32767.0, 16383.0)));
    directions.at[vertex] = (uint(q.x) & 0xFFFFu) | (uint(q.y) & 0x7FFFu) << 16u | (c.side > 0.0 ? kNegativeFrame : 0u);
}

// The slopes of smooth texture coordinates, which have derivatives of their own, in the map's frame. In the table of samples
// these are turned already.
Slopes mapSlopes(Corners c, Slopes uv) {
#ifdef SAMPLES
    const bool turn = false;
#else
    const bool turn = kMapFrames;
#endif
    if (turn) return Slopes(turned(c, uv.a), turned(c, uv.b));
    return uv;
}

#ifdef SMOOTH
void storeSmooth(uint vertex, Corners c, float w[5], SmoothPlace at) {
    Sample s = weighted(c, w);
    SmoothUv uv = smoothAt(c.smooth0, at);
    s.uv = uv.uv;
    if ((kOutputs & kOutputUvs1) != 0u) s.more.xy = smoothAt(c.smooth1, at).uv;
    store(vertex, s);
    if (kMapFrames && c.second) uv = smoothAt(c.smooth1, at);
    if (kDirections) storeDirection(vertex, c, mapSlopes(c, Slopes(uv.a, uv.b)));
}
#endif

#if defined(SMOOTH) && defined(LEVELS) && !defined(RINGS)
// A patch with levels, by one lane.
void storeRows(uint record, LodRecord r, Corners c) {
    uint last = r.capacity, side = last + 1u;
    LodPattern patterns[6];
    for (uint k = 0u; k < 6u; ++k) patterns[k] = recordPattern(record, k, r.capacityIndex);
    uint j = 0u;
    do {
        uint i = 0u;
        do {
            vec2 u = vec2(i == 0u ? 0.0 : 1.0, i == 0u ? 1.0 : 0.0), v = vec2(j == 0u ? 0.0 : 1.0, j == 0u ? 1.0 : 0.0);
            if (i > 0u && i < last) u = lodPair(j == 0u ? patterns[2] : j == last ? patterns[4] : patterns[0], i, last);
            if (j > 0u && j < last) v = lodPair(i == last ? patterns[3] : i == 0u ? patterns[5] : patterns[1], j, last);
            float w[5] = bilinear(u, v);
            if (kDomain == kPolarDomain) w = polar(u, v);
            storeSmooth(r.firstVertex + j * side + i, c, w, quadPlace(u, v));
        } while (++i < side);
    } while (++j < side);
}
#endif

#ifndef SMOOTH
// A patch with levels, by one lane: what a row has in common is found once. Loops are tested at the bottom, see
// evaluate/bicubic.comp.
void storeRows(uint record, LodRecord r, Corners c) {
    uint last = r.capacity, vertex = r.firstVertex;
    uint first = kDomain == kPolarDomain ? 2u : 3u; // above corner 0; above corner 1 is 2
    LodPattern insideU = recordPattern(record, 0u, r.capacityIndex), insideV = recordPattern(record, 1u, r.capacityIndex);
    LodPattern bottom = recordPattern(record, 2u, r.capacityIndex), top = recordPattern(record, 4u, r.capacityIndex);
    LodPattern left = recordPattern(record, 5u, r.capacityIndex), right = recordPattern(record, 3u, r.capacityIndex);
    const vec2 kBegin = vec2(0.0, 1.0), kEnd = vec2(1.0, 0.0);
    uint j = 0u;
    do {
        vec2 v = kBegin, vLeft = kBegin, vRight = kBegin;
        LodPattern along = bottom;
        if (j > 0u) {
            bool end = j == last;
            v = end ? kEnd : lodPair(insideV, j, last);
            vLeft = end ? kEnd : lodPair(left, j, last);
            vRight = end ? kEnd : lodPair(right, j, last);
            along = insideU;
            if (end) along = top;
        }
        Sample begin = blended(v.y, atCorner(c, 0u), v.x, atCorner(c, first));
        Sample end = blended(v.y, atCorner(c, 1u), v.x, atCorner(c, 2u));
        Sample onLeft = blended(vLeft.y, atCorner(c, 0u), vLeft.x, atCorner(c, first)); // borders: levels of their own
        Sample onRight = blended(vRight.y, atCorner(c, 1u), vRight.x, atCorner(c, 2u));
        uint i = 0u;
        do {
            vec2 u = lodPair(along, i, last), vHere = v;
            Sample s = blended(u.y, begin, u.x, end);
            if (i == 0u) {
                s = onLeft;
                vHere = vLeft;
            }
            if (i == last) {
                s = onRight;
                vHere = vRight;
            }
            uint own = vertex + j * (last + 1u) + i;
            store(own, s);
            if (kDirections)
                storeDirection(own, c, slopesAt(c, i == 0u ? kBegin : i == last ? kEnd : u, vHere));
        } while (++i <= last);
    } while (++j <= last);
}

#endif

// The same in rings.
#if !defined(SMOOTH) || defined(RINGS)
void storeRings(uint record, LodRecord r, Corners c) {
    uint last = r.capacity, rings = (last + 1u) / 2u;
    LodPattern inside = recordPattern(record, 0u, r.capacityIndex);
    for (uint sector = 0u; sector < kCorners; ++sector) {
        LodPattern side = recordPattern(record, 1u + sector, r.capacityIndex);
        uint ring = 0u;
        do {
            float t = lodPair(inside, ring, last).x;
            uint vertex = r.firstVertex + ringSideStart(kCorners, ring, sector, last);
            uint k = ring;
            do {
                vec3 l = ringWeights(lodPair(side, k, last), t);
#ifdef SMOOTH
                storeSmooth(vertex + k - ring, c, sectorWeights(sector, l),
                            ringPlace(sector, l, lodPair(side, k, last), ring == 0u, ring == 0u && k == 0u));
#else
                store(vertex + k - ring, c, sectorWeights(sector, l));
                if (kDirections) storeDirection(vertex + k - ring, c, sectorSlopes(c, sector, l));
#endif
            } while (++k < last - ring);
            side = inside;
        } while (++ring < rings);
    }
}
#endif

#if defined(SMOOTH) && defined(WIDE) && defined(LEVELS)
SmoothPlace lodPlace(uint place, LodRecord r, uint index) {
#ifdef RINGS
    vec2 along;
    RingSample at = ringSample(kCorners, r.capacity, index);
    vec3 weights = ringWeights(place, r.capacity, at, along);
    return ringPlace(at.side, weights, along, at.ring == 0u, at.ring == 0u && at.k == 0u);
#else
    uint j = index / (r.capacity + 1u), i = index - j * (r.capacity + 1u);
    return quadPlace(lodU(place, r.capacity, i, j), lodV(place, r.capacity, i, j));
#endif
}
#endif

#if defined(WIDE) && defined(LEVELS)
Slopes lodSlopes(uint place, LodRecord r, Corners c, uint index) {
    if (!kRings) {
        uint j = index / (r.capacity + 1u), i = index - j * (r.capacity + 1u);
        return slopesAt(c, lodU(place, r.capacity, i, j), lodV(place, r.capacity, i, j));
    }
    vec2 along;
    RingSample at = ringSample(kCorners, r.capacity, index);
    return sectorSlopes(c, at.side, ringWeights(place, r.capacity, at, along));
}

// Of a record that has more samples than a workgroup has lanes, all lanes take some. Else a lane takes one sample of a record at a time,
// and the workgroup as many records at once as it has lanes for.
void evaluateWideLod(uint form) {
    Share share = lodShareOfGroup(form);
    loadRecords(share);
    uint lane = gl_LocalInvocationID.x, each = min(share.samples, gl_WorkGroupSize.x), atOnce = gl_WorkGroupSize.x / each;
    uint first = lane / each;
    if (first >= atOnce) return;
    for (uint place = first; place < share.count; place += atOnce) {
        LodRecord r = localRecord(place);
        if (r.isEmpty) continue;
        Corners corners = loadCorners(r.patchIndex);
        for (uint k = lane - first * each; k < share.samples; k += gl_WorkGroupSize.x) {
#ifdef SMOOTH
            storeSmooth(r.firstVertex + k, corners, lodCornerWeights(place, r, k), lodPlace(place, r, k));
#else
            store(r.firstVertex + k, corners, lodCornerWeights(place, r, k));
            if (kDirections) storeDirection(r.firstVertex + k, corners, lodSlopes(place, r, corners, k));
#endif
        }
    }
}
#endif

#ifndef LEVELS
Slopes slopesAtRate(Corners c, uint index) {
    if (kSectors) {
        uvec3 s = sectorOf(kDomain, dispatchRate(), index);
        float x = parameterPair(s.x, dispatchRate()).x, y = parameterPair(s.y, dispatchRate()).x;
        return sectorSlopes(c, s.z, vec3(1.0 - x - y, x, y));
    }
    uvec3 at = gridSample(kDomain, dispatchRate(), index);
    return slopesAt(c, parameterPair(at.x, dispatchRate()), parameterPair(at.y, dispatchRate()));
}
#endif

#ifdef LEVELS
void evaluateNarrowLod() {
    uint record = lodRecordElement(lodRecordOfLane());
    LodRecord r = lodRecordOf(lodElement(record));
    Corners corners = loadCorners(r.patchIndex);
#if !defined(SMOOTH) || defined(RINGS)
    if (kRings) storeRings(record, r, corners);
#endif
#if !defined(SMOOTH) || (defined(LEVELS) && !defined(RINGS))
    if (!kRings) storeRows(record, r, corners);
#endif
}
#endif

// A smooth UV set along an edge, by the sums of bicubic patches (rows.glsl).
vec2 curvePoint(uint first, vec2 t) {
    uvec4 a = tableElement(first), b = tableElement(first + 1u), h = tableElement(first + 2u);
    precise vec3 p = sum4(bernstein3(t), vec3(uintBitsToFloat(a.xy), 0.0), vec3(uintBitsToFloat(a.zw), 0.0),
                          vec3(uintBitsToFloat(b.xy), 0.0), vec3(uintBitsToFloat(b.zw), 0.0));
    precise vec3 moved = p + sum2(bernstein5(t).inner, vec3(uintBitsToFloat(h.xy), 0.0), vec3(uintBitsToFloat(h.zw), 0.0));
    return moved.xy;
}

// Its derivatives along and across, without the factors that evaluation leaves out of those of the position.
Slopes curveSlopes(uint first, vec2 t, bool sectors) {
    uvec4 a = tableElement(first), b = tableElement(first + 1u), h = tableElement(first + 2u);
    vec2 p[4] = vec2[4](uintBitsToFloat(a.xy), uintBitsToFloat(a.zw), uintBitsToFloat(b.xy), uintBitsToFloat(b.zw));
    uvec4 q = tableElement(first + 3u), r = tableElement(first + 4u), d = tableElement(first + 5u);
    vec4 w = bernstein3(t);
    vec2 inner = bernstein5(t).inner, slope = bernsteinDerivative5(t).inner;
    vec2 along = t.y * t.y * (p[1] - p[0]) + 2.0 * t.x * t.y * (p[2] - p[1]) + t.x * t.x * (p[3] - p[2]);
    vec2 across = w.x * uintBitsToFloat(q.xy) + w.y * uintBitsToFloat(q.zw) + w.z * uintBitsToFloat(r.xy) +
                  w.w * uintBitsToFloat(r.zw);
    along += (1.0 / 3.0) * (slope.x * uintBitsToFloat(h.xy) + slope.y * uintBitsToFloat(h.zw));
    across += (5.0 / 3.0) * (inner.x * uintBitsToFloat(d.xy) + inner.y * uintBitsToFloat(d.zw));
    return Slopes(sectors ? 0.75 * along : along, across);
}

// Along its side and inwards, as evaluate/edge.comp has the derivatives of the position.
Slopes slopesOnEdge(Corners c, uint side, uint corners, bool sectors, vec2 t) {
    vec2 own = c.map[side], next = c.map[side + 1u == corners ? 0u : side + 1u], along = next - own;
    if (corners == 5u) return slopesOnPentagon(c, side, vec3(t.y, t.x, 0.0));
    if (sectors && corners != 4u) return Slopes(along, mapCentre(c, corners) - own);
    if (corners == 3u) { // polar
        if (side == 0u) return Slopes(along, c.map[2] - (t.y * own + t.x * next));
        return Slopes(along, side == 1u ? c.map[0] - c.map[1] : c.map[1] - c.map[0]);
    }
    vec2 across = t.y * (c.map[(side + 3u) & 3u] - own) + t.x * (c.map[(side + 2u) & 3u] - next);
    return Slopes(along, sectors ? 0.5 * (along + across) : across);
}

#ifndef LEVELS
// A sample along an edge, or at the corner where it begins: see evaluate/edge.comp.
void storeOnEdge(uint id) {
    uint edge = id / dispatchRate(), k = id - edge * dispatchRate();
    uvec4 own = tableElement(push.edges + kEdgeElements * edge + 2u);
    if (k == 0u && own.x == kNoEdgeSample) return;
    uvec4 patchOfEdge = tableElement(push.table + edge); // that it is taken from
    uint side = patchOfEdge.y & kPatchSideMask, corners = patchOfEdge.y >> kPatchCornersShift & kPatchSideMask;
    uint odd = patchOfEdge.y >> kPatchHalfShift, next = side + 1u == corners ? 0u : side + 1u;
    bool sectors = (patchOfEdge.y & kPatchHasSectors) != 0u;
    Corners c;
    for (uint i = 0u; i < corners; ++i)
        if (kDirections || i == side || i == next) loadCorner(c, i, cornerElement(patchOfEdge.x, odd + i));
    vec2 t = parameterPair(k, dispatchRate());
    Sample s = Sample(vec2(0.0), vec4(0.0), vec4(0.0));
    s = blended(1.0, s, t.y, atCorner(c, side));
    s = blended(1.0, s, t.x, atCorner(c, next));
#if defined(QUADS) || defined(TRIANGLES)
    SmoothUv onSide = smoothOnSide(patchOfEdge.z, side, t);
    s.uv = onSide.uv;
    if (header.uvSets == 2u) {
        SmoothUv second = smoothOnSide(patchOfEdge.z + kSmoothElements, side, t);
        s.more.xy = second.uv;
        if (kMapFrames && c.second) onSide = second;
    }
    Slopes slopes = mapSlopes(c, Slopes(onSide.a, onSide.b));
#else
    if (patchOfEdge.z != 0u) {
        s.uv = curvePoint(patchOfEdge.z, t);
        if (header.uvSets == 2u) s.more.xy = curvePoint(patchOfEdge.z + kUvCurveElements, t);
    }
#endif
    uint vertex = k == 0u ? push.firstCorner + own.x : push.firstVertex + own.y * (dispatchRate() - 1u) + k - 1u;
    store(vertex, s);
    if (kDirections) {
        findSide(c, corners);
#if !defined(QUADS) && !defined(TRIANGLES)
        if (k == 0u && (own.z & kSingularEdge) != 0u) t = vec2(SUPPLE_PM_SINGULAR_STEP, 1.0 - SUPPLE_PM_SINGULAR_STEP);
        Slopes slopes = slopesOnEdge(c, side, corners, sectors, t);
        uint curves = patchOfEdge.z + (kMapFrames && c.second ? kUvCurveElements : 0u);
        if (patchOfEdge.z != 0u) slopes = mapSlopes(c, curveSlopes(curves, t, sectors));
#endif
        storeDirection(vertex, c, slopes);
    }
}
#endif

void main() {
#ifdef LEVELS
#ifdef WIDE
    evaluateWideLod(kForm);
#else
    evaluateNarrowLod();
#endif
#else
    uint id = invocationIndex();
    if (id >= push.count) return;
    if (kDomain == kEdgeDomain) {
        storeOnEdge(id);
        return;
    }
    if (kDomain == kVertexDomain) {
        Corners c;
        loadCorner(c, 0u, header.attributes + cornerElements() * id);
        store(push.firstVertex + id, atCorner(c, 0u));
        return;
    }
    uint patchIndex = id / push.samples, index = id - patchIndex * push.samples;
    Corners corners = loadCorners(patchIndex);
#ifdef SMOOTH
    storeSmooth(push.firstVertex + id, corners, cornerWeights(index), placeAtRate(index));
#else
    store(push.firstVertex + id, corners, cornerWeights(index));
    if (kDirections) storeDirection(push.firstVertex + id, corners, slopesAtRate(corners, index));
#endif
#endif
}
