// Evaluates bicubic patches: regular ones, those of p-rep with the sparse bi-5 perturbation (docs/prep.md), and polar ones
// (docs/pm.md). Coefficients are gathered from the pool by index. A patch is collapsed in v to rows first, then each row is
// sampled in u.
//
// Narrow mapping: a lane has the whole patch in registers. Wide mapping: it has a loop of its own, because rows are faster than
// samples there. At a rate each lane collapses one row and evaluates all of its samples. At levels a workgroup has fewer rows:
// lanes share the columns to collapse, then the samples. All use the functions collapse...() and finish(), so positions agree
// bit for bit. At levels samples lie where the patch's record says instead of at i / rate (docs/lod.md).
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

Patch loadPatch(const PatchPlace at) {
    Patch c;
    NetRecord net = netRecord(at.record);
    for (uint k = 0u; k < 16u; ++k) c.g[k] = coefficient(at.base + netIndex(net, kPolar, k), at.isNew);
    if (kPerturbed) {
        uvec4 edges = tableElement(at.record + 2u);
        for (uint k = 0u; k < 16u; ++k) c.h[k] = coefficient(at.base + perturbationIndex(edges, k), at.isNew);
    }
    for (uint k = 0u; k < 16u; ++k) {
        uint corner = cornerOf(k);
        vec3 offset = k == corner ? vec3(0.0) : c.g[k];
        c.relative[k] = relativeTo(c.g[0], c.g[corner], offset);
        if (k != corner) c.g[k] = placed(c.g[corner], offset);
    }
    return c;
}

uvec4 normalSlots(uint record) {
    return kCornerNormals ? tableElement(record + kRecordElements - 1u) : uvec4(kNoNormal);
}

