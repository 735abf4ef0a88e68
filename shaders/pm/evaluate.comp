// Evaluates P_3, P_4 and P_5 patches: m triangular sectors of degree 4 round a centre (docs/pm.md). Coefficients are gathered
// from the pool by index. The 15 coefficients of a sector are expanded from the patch's 6 m + 1. Samples on a border come from
// the border's cubic alone, by the same sum as in every other class of patch.
//
// A lane goes sector by sector in the narrow mapping, and in the wide one has a sector where a rate has enough of them for all lanes
// of a GPU (kLanePatch): first the border, then what lies inside, two mirrored samples at once. Otherwise the wide mapping has a lane
// for a sample, and the parts that lanes load are sectors. All use makeSector(), borderPosition() and the sums of point.glsl, so
// positions agree bit for bit. At levels samples lie in rings, where the patch's record says (docs/lod.md).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#ifdef LEVELS
#define OWN_WIDE
#else
#define CHOOSES_WIDE
#endif
#include "shaders/surface/tables.glsl"
#include "shaders/pm/pm.glsl"
#include "shaders/shared/lod.h"

const uint kRecordElements = SUPPLE_PM_RECORD_ELEMENTS(kSides);
const uint kForm = kClass == kP3Patch ? kLodTriangleForm : kClass == kP4Patch ? kLodQuadRingsForm : kLodPentagonForm;
const uint kParts = kSides; // sectors
const uint kDomain = kClass == kP5Patch ? kPentagonDomain : kClass == kP4Patch ? kQuadDomain : kTriangleDomain;
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/domain.glsl"
#include "shaders/evaluate/sectors.glsl"

// Samples of a sector lie in rows parallel to its edge, kRowStep / rate of the way to the centre apart.
const uint kRowStep = kClass == kP5Patch ? 1u : kClass == kP4Patch ? 2u : 3u;
const vec2 kRay = vec2(kRayMiddle, kRaySide);

#include "shaders/pm/load.glsl"
#include "shaders/pm/border.glsl"
#include "shaders/pm/point.glsl"

// A sector's border, `singular` where its first corner has parallel tangents.
struct Border {
    vec3 points[4], along[3], across[4];
    vec3 firstNormal;
    bool singular;
};
Border makeBorder(Sector s, SectorSide last, SectorSide own, SectorSide next, bool singular) {
    vec3 chord = next.v - own.v;
    Border b;
    b.points = s.border;
    b.along = alongBorder(chord, own.t0, own.t1);
    b.across = acrossSector(kRaySide, chord, own.t0, own.t1, last.t1, next.t0, own.o211, own.o121);
    b.firstNormal = singularNormal(kRaySide, chord, own.t0, own.t1, b.across[0], own.o211, last.o121);
    b.singular = singular;
    return b;
}
// The derivative across has lost the factor 4 of the quartic, which a tangent needs and a normal does not.
void finishBorder(SectorCubics c, Border b, bool first, vec2 along, out vec3 position, out Frame frame) {
    vec4 w = bernstein3(along);
    position = borderPosition(w, b.points);
    vec3 du = blend3(derivativeWeights3(along), b.along[0], b.along[1], b.along[2]);
    vec3 dv = blend4(w, b.across[0], b.across[1], b.across[2], b.across[3]);
    frame = Frame(0.25 * du, dv, cross(du, dv));
    if (first && b.singular) {
        vec3 unused;
        if (kTangents) finishInside(c, kSingularWeights, unused, frame);
        frame = withNormal(frame, b.firstNormal);
    }
}

// Any sample of a sector. A singular corner takes the normal of a step inside.
void finish(SectorCubics c, vec3 border[4], vec3 w, bool onBorder, vec2 along, bool singular, out vec3 position, out Frame frame) {
    if (singular) w = kSingularWeights;
    finishInside(c, w, position, frame);
    if (onBorder) position = borderPosition(bernstein3(along), border);
}

#ifndef LEVELS
// Weights of the sample (k, l) of a sector: (rate - k - l, k, l) / rate.
vec3 weightsAtRate(uint k, uint l) {
    uint rate = fixedRate();
    return vec3(parameterPair(rate - k - l, rate).x, parameterPair(k, rate).x, parameterPair(l, rate).x);
}

