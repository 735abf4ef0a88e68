// Evaluates bicubic patches: regular ones, those of p-rep with the sparse bi-5 perturbation (docs/prep.md), and polar ones
// (docs/pm.md). Coefficients are gathered from the pool by index. A patch is collapsed in v to rows first, then each row is
// sampled in u.
//
// A lane has a whole patch in registers, in the narrow mapping and, where a rate has patches enough for all lanes of a GPU, in the
// wide one (kLanePatch). There the samples of a row pass through workgroup memory, so that neighbouring lanes store neighbouring
// ones. Otherwise the wide mapping has loops of its own, because rows are faster than samples there. At a rate each lane collapses
// one row and evaluates all of its samples. At levels a workgroup has fewer rows: lanes share the columns to collapse, then the
// samples. All use the functions of rows.glsl, so positions agree bit for bit. At levels samples lie where the patch's record says
// instead of at i / rate (docs/lod.md).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define OWN_WIDE
#include "shaders/surface/tables.glsl"
#include "shaders/evaluate/bicubic.glsl"
#include "shaders/shared/lod.h"

const uint kForm = kLodQuadForm;
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/domain.glsl"

#include "shaders/evaluate/rows.glsl"

Frame withCornerNormal(Frame frame, uint i, uint j, uint rate, uvec4 slots, uint base) {
    bool left = i == 0u, right = i == rate, bottom = j == 0u, top = j == rate;
    if (!((left || right) && (bottom || top))) return frame;
    uint slot = bottom ? (left ? slots.x : slots.y) : (left ? slots.w : slots.z);
    if (slot == kNoNormal) return frame;
    return withNormal(frame, poolVector(base + slot));
}

// Where what a corner is made of lies: its coefficients are 0 itself, 1 towards the next corner, 2 towards the last, 3 of the face.
const uvec4 kCorner0 = uvec4(0u, 1u, 4u, 5u), kCorner1 = uvec4(3u, 7u, 2u, 6u), kCorner2 = uvec4(15u, 14u, 11u, 10u),
            kCorner3 = uvec4(12u, 8u, 13u, 9u);
vec3 netVector(const PatchPlace at, NetRecord net, uint k) { return coefficient(at.base + netIndex(net, kPolar, k), at.isNew); }
// The apex of a polar patch is all of its row v = 1: nothing lies between its two corners there.
Corner loadCorner(const PatchPlace at, NetRecord net, uvec4 k) {
    return Corner(netVector(at, net, k.x), kPolar && cornerOf(k.y) == k.y ? vec3(0.0) : netVector(at, net, k.y),
                  kPolar && cornerOf(k.z) == k.z ? vec3(0.0) : netVector(at, net, k.z), netVector(at, net, k.w));
}
Patch loadPatch(const PatchPlace at) {
    Patch c;
    NetRecord net = netRecord(at.record);
    c.c0 = loadCorner(at, net, kCorner0);
    c.c1 = loadCorner(at, net, kCorner1);
    c.c2 = loadCorner(at, net, kCorner2);
    c.c3 = loadCorner(at, net, kCorner3);
    c.left = between(c.c0.point, c.c3.point);
    c.right = between(c.c1.point, c.c2.point);
    c.bottom = between(c.c0.point, c.c1.point);
    if (kPerturbed) {
        uvec4 edges = tableElement(at.record + 2u);
        for (uint k = 0u; k < 16u; ++k) c.h[k] = coefficient(at.base + perturbationIndex(edges, k), at.isNew);
    }
    return c;
}

uvec4 normalSlots(uint record) {
    return kCornerNormals ? tableElement(record + kRecordElements - 1u) : uvec4(kNoNormal);
}

#ifndef LEVELS
#ifdef WIDE
layout(constant_id = kLanePatchConstant) const bool kLanePatch = false;
// Lanes keep their rows an odd number of elements apart: then they do not meet in one bank.
const uint kRowStride = (kInterior ? kRate - 1u : kRate + 1u) | 1u;
shared uvec4 localSamples[kLanePatch ? kPatchLanes * kRowStride : 1u];
const uint kNoVertex = 0xFFFFFFFFu;
shared uint localPatches[kLanePatch ? kPatchLanes : 1u]; // the first surface vertex of each
uint patchesHere; // in the workgroup
// Where the samples of a row go that the lane stores for others: the surface vertex in row 0, and the element of localSamples.
uint storesTo[kMaxLanePatchRate + 1u], storesFrom[kMaxLanePatchRate + 1u];
#endif