#if !defined(WIDE) && !defined(LEVELS)
void evaluatePatch(const PatchPlace at) {
    Patch c = loadPatch(at);
    uvec4 slots = normalSlots(at.record);

    uint rate = fixedRate(), first = kInterior ? 1u : 0u, end = rate + 1u - first;
    uint vertex = at.vertex, own = at.own;
    // Tested at the bottom: a loop tested at the top costs lavapipe one more time round with nothing to do.
    uint j = first;
    do {
        Row row = collapse(c, parameterPair(j, rate));
        uint i = first;
        [[unroll]] do {
            vec3 position;
            Frame frame;
            finish(row, parameterPair(i, rate), position, frame);
            if (kPolar && j == rate) position = c.g[12]; // the apex itself, from every patch round it
            if (kCornerNormals && !kInterior) frame = withCornerNormal(frame, i, j, rate, slots, at.base);
            storeSurfaceVertex(vertex, own, position, frame);
            ++vertex;
            ++own;
        } while (++i < end);
    } while (++j < end);
}

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
        bool border = j == 0u || j == last;
        LodPattern along = insideU;
        if (j == 0u) along = bottom;
        if (j == last) along = top;
        Row row = collapse(c, j == 0u ? kBegin : j == last ? kEnd : lodPair(insideV, j, last));
        uint i = border ? 0u : 1u, end = border ? side : last;
        do {
            vec3 position;
            Frame frame;
            finish(row, i == 0u ? kBegin : i == last ? kEnd : lodPair(along, i, last), position, frame);
            if (kPolar && j == last) position = c.g[12];
            if (kCornerNormals) frame = withCornerNormal(frame, i, j, last, slots, at.base);
            uint own = vertex + j * side + i;
            storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, frame);
        } while (++i < end);
    } while (++j < side);
    if (last == 1u) return; // no inner rows
    uint n = 0u, count = 2u * (last - 1u);
    do {
        bool onRight = n >= last - 1u;
        LodPattern border = left;
        if (onRight) border = right;
        j = n + (onRight ? 2u - last : 1u);
        vec3 position;
        Frame frame;
        finish(collapse(c, lodPair(border, j, last)), onRight ? kEnd : kBegin, position, frame);
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
const uint kLocalElements = SUPPLE_WIDE_ELEMENTS(kVertexFormat);
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

// Column i of the coefficients, as loadPatch() has them.
void localColumn(uint from, uint i, out vec3 g[4], out vec3 relative[4]) {
    vec3 first = localVector(from + localSlot(0u));
    for (uint j = 0u; j < 4u; ++j) {
        uint k = 4u * j + i, corner = cornerOf(k);
        vec3 v = localVector(from + localSlot(corner)), offset = vec3(0.0);
        if (k != corner) offset = localVector(from + localSlot(k));
        relative[j] = relativeTo(first, v, offset);
        g[j] = k == corner ? v : placed(v, offset);
    }
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
// Samples of a row that are stored together: what there is room for, and an odd number, so that rows begin in different banks.
const uint kMostTogether = kVertexFormat == kVertex24 ? 3u : 5u;
shared uint localNormals[kMaxLanes * kMostTogether * (kNormalWords == 0u ? 1u : kNormalWords)];
shared uint localRows[kMaxLanes]; // the first surface vertex of each

Row collapseFrom(uint from, vec2 v) {
    Row row;
    vec3 relative[4];
    [[unroll]] for (uint i = 0u; i < 4u; ++i) {
        vec3 g[4], r[4];
        localColumn(from, i, g, r);
        collapseColumn(v, g, r, row.g[i], relative[i], row.gv[i]);
    }
    for (uint i = 0u; i < 3u; ++i) row.gu[i] = relative[i + 1u] - relative[i];
    if (kPerturbed) {
        [[unroll]] for (uint i = 0u; i < 2u; ++i) localInner(from, i, v, row.inner[i], row.innerV[i]);
        [[unroll]] for (uint i = 0u; i < 4u; ++i) localOuter(from, i, v, row.outer[i], row.outerV[i]);
    }
    return row;
}

// A lane a row, in registers; a lane a corner loads before. As coefficients are not needed any more then, positions take
// their place on their way to be stored by neighbouring lanes side by side.
void evaluateWide() {
    const uint kInset = kInterior ? 1u : 0u;
    uint rate = fixedRate(), side = rate + 1u - 2u * kInset, lane = gl_LocalInvocationID.x;
    Share share = shareOfGroup();
    if (share.count == 0u) return;
    uint rows = share.count * side;
    for (uint n = lane; n < 4u * share.count; n += gl_WorkGroupSize.x) {
        uint place = n / 4u;
        PatchPlace at = PATCH_IN_PLACE(share, place);
        loadCorner(place, at, n & 3u);
        for (uint j = n & 3u; j < side; j += 4u) localRows[place * side + j] = at.vertex + j * side;
    }
    barrier();
    uint place = lane / side, j = lane - place * side + kInset;
    Row row;
    vec3 apex;
    if (lane < rows) {
        row = collapseFrom(place * kLocalStride, parameterPair(j, rate));
        if (kPolar) apex = localVector(place * kLocalStride + localSlot(12u));
    }
    uint rounds = (side + kMostTogether - 1u) / kMostTogether, chunk = ((side + rounds - 1u) / rounds) | 1u;
    for (uint from = 0u; from < side; from += chunk) {
        barrier();
        if (lane < rows) {
            [[unroll]] for (uint c = 0u; c < chunk; ++c) {
                uint i = from + c + kInset, to = lane * chunk + c;
                if (from + c >= side) break;
                vec3 position;
                Frame frame;
                finish(row, parameterPair(i, rate), position, frame);
                if (kPolar && j == rate) position = apex;
                if (kCornerNormals && !kInterior && (i == 0u || i == rate) && (j == 0u || j == rate)) {
                    PatchPlace at = PATCH_IN_PLACE(share, place);
                    frame = withCornerNormal(frame, i, j, rate, normalSlots(at.record), at.base);
                }
                if (kTangents) {
                    PatchPlace at = PATCH_IN_PLACE(share, place);
                    uint own = (j - kInset) * side + from + c;
                    storeTangent(at.vertex + own, at.own + own, frame);
                }
                localElements[to].xyz = position;
                uvec3 words = normalWords(frame.normal);
                for (uint k = 0u; k < kNormalWords; ++k) localNormals[kNormalWords * to + k] = words[k];
            }
        }
        barrier();
        for (uint n = lane; n < rows * chunk * kVertexStores; n += gl_WorkGroupSize.x) {
            uint at = n / kVertexStores, slot = at / chunk, c = at - slot * chunk;
            if (from + c >= side) continue;
            uint vertex = localRows[slot] + from + c, word = kNormalWords * at;
            if (n - at * kVertexStores == 0u)
                storePosition(vertex, localVector(at), kNormalWords == 1u ? localNormals[word] : 0u);
            else
                storeNormal(vertex, uvec3(localNormals[word], localNormals[word + 1u], localNormals[word + 2u]));
        }
    }
}
#endif

#if defined(WIDE) && defined(LEVELS)
const uint kRowsAtOnce = kPerturbed ? 24u : 51u; // with the coefficients below 16 KiB, which every device has
const uint kColumns = 4u * kRowsAtOnce;          // of a kind; of perturbations 4 outer ones and 4 with 2 inner ones follow
shared vec4 localPoints[(kPerturbed ? 3u : 1u) * kColumns];
shared vec4 localSlopes[(kPerturbed ? 4u : 2u) * kColumns]; // relative points and slopes; slopes of perturbations

// Collapses a column of the patch in a place of the workgroup into column `to` of the shared ones.
void collapseLocal(uint to, uint place, uint i, vec2 v) {
    vec3 g[4], relative[4], point, fromFirst, slope;
    uint from = place * kLocalStride;
    localColumn(from, i, g, relative);
    collapseColumn(v, g, relative, point, fromFirst, slope);
    localPoints[to] = vec4(point, 0.0);
    localSlopes[to] = vec4(fromFirst, 0.0);
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
            if (!at.empty) collapseLocal(n, place, n & 3u, lodV(place, at.capacity, i, row - place * side));
        }
        barrier();
        for (uint n = gl_LocalInvocationID.x; n < count * side; n += gl_WorkGroupSize.x) {
            uint slot = n / side, row = firstRow + slot, place = row / side, i = n - slot * side, j = row - place * side;
            PatchPlace at = PATCH_IN_PLACE(share, place);
            vec3 position = vec3(0.0);
            Frame frame = Frame(vec3(0.0), vec3(0.0), vec3(0.0));
            if (!at.empty) {
                finish(localRow(3u * slot + (i == 0u ? 1u : i == at.capacity ? 2u : 0u)), lodU(place, at.capacity, i, j),
                       position, frame);
                if (kPolar && j == at.capacity) position = localVector(place * kLocalStride + localSlot(12u));
                if (kCornerNormals) frame = withCornerNormal(frame, i, j, at.capacity, normalSlots(at.record), at.base);
            }
            uint own = j * side + i;
            storeSurfaceVertex(at.vertex + own, at.own + own, position, frame);
        }
    }
}
#endif