// Numbers of a sector's samples. Those of a quad are this far apart along the border and inwards.
struct SectorNumbers {
    uint sector, first, along, inwards;
};
SectorNumbers numbersOf(uint sector) {
    uint rate = fixedRate(), less = kInterior ? 1u : 0u, rows = rate - less, side = rate + 1u - 2u * less;
    if (kClass == kP5Patch) return SectorNumbers(sector, sector * (rows * (rows + 1u) / 2u), 1u, 0u);
    if (kClass == kP3Patch) return SectorNumbers(sector, 0u, 0u, 0u);
    bool odd = (sector & 1u) != 0u, back = sector >= 2u;
    uint column = sector == 1u || sector == 2u ? rate : 0u, row = back ? rate : 0u;
    uint along = odd ? side : 1u, inwards = odd ? side - 1u : side + 1u;
    return SectorNumbers(sector, (row - less) * side + column - less, back ? 0u - along : along, back ? 0u - inwards : inwards);
}
uint sampleOf(SectorNumbers n, uint k, uint l) {
    uint rate = fixedRate(), d = l / kRowStep, less = kInterior ? 1u : 0u;
    if (kClass == kP5Patch) return n.first + rowStart(rate - less, l - less) + k;
    if (kClass == kP4Patch) return n.first + n.along * k + n.inwards * d;
    uint first = d + (rate - k - l), next = d + k; // the weights of the side's corners; the third corner has d
    uint second = n.sector == 0u ? next : n.sector == 1u ? first : d, third = n.sector == 0u ? d : n.sector == 1u ? next : first;
    return rowStart(rate + 1u - 3u * less, third - less) + second - less;
}
uint centreSample() {
    uint rate = fixedRate(), rows = rate - (kInterior ? 1u : 0u);
    return kClass == kP5Patch ? 5u * (rows * (rows + 1u) / 2u) : sampleOf(numbersOf(0u), 0u, rate);
}
#endif

#if defined(WIDE) && !defined(LEVELS)
layout(constant_id = kLanePatchConstant) const bool kLanePatch = false;
// Where there is room for the samples of all patches, they pass through workgroup memory, so that neighboring lanes store
// neighboring ones.
const uint kSectorPatches = kPatchLanes / kSides, kRows = kInterior ? kRate - 1u : kRate;
const uint kGridSide = kInterior ? kRate - 1u : kRate + 1u, kTriangleSide = kInterior ? kRate - 2u : kRate + 1u;
const uint kPatchSamples = kClass == kP5Patch ? 5u * (kRows * (kRows + 1u) / 2u) + 1u
                         : kClass == kP4Patch ? kGridSide * kGridSide : kTriangleSide * (kTriangleSide + 1u) / 2u;
const uint kMostLocalSamples = 1000u; // of 16 bytes, that workgroup memory has room for beside the rest
const uint kFits = kSectorPatches * kPatchSamples <= kMostLocalSamples ? kSectorPatches * kPatchSamples : 0u;
const uint kLocalSamples = kLanePatch ? kFits : 0u;
const bool kThroughMemory = kLocalSamples > 0u;
shared uvec4 localSamples[kThroughMemory ? kLocalSamples : 1u];
shared uint localPatches[kThroughMemory ? kSectorPatches : 1u]; // the first surface vertex of each
uint localFirst; // sample of the lane's patch
#endif

void keepSample(const PatchPlace at, uint own, vec3 position, Frame frame) {
#if defined(WIDE) && !defined(LEVELS)
    if (kThroughMemory) {
        localSamples[localFirst + own] = uvec4(floatBitsToUint(position), encodeOctahedral(frame.normal));
        storeTangent(at.vertex + own, at.own + own, frame);
        return;
    }
#endif
    storeSurfaceVertex(at.vertex + own, at.own + own, at.empty ? vec3(0.0) : position, frame);
}

#ifndef LEVELS
#ifdef WIDE
// Behind the border a sector has rows of samples parallel to it. The first sample of a row lies on the ray from the sector's first
// corner, and its mirror image is the next sector's. The near halves of all rows are one loop here: of two nested ones drivers unroll
// none.
const uint kInnerRows = kRate == 0u ? 0u : (kRate - 1u) / kRowStep, kOddRows = kRowStep == 2u ? (kRate & 1u) * kInnerRows
                                                                    : (kInnerRows + 1u - (kRate & 1u)) / 2u;
const uint kInnerSteps = (kInnerRows * kRate - kRowStep * (kInnerRows * (kInnerRows + 1u) / 2u) - kOddRows) / 2u + kInnerRows;
const bool kUnrolls = kRate <= 8u; // code of more samples is too long for the caches of instructions