// Sample i of a row that a lane stores, of which `vertex` and `own` are the first ones.
void keepSample(uint vertex, uint own, uint i, vec3 position, Frame frame) {
#ifdef WIDE
    localSamples[gl_LocalInvocationID.x * kRowStride + i] = uvec4(floatBitsToUint(position), encodeOctahedral(frame.normal));
    if (gl_LocalInvocationID.x < patchesHere) storeTangent(vertex + i, own + i, frame);
#else
    storeSurfaceVertex(vertex + i, own + i, position, frame);
#endif
}
// Behind row j of all lanes' patches, of `side` samples each.
void storeRow(uint j, uint side) {
#ifdef WIDE
    barrier();
    if (patchesHere == kPatchLanes) {
        [[unroll]] for (uint s = 0u; s < side; ++s) surface16.at[storesTo[s] + j * side] = localSamples[storesFrom[s]];
    } else {
        for (uint s = 0u; s < side; ++s)
            if (storesTo[s] != kNoVertex) surface16.at[storesTo[s] + j * side] = localSamples[storesFrom[s]];
    }
    barrier();
#endif
}

// All samples of row j. `isInside`: it is on no border.
void evaluateRow(const PatchPlace at, Patch c, Row row, uint j, uint rate, bool isInside) {
    uint inset = kInterior ? 1u : 0u, side = rate + 1u - 2u * inset, first = (j - inset) * side;
    uint vertex = at.vertex + first, own = at.own + first;
    bool isApex = kPolar && !isInside && j == rate; // the apex itself, from every patch round it
    vec3 position, farPosition;
    Frame frame, farFrame;
    if (!kInterior) {
        endSample(row, false, position, frame);
        endSample(row, true, farPosition, farFrame);
        if (isApex) position = farPosition = c.c2.point;
        if (kCornerNormals && !isInside) {
            uvec4 slots = normalSlots(at.record);
            frame = withCornerNormal(frame, 0u, j, rate, slots, at.base);
            farFrame = withCornerNormal(farFrame, rate, j, rate, slots, at.base);
        }
        keepSample(vertex, own, 0u, position, frame);
        keepSample(vertex, own, rate, farPosition, farFrame);
        if (rate == 1u) return;
    }
    PointHalves points = pointHalves(row);
    SlopeHalves slopes = slopeHalves(row);
    uint i = 1u, pairs = rate / 2u;
    [[unroll]] do {
        mirroredSamples(row, points, slopes, parameterPair(i, rate), isInside, position, frame, farPosition, farFrame);
        if (isApex) position = farPosition = c.c2.point;
        keepSample(vertex, own, i - inset, position, frame);
        if (2u * i != rate) keepSample(vertex, own, rate - i - inset, farPosition, farFrame);
    } while (++i <= pairs);
}

// Rows v = 0 and v = 1, then those between. Loops are tested at the bottom: one tested at the top costs lavapipe one more time
// round with nothing to do.
void evaluateRows(const PatchPlace at) {
    Patch c = loadPatch(at);
    uint rate = fixedRate(), inset = kInterior ? 1u : 0u, side = rate + 1u - 2u * inset, j = 0u;
    if (!kInterior) {
        do {
            evaluateRow(at, c, borderRow(c, j == rate), j, rate, false);
            storeRow(j, side);
            j += rate;
        } while (j <= rate);
        if (rate == 1u) return;
    }
    j = 1u;
    do {
        evaluateRow(at, c, collapse(c, parameterPair(j, rate), kInnerRow), j, rate, true);
        storeRow(j - inset, side);
    } while (++j < rate);
}

#ifdef WIDE
// A lane a patch.
void evaluatePatches() {
    Share share = shareOfGroup();
    if (share.count == 0u) return;
    patchesHere = share.count;
    PatchPlace at = PATCH_IN_PLACE(share, min(gl_LocalInvocationID.x, share.count - 1u)); // idle lanes repeat the last
    localPatches[gl_LocalInvocationID.x] = at.vertex;
    barrier();
    const uint kSide = kInterior ? kRate - 1u : kRate + 1u;
    [[unroll]] for (uint s = 0u; s < kSide; ++s) {
        uint n = s * kPatchLanes + gl_LocalInvocationID.x, place = n / kSide, i = n - place * kSide;
        storesFrom[s] = place * kRowStride + i;
        storesTo[s] = place < share.count ? localPatches[place] + i : kNoVertex;
    }
    evaluateRows(at);
}
#else
void evaluatePatch(const PatchPlace at) { evaluateRows(at); }
#endif
#endif

