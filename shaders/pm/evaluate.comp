// Evaluates P_3, P_4 and P_5 patches: m triangular sectors of degree 4 round a centre (docs/pm.md). Coefficients are gathered
// from the pool by index. The 15 coefficients of a sector are expanded from the patch's 6 m + 1. Samples on a border come from
// the border's cubic alone, by the same sum as in every other class of patch.
//
// Narrow mapping: sector by sector, first the border, then what lies inside. Wide mapping: the parts that lanes load are
// sectors. Both use makeSector(), borderPosition() and finishInside(), so positions agree bit for bit. At levels samples lie in
// rings, where the patch's record says (docs/lod.md).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define POOL_READ_ONLY
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

// Narrow mapping: a sector's border, `singular` where its first corner has parallel tangents.
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
void finishBorder(Sector s, Border b, bool first, vec2 along, out vec3 position, out Frame frame) {
    vec4 w = bernstein3(along);
    position = borderPosition(w, b.points);
    vec3 du = blend3(derivativeWeights3(along), b.along[0], b.along[1], b.along[2]);
    vec3 dv = blend4(w, b.across[0], b.across[1], b.across[2], b.across[3]);
    frame = Frame(0.25 * du, dv, cross(du, dv));
    if (first && b.singular) {
        vec3 unused;
        if (kTangents) finishInside(s, kSingularWeights, unused, frame);
        frame = withNormal(frame, b.firstNormal);
    }
}

// Wide mapping: any sample of a sector. A singular corner takes the normal of a step inside.
void finish(Sector s, vec3 w, bool onBorder, vec2 along, bool singular, out vec3 position, out Frame frame) {
    if (singular) w = kSingularWeights;
    finishInside(s, w, position, frame);
    if (onBorder) position = borderPosition(bernstein3(along), s.border);
}

// Weights of the sample (k, l) of a sector: (rate - k - l, k, l) / rate.
vec3 weightsAtRate(uint k, uint l) {
    return vec3(parameterPair(dispatchRate() - k - l, dispatchRate()).x, parameterPair(k, dispatchRate()).x,
                parameterPair(l, dispatchRate()).x);
}

// Number of the sample (k, l) in a sector.
uint sampleOf(uint sector, uint k, uint l) {
    uint rate = dispatchRate(), d = l / kRowStep, less = kInterior ? 1u : 0u;
    if (kClass == kP5Patch) {
        uint rows = rate - less, perSector = rows * (rows + 1u) / 2u;
        return l == rate ? 5u * perSector : sector * perSector + rowStart(rows, l - less) + k;
    }
    if (kClass == kP4Patch) {
        uvec2 at = sector == 0u ? uvec2(d + k, d) : sector == 1u ? uvec2(rate - d, d + k)
                 : sector == 2u ? uvec2(rate - d - k, rate - d) : uvec2(d, rate - d - k);
        return (at.y - less) * (rate + 1u - 2u * less) + at.x - less;
    }
    uint w[3] = uint[3](d, d, d); // weights of the corners
    w[sector] += rate - k - l;
    w[(sector + 1u) % 3u] += k;
    return rowStart(rate + 1u - 3u * less, w[2] - less) + w[1] - less;
}