void evaluateStep(const PatchPlace at, SectorCubics c, SectorNumbers n, inout uint k, inout uint l) {
    vec3 position, farPosition;
    Frame frame, farFrame;
    uint far = fixedRate() - l - k;
    finishMirrored(c, weightsAtRate(k, l), position, frame, farPosition, farFrame);
    keepSample(at, sampleOf(n, k, l), position, frame);
    if (k != 0u && k != far) keepSample(at, sampleOf(n, far, l), farPosition, farFrame);
    ++k;
    if (2u * k > fixedRate() - l) {
        k = 0u;
        l += kRowStep;
    }
}
void evaluateInside(const PatchPlace at, SectorCubics c, SectorNumbers n) {
    uint k = 0u, l = kRowStep;
    if (kUnrolls) {
        [[unroll]] for (uint step = 0u; step < kInnerSteps; ++step) evaluateStep(at, c, n, k, l);
    } else {
        [[dont_unroll]] for (uint step = 0u; step < kInnerSteps; ++step) evaluateStep(at, c, n, k, l);
    }
}
#else
// Loops are tested at the bottom: one tested at the top costs lavapipe one more time round with nothing to do. All lanes go round
// equally often.
void evaluateInside(const PatchPlace at, SectorCubics c, SectorNumbers n) {
    vec3 position, farPosition;
    Frame frame, farFrame;
    uint rate = fixedRate(), l = kRowStep;
    if (l >= rate) return;
    do {
        finishInside(c, weightsAtRate(0u, l), position, frame);
        keepSample(at, sampleOf(n, 0u, l), position, frame);
        uint k = 1u, far = rate - l - 1u;
        if (far > 0u) {
            do {
                finishMirrored(c, weightsAtRate(k, l), position, frame, farPosition, farFrame);
                keepSample(at, sampleOf(n, k, l), position, frame);
                if (k < far) keepSample(at, sampleOf(n, far, l), farPosition, farFrame);
                ++k;
                --far;
            } while (k <= far);
        }
        l += kRowStep;
    } while (l < rate);
}
#endif

void evaluateOnBorder(const PatchPlace at, SectorCubics c, Border border, SectorNumbers n, uint k) {
    vec3 position;
    Frame frame;
    finishBorder(c, border, k == 0u, parameterPair(k, fixedRate()), position, frame);
    keepSample(at, sampleOf(n, k, 0u), position, frame);
}
void evaluateBorder(const PatchPlace at, SectorCubics c, Border border, SectorNumbers n) {
#ifdef WIDE
    [[unroll]] for (uint k = 0u; k < kRate; ++k) evaluateOnBorder(at, c, border, n, k);
#else
    uint k = 0u;
    do {
        evaluateOnBorder(at, c, border, n, k);
    } while (++k < fixedRate());
#endif
}
void evaluateSector(const PatchPlace at, uint sector, vec3 centre, bool singular, SectorSide last, SectorSide own, SectorSide next) {
    Sector s = makeSector(kRay, centre, last, own, next);
    SectorCubics c = cubicsOf(halvesOf(s));
    SectorNumbers n = numbersOf(sector);
    if (!kInterior) evaluateBorder(at, c, makeBorder(s, last, own, next, singular), n);
    evaluateInside(at, c, n);
    if (sector == 0u && fixedRate() % kRowStep == 0u) {
        vec3 position;
        Frame frame;
        finishCentre(c, position, frame);
        keepSample(at, centreSample(), position, frame);
    }
}