#if !defined(WIDE) && defined(LEVELS)
// Rows first, the inner ones without their ends: those lie on the borders u = 0 and u = 1, which have
// levels of their own, and follow. Loops are tested at the bottom, see above; nothing they compute is used behind them.
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    uint last = at.capacity, side = last + 1u, vertex = at.vertex;
    Patch c = loadPatch(at);
    uvec4 slots = normalSlots(at.record);
    LodPattern insideU = recordPattern(lodRecord, 0u, at.capacityIndex), insideV = recordPattern(lodRecord, 1u, at.capacityIndex);
    LodPattern bottom = recordPattern(lodRecord, 2u, at.capacityIndex), top = recordPattern(lodRecord, 4u, at.capacityIndex);
    LodPattern left = recordPattern(lodRecord, 5u, at.capacityIndex), right = recordPattern(lodRecord, 3u, at.capacityIndex);
    const vec2 kBegin = vec2(0.0, 1.0), kEnd = vec2(1.0, 0.0);
    uint j = 0u;
    do {
        bool isTop = j == last;
        LodPattern along = bottom;
        if (isTop) along = top;
        Row row = borderRow(c, isTop);
        uint i = 0u;
        do {
            vec3 position;
            Frame frame;
            borderSample(row, i == 0u ? kBegin : i == last ? kEnd : lodPair(along, i, last), position, frame);
            if (kPolar && isTop) position = c.c2.point;
            if (kCornerNormals) frame = withCornerNormal(frame, i, j, last, slots, at.base);
            uint own = vertex + j * side + i;
            storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, frame);
        } while (++i < side);
        j += last;
    } while (j < side);
    if (last == 1u) return; // no inner rows
    j = 1u;
    do {
        Row row = collapse(c, lodPair(insideV, j, last), kInnerRow);
        PointHalves points = pointHalves(row);
        SlopeHalves slopes = slopeHalves(row);
        uint i = 1u;
        do {
            vec3 position, farPosition;
            Frame frame, farFrame;
            mirroredSamples(row, points, slopes, lodPair(insideU, i, last), true, position, frame, farPosition, farFrame);
            uint own = vertex + j * side + i;
            storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, frame);
        } while (++i < last);
    } while (++j < last);
    uint n = 0u, count = 2u * (last - 1u);
    do {
        bool onRight = n >= last - 1u;
        LodPattern border = left;
        if (onRight) border = right;
        j = n + (onRight ? 2u - last : 1u);
        vec3 position;
        Frame frame;
        endSample(collapse(c, lodPair(border, j, last), kInnerRow), onRight, position, frame);
        uint own = vertex + j * side + (onRight ? last : 0u);
        storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, frame);
    } while (++n < count);
}
#endif

#ifdef WIDE
// The coefficients of a workgroup's patches: of every corner its point, tangent, next tangent and face coefficient (of a polar
// patch's last corner the point and what is behind it), then the perturbation's, four an edge. One element more keeps the same
// one of neighbouring patches in different banks.
const uint kLocalStride = kPerturbed ? kWidePerturbedNetElements : kWideNetElements;
#ifdef LEVELS
const uint kLocalElements = kMaxPatchesPerGroup * kLocalStride;
#else
const uint kLocalElements = kLanePatch ? 1u : SUPPLE_WIDE_ELEMENTS(kVertexFormat);
#endif
shared vec4 localElements[kLocalElements]; // at a rate the positions of samples as well, when these are done with

vec3 localVector(uint at) { return localElements[at].xyz; }
void loadVector(uint to, uint i, bool isNew) { localElements[to].xyz = coefficient(i, isNew); }

// What corner and edge `corner` bring to the patch in a place.
void loadCorner(uint place, const PatchPlace at, uint corner) {
    uint first = 4u * at.record + corner, point = at.base + tableWord(first), spoke = tableWord(first + 4u);
    uint to = place * kLocalStride + 4u * corner, tangents = at.base + header.tangents;
    loadVector(to, point, at.isNew);
    if (kPolar && corner == 3u) { // it has no spoke
        loadVector(to + 1u, point + 1u, at.isNew);
    } else {
        loadVector(to + 1u, tangents + SUPPLE_SPOKE(spoke), at.isNew);
        loadVector(to + 2u, tangents + SUPPLE_NEXT_SPOKE(spoke), at.isNew);
        loadVector(to + 3u, at.base + header.faces + SUPPLE_SPOKE(spoke), at.isNew);
    }
    if (!kPerturbed) return;
    uint edge = tableWord(first + 8u);
    for (uint s = 0u; s < 4u; ++s) loadVector(to + 16u + s, at.base + SUPPLE_PREP_EDGE_INDEX(edge, s), at.isNew);
}