#if !defined(WIDE) && !defined(LEVELS)
void evaluatePatch(const PatchPlace at) {
    uint record = at.record, base = at.base, vertex = at.vertex, first = at.own;
    uint innerBits = innerWord(record, kSides), singular = SUPPLE_SINGULAR(innerBits), inner = base + SUPPLE_INNER(innerBits);
    vec3 centre = coefficient(inner, false);
    SectorSide own = loadSide(kSides, record, base, inner, kSides - 1u, false);
    SectorSide next = loadSide(kSides, record, base, inner, 0u, false);
    // Tested at the bottom: a loop tested at the top costs lavapipe one more time round with nothing to do. All lanes go
    // round equally often. The centre is sector 0's, which therefore comes last.
    Sector s;
    vec3 position;
    Frame frame;
    uint sector = kSides;
    do {
        --sector;
        SectorSide last = loadSide(kSides, record, base, inner, sector == 0u ? kSides - 1u : sector - 1u, false);
        s = makeSector(kRay, centre, last, own, next);
        if (!kInterior) {
            Border border = makeBorder(s, last, own, next, (singular & (1u << sector)) != 0u);
            uint k = 0u;
            do {
                finishBorder(s, border, k == 0u, parameterPair(k, dispatchRate()), position, frame);
                uint own = sampleOf(sector, k, 0u);
                storeSurfaceVertex(vertex + own, first + own, position, frame);
            } while (++k < dispatchRate());
        }
        uint l = kRowStep;
        if (l < dispatchRate()) {
            do {
                uint k = 0u;
                do {
                    finishInside(s, weightsAtRate(k, l), position, frame);
                    uint own = sampleOf(sector, k, l);
                    storeSurfaceVertex(vertex + own, first + own, position, frame);
                } while (++k < dispatchRate() - l);
                l += kRowStep;
            } while (l < dispatchRate());
        }
        next = own;
        own = last;
    } while (sector > 0u);
    if (dispatchRate() % kRowStep == 0u) {
        finishCentre(s, position, frame);
        uint own = sampleOf(0u, 0u, dispatchRate());
        storeSurfaceVertex(vertex + own, first + own, position, frame);
    }
}

#endif

#if !defined(WIDE) && defined(LEVELS)
// Loops as above; nothing they compute is used behind them.
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
        Border border = makeBorder(s, before, own, next, (singular & (1u << sector)) != 0u);
        LodPattern side = recordPattern(lodRecord, 1u + sector, at.capacityIndex);
        vec3 position;
        Frame frame;
        uint vertex = at.vertex + sector * last, k = 0u; // of ring 0
        do {
            finishBorder(s, border, k == 0u, lodPair(side, k, last), position, frame);
            storeSurfaceVertex(vertex + k, vertex + k, at.empty ? vec3(0.0) : position, frame);
        } while (++k < last);
        uint ring = 1u;
        if (ring < rings) {
            do {
                float t = lodPair(inside, ring, last).x;
                vertex = at.vertex + ringSideStart(kSides, ring, sector, last);
                k = ring;
                do {
                    finishInside(s, ringWeights(lodPair(inside, k, last), t), position, frame);
                    storeSurfaceVertex(vertex + k - ring, vertex + k - ring, at.empty ? vec3(0.0) : position, frame);
                } while (++k < last - ring);
            } while (++ring < rings);
        }
        before = own;
        own = next;
    }
}

#endif

#ifdef WIDE
const uint kSectorPoints = 20u; // centre, border[4], c[15]
shared vec4 localPoints[kMaxPatchesPerGroup * kSides * kSectorPoints];

void loadPart(uint to, const PatchPlace at, uint side) {
    Sector s = loadSector(kSides, kRay, at.record, at.base, side, at.isNew);
    to *= kSectorPoints;
    localPoints[to] = vec4(s.centre, 0.0);
    for (uint i = 0u; i < 4u; ++i) localPoints[to + 1u + i] = vec4(s.border[i], 0.0);
    for (uint i = 0u; i < 15u; ++i) localPoints[to + 5u + i] = vec4(s.c[i], 0.0);
}
Sector localSector(uint n) {
    uint from = n * kSectorPoints;
    Sector s;
    s.centre = localPoints[from].xyz;
    for (uint i = 0u; i < 4u; ++i) s.border[i] = localPoints[from + 1u + i].xyz;
    for (uint i = 0u; i < 15u; ++i) s.c[i] = localPoints[from + 5u + i].xyz;
    return s;
}

void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
#ifdef LEVELS
    RingSample s = ringSample(kSides, at.capacity, index);
    vec2 along;
    vec3 w = ringWeights(place, at.capacity, s, along);
    uint sector = s.side;
    bool border = s.ring == 0u, corner = border && s.k == 0u;
#else
    uvec3 s = sectorOf(kDomain, dispatchRate(), index);
    vec2 along = parameterPair(s.x, dispatchRate());
    vec3 w = weightsAtRate(s.x, s.y);
    uint sector = s.z;
    bool border = s.y == 0u, corner = border && s.x == 0u;
#endif
    bool singular = corner && (SUPPLE_SINGULAR(innerWord(at.record, kSides)) & (1u << sector)) != 0u;
    finish(localSector(place * kSides + sector), w, border, along, singular, position, frame);
}
#endif