#ifdef WIDE
void evaluateSectors() {
    Share share = shareOfGroup();
    if (share.count == 0u) return;
    uint lane = gl_LocalInvocationID.x, sector = lane / kSectorPatches, place = lane - sector * kSectorPatches;
    if (sector < kSides && place < share.count) {
        PatchPlace at = PATCH_IN_PLACE(share, place);
        uint innerBits = innerWord(at.record, kSides), inner = at.base + SUPPLE_INNER(innerBits);
        localFirst = place * kPatchSamples;
        if (sector == 0u && kThroughMemory) localPatches[place] = at.vertex;
        evaluateSector(at, sector, coefficient(inner, false), (SUPPLE_SINGULAR(innerBits) & (1u << sector)) != 0u,
                       loadSide(kSides, at.record, at.base, inner, sector == 0u ? kSides - 1u : sector - 1u, false),
                       loadSide(kSides, at.record, at.base, inner, sector, false),
                       loadSide(kSides, at.record, at.base, inner, sector + 1u == kSides ? 0u : sector + 1u, false));
    }
    if (!kThroughMemory) return;
    barrier();
    for (uint p = 0u; p < share.count; ++p) {
        uint vertex = localPatches[p];
        [[unroll]] for (uint c = 0u; c < (kPatchSamples + kPatchLanes - 1u) / kPatchLanes; ++c) {
            uint s = c * kPatchLanes + lane;
            if ((c + 1u) * kPatchLanes <= kPatchSamples || s < kPatchSamples)
                surface16.at[vertex + s] = localSamples[p * kPatchSamples + s];
        }
    }
}
void evaluateWide() {
    if (kLanePatch) evaluateSectors();
    else evaluateWideSamples();
}
#else
void evaluatePatch(const PatchPlace at) {
    uint record = at.record, base = at.base;
    uint innerBits = innerWord(record, kSides), singular = SUPPLE_SINGULAR(innerBits), inner = base + SUPPLE_INNER(innerBits);
    vec3 centre = coefficient(inner, false);
    SectorSide own = loadSide(kSides, record, base, inner, kSides - 1u, false);
    SectorSide next = loadSide(kSides, record, base, inner, 0u, false);
    uint sector = kSides;
    do {
        --sector;
        SectorSide last = loadSide(kSides, record, base, inner, sector == 0u ? kSides - 1u : sector - 1u, false);
        evaluateSector(at, sector, centre, (singular & (1u << sector)) != 0u, last, own, next);
        next = own;
        own = last;
    } while (sector > 0u);
}
#endif
#endif

#ifdef LEVELS
// Of ring 0 the samples k, k + step, ..
void evaluateSide(const PatchPlace at, SectorCubics c, Border border, LodPattern side, uint sector, uint k, uint step) {
    do {
        vec3 position;
        Frame frame;
        finishBorder(c, border, k == 0u, lodPair(side, k, at.capacity), position, frame);
        keepSample(at, sector * at.capacity + k, position, frame);
        k += step;
    } while (k < at.capacity);
}
#ifdef WIDE
// Sample k of a sector's side of a ring and its mirror image, which of the first sample is the next sector's. Capacities are odd, so none
// is its own.
void evaluateRingStep(const PatchPlace at, SectorCubics c, LodPattern inside, uint sector, RingStep s) {
    uint last = at.capacity, first = ringSideStart(kSides, s.ring, sector, last) - s.ring;
    vec3 position, farPosition;
    Frame frame, farFrame;
    vec3 w = ringWeights(lodPair(inside, s.k, last), lodPair(inside, s.ring, last).x);
    finishMirrored(c, w, position, frame, farPosition, farFrame);
    keepSample(at, first + s.k, position, frame);
    if (s.k != s.ring) keepSample(at, first + last - s.k, farPosition, farFrame);
}
void evaluateLine(const PatchPlace at, RingLine line) {
    uint sector = line.sector;
    uint innerBits = innerWord(at.record, kSides), centre = at.base + SUPPLE_INNER(innerBits);
    SectorSide before = loadSide(kSides, at.record, at.base, centre, sector == 0u ? kSides - 1u : sector - 1u, at.isNew);
    SectorSide own = loadSide(kSides, at.record, at.base, centre, sector, at.isNew);
    SectorSide next = loadSide(kSides, at.record, at.base, centre, sector + 1u == kSides ? 0u : sector + 1u, at.isNew);
    Sector whole = makeSector(kRay, coefficient(centre, at.isNew), before, own, next);
    SectorCubics c = cubicsOf(halvesOf(whole));
    Border border = makeBorder(whole, before, own, next, (SUPPLE_SINGULAR(innerBits) & (1u << sector)) != 0u);
    evaluateSide(at, c, border, localPattern(line.place, 1u + sector), sector, line.n, line.lines);
    LodPattern inside = localPattern(line.place, 0u);
    RingStep s = firstRingStep(line.n, at.capacity);
    while (s.ring <= s.last) {
        evaluateRingStep(at, c, inside, sector, s);
        s = nextRingStep(s, (at.capacity + 1u) / 2u);
    }
}
void evaluateWide() {
    Share share = shareOfGroup();
    RingLine line = ringLineOfLane(share);
    if (line.place < share.count) evaluateLine(PATCH_IN_PLACE(share, line.place), line);
}
#else
// The samples of a side of a ring: the first by itself, then mirrored ones.
void evaluateRing(const PatchPlace at, SectorCubics c, LodPattern inside, uint sector, uint ring) {
    uint last = at.capacity, k = ring + 1u, far = last - ring - 1u, own = ringSideStart(kSides, ring, sector, last);
    float t = lodPair(inside, ring, last).x;
    vec3 position, farPosition;
    Frame frame, farFrame;
    finishInside(c, ringWeights(lodPair(inside, ring, last), t), position, frame);
    keepSample(at, own, position, frame);
    if (far < k) return;
    do {
        finishMirrored(c, ringWeights(lodPair(inside, k, last), t), position, frame, farPosition, farFrame);
        keepSample(at, own + k - ring, position, frame);
        if (k < far) keepSample(at, own + far - ring, farPosition, farFrame);
        ++k;
        --far;
    } while (k <= far);
}
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    uint record = at.record, base = at.base, last = at.capacity, rings = (last + 1u) / 2u;
    uint innerBits = innerWord(record, kSides), singular = SUPPLE_SINGULAR(innerBits), inner = base + SUPPLE_INNER(innerBits);
    vec3 centre = coefficient(inner, at.isNew);
    SectorSide before = loadSide(kSides, record, base, inner, kSides - 1u, at.isNew);
    SectorSide own = loadSide(kSides, record, base, inner, 0u, at.isNew);
    LodPattern inside = recordPattern(lodRecord, 0u, at.capacityIndex);
    for (uint sector = 0u; sector < kSides; ++sector) {
        SectorSide next = loadSide(kSides, record, base, inner, sector + 1u == kSides ? 0u : sector + 1u, at.isNew);
        Sector s = makeSector(kRay, centre, before, own, next);
        SectorCubics c = cubicsOf(halvesOf(s));
        Border border = makeBorder(s, before, own, next, (singular & (1u << sector)) != 0u);
        LodPattern side = recordPattern(lodRecord, 1u + sector, at.capacityIndex);
        evaluateSide(at, c, border, side, sector, 0u, 1u);
        uint ring = 1u;
        if (ring < rings) {
            do {
                evaluateRing(at, c, inside, sector, ring);
            } while (++ring < rings);
        }
        before = own;
        own = next;
    }
}
#endif
#endif