// Where coefficient k is, and perturbation coefficient k.
uint localSlot(uint k) {
    if (!kPolar) return 4u * SUPPLE_NET_CORNER(k) + SUPPLE_NET_KIND(k);
    uint kind = SUPPLE_POLAR_NET_KIND(k);
    return 4u * SUPPLE_POLAR_NET_CORNER(k) + (kind == kNetBehind ? 1u : kind);
}
vec3 localPerturbation(uint from, uint k) { return localVector(from + 16u + SUPPLE_PREP_FACE_EDGE(k)); }

vec3 localCoefficient(uint from, uint k) { return localVector(from + localSlot(k)); }
// Column i of the coefficients, as columnOf() has it.
Column localColumn(uint from, uint i) {
    Column c;
    c.lower = localCoefficient(from, cornerOf(i));
    c.upper = localCoefficient(from, kPolar ? 12u : cornerOf(12u + i));
    for (uint j = 0u; j < 4u; ++j) {
        uint k = 4u * j + i;
        bool isCorner = k == cornerOf(k); // or the apex
        c.offsets[j] = vec3(0.0);
        if (!isCorner) c.offsets[j] = localCoefficient(from, k);
    }
    c.side = between(c.lower, c.upper);
    c.fromFirst = between(localCoefficient(from, 0u), c.lower);
    return c;
}
void localOuter(uint from, uint i, vec2 v, out vec3 point, out vec3 slope) {
    collapseOuter(v, vec3[2](localPerturbation(from, 8u + 2u * i), localPerturbation(from, 9u + 2u * i)), point, slope);
}
void localInner(uint from, uint i, vec2 v, out vec3 point, out vec3 slope) {
    collapseInner(v, vec3[4](localPerturbation(from, 4u * i), localPerturbation(from, 4u * i + 1u),
                             localPerturbation(from, 4u * i + 2u), localPerturbation(from, 4u * i + 3u)), point, slope);
}
#endif

#if defined(WIDE) && !defined(LEVELS)
Row collapseFrom(uint from, vec2 v, uint kind) {
    Row row;
    vec3 first = localCoefficient(from, 0u), corners[4], offsets[4];
    [[unroll]] for (uint i = 0u; i < 4u; ++i)
        collapseColumn(localColumn(from, i), i, v, kind, first, row.g[i], corners[i], offsets[i], row.gv[i]);
    differences(corners, offsets, row);
    if (kPerturbed) {
        [[unroll]] for (uint i = 0u; i < 2u; ++i) localInner(from, i, v, row.inner[i], row.innerV[i]);
        [[unroll]] for (uint i = 0u; i < 4u; ++i) localOuter(from, i, v, row.outer[i], row.outerV[i]);
    }
    return row;
}

const uint kRowParts = 4u; // corners
void loadRowPart(uint place, const PatchPlace at, uint corner) { loadCorner(place, at, corner); }

// The lane's row.
Row laneRow;
PointHalves laneHalves;
vec3 laneApex;
void makeRow(uint place, uint j, uint rate) {
    laneRow = collapseFrom(place * kLocalStride, parameterPair(j, rate), rowKind(j, rate));
    laneHalves = pointHalves(laneRow);
    if (kPolar) laneApex = localVector(place * kLocalStride + localSlot(12u));
}
void sampleOfRow(Share share, uint place, uint i, uint j, uint rate, out vec3 position, out Frame frame) {
    bool isInside = j > 0u && j < rate && i > 0u && i < rate;
    sampleOf(laneRow, laneHalves, parameterPair(i, rate), isInside, position, frame);
    if (kPolar && j == rate) position = laneApex;
    if (kCornerNormals && !kInterior && (i == 0u || i == rate) && (j == 0u || j == rate)) {
        PatchPlace at = PATCH_IN_PLACE(share, place);
        frame = withCornerNormal(frame, i, j, rate, normalSlots(at.record), at.base);
    }
}
uint rowRate() { return fixedRate(); }
const bool kHasRows = !kLanePatch;
#include "shaders/evaluate/wide_rows.glsl"

void evaluateWide() {
    if (kLanePatch) evaluatePatches();
    else evaluateWideRows();
}
#endif