#if defined(WIDE) && !defined(LEVELS)
const uint kSectorPoints = 19u; // border[4], centre, even[8], odd[6]
shared vec4 localPoints[kLanePatch ? 1u : kMaxPatchesPerGroup * kSides * kSectorPoints];

void loadPart(uint to, const PatchPlace at, uint side) {
    Sector s = loadSector(kSides, kRay, at.record, at.base, side, at.isNew);
    SectorHalves h = halvesOf(s);
    to *= kSectorPoints;
    for (uint i = 0u; i < 4u; ++i) localPoints[to + i] = vec4(s.border[i], 0.0);
    localPoints[to + 4u] = vec4(h.centre, 0.0);
    for (uint i = 0u; i < 8u; ++i) localPoints[to + 5u + i] = vec4(h.even[i], 0.0);
    for (uint i = 0u; i < 6u; ++i) localPoints[to + 13u + i] = vec4(h.odd[i], 0.0);
}
SectorHalves localHalves(uint from) {
    SectorHalves h;
    h.centre = localPoints[from + 4u].xyz;
    for (uint i = 0u; i < 8u; ++i) h.even[i] = localPoints[from + 5u + i].xyz;
    for (uint i = 0u; i < 6u; ++i) h.odd[i] = localPoints[from + 13u + i].xyz;
    return h;
}

void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
    uvec3 s = sectorOf(kDomain, dispatchRate(), index);
    vec2 along = parameterPair(s.x, dispatchRate());
    vec3 w = weightsAtRate(s.x, s.y);
    uint sector = s.z;
    bool border = s.y == 0u, corner = border && s.x == 0u;
    bool singular = corner && (SUPPLE_SINGULAR(innerWord(at.record, kSides)) & (1u << sector)) != 0u;
    uint from = (place * kSides + sector) * kSectorPoints;
    vec3 points[4] = vec3[4](localPoints[from].xyz, localPoints[from + 1u].xyz, localPoints[from + 2u].xyz, localPoints[from + 3u].xyz);
    finish(cubicsOf(localHalves(from)), points, w, border, along, singular, position, frame);
}
#endif