#if defined(WIDE) && defined(LEVELS)
const uint kRowsAtOnce = kPerturbed ? 24u : 51u; // with the coefficients below 16 KiB, which every device has
const uint kColumns = 4u * kRowsAtOnce;          // of a kind; of perturbations 4 outer ones and 4 with 2 inner ones follow
shared vec4 localPoints[(kPerturbed ? 3u : 1u) * kColumns];
shared vec4 localSlopes[(kPerturbed ? 4u : 2u) * kColumns]; // relative points and slopes; slopes of perturbations

// Collapses a column of the patch in a place of the workgroup into column `to` of the shared ones.
void collapseLocal(uint to, uint place, uint i, vec2 v, uint kind) {
    uint from = place * kLocalStride;
    vec3 point, corners, offsets, slope;
    collapseColumn(localColumn(from, i), i, v, kind, localCoefficient(from, 0u), point, corners, offsets, slope);
    localPoints[to] = vec4(point, 0.0);
    localSlopes[to] = vec4(corners + offsets, 0.0);
    localSlopes[kColumns + to] = vec4(slope, 0.0);
    if (!kPerturbed) return;
    localOuter(from, i, v, point, slope);
    localPoints[kColumns + to] = vec4(point, 0.0);
    localSlopes[2u * kColumns + to] = vec4(slope, 0.0);
    if (i > 1u) return;
    localInner(from, i, v, point, slope);
    localPoints[2u * kColumns + to] = vec4(point, 0.0);
    localSlopes[3u * kColumns + to] = vec4(slope, 0.0);
}

Row localRow(uint slot) {
    Row row;
    for (uint i = 0u; i < 4u; ++i) {
        uint from = 4u * slot + i;
        row.g[i] = localPoints[from].xyz;
        row.gv[i] = localSlopes[kColumns + from].xyz;
        if (i < 3u) row.gu[i] = localSlopes[from + 1u].xyz - localSlopes[from].xyz;
        if (!kPerturbed) continue;
        row.outer[i] = localPoints[kColumns + from].xyz;
        row.outerV[i] = localSlopes[2u * kColumns + from].xyz;
        if (i > 1u) continue;
        row.inner[i] = localPoints[2u * kColumns + from].xyz;
        row.innerV[i] = localSlopes[3u * kColumns + from].xyz;
    }
    return row;
}

// A row has three slots: of the samples inside, and of those on the borders u = 0 and u = 1, which have levels of their own.
void evaluateWide() {
    Share share = shareOfGroup();
    for (uint n = gl_LocalInvocationID.x; n < share.count * 4u; n += gl_WorkGroupSize.x) {
        PatchPlace at = PATCH_IN_PLACE(share, n / 4u);
        if (!at.empty) loadCorner(n / 4u, at, n & 3u);
    }
    uint side = share.side, rows = share.count * side;
    for (uint firstRow = 0u; firstRow < rows; firstRow += kRowsAtOnce / 3u) {
        uint count = min(kRowsAtOnce / 3u, rows - firstRow);
        barrier();
        for (uint n = gl_LocalInvocationID.x; n < 12u * count; n += gl_WorkGroupSize.x) {
            uint row = firstRow + n / 12u, place = row / side, column = n / 4u % 3u;
            PatchPlace at = PATCH_IN_PLACE(share, place);
            uint i = column == 0u ? 1u : column == 1u ? 0u : at.capacity;
            uint j = row - place * side;
            if (!at.empty) collapseLocal(n, place, n & 3u, lodV(place, at.capacity, i, j), rowKind(j, at.capacity));
        }
        barrier();
        for (uint n = gl_LocalInvocationID.x; n < count * side; n += gl_WorkGroupSize.x) {
            uint slot = n / side, row = firstRow + slot, place = row / side, i = n - slot * side, j = row - place * side;
            PatchPlace at = PATCH_IN_PLACE(share, place);
            vec3 position = vec3(0.0);
            Frame frame = Frame(vec3(0.0), vec3(0.0), vec3(0.0));
            if (!at.empty) {
                bool isInside = i > 0u && i < at.capacity && rowKind(j, at.capacity) == kInnerRow;
                Row r = localRow(3u * slot + (i == 0u ? 1u : i == at.capacity ? 2u : 0u));
                sampleOf(r, pointHalves(r), lodU(place, at.capacity, i, j), isInside, position, frame);
                if (kPolar && j == at.capacity) position = localCoefficient(place * kLocalStride, 12u);
                if (kCornerNormals) frame = withCornerNormal(frame, i, j, at.capacity, normalSlots(at.record), at.base);
            }
            uint own = j * side + i;
            storeSurfaceVertex(at.vertex + own, at.own + own, position, frame);
        }
    }
}
#endif
