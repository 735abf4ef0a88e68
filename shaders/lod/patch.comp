// Levels of patches: the largest of a patch's edges and of what its inside asks for, counted into the histograms that the
// budget is solved with (docs/lod.md, "Levels" and "The budget"); and whether they surely show their backs, which leaves them
// out of everything. One invocation a patch and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define LOD_WRITE
#define PUSH_CONSTANTS LodPush
#include "shaders/shared/lod.h"
#include "shaders/shared/pm.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/net.glsl"
#include "shaders/lod/lod.glsl"
#include "shaders/lod/levels.glsl"
#include "shaders/lod/facing.glsl"

// What is measured: bicubic nets or sectors, by a constant; or CHARTS; or HALVES; or TRIANGLES, of which a constant tells regular and
// irregular ones apart. One kernel never has two of them: lavapipe goes through both sides of every `if`.
layout(constant_id = kKindConstant) const uint kMeasures = kMeasuresNets;
#if defined(CHARTS) || defined(HALVES) || defined(TRIANGLES)
const bool kCubics = false;
#else
const bool kCubics = true;
#endif
const bool kNets = kCubics && kMeasures == kMeasuresNets;
#ifdef HALVES // of exact Catmull-Clark
#include "shaders/shared/chains.h"
#include "shaders/chains/leaf.glsl"
#endif
#ifdef TRIANGLES // of Loop
#include "shaders/shared/chains.h"
const bool kTangents = false, kSemiSharp = false;
#include "shaders/evaluate/frame.glsl"
struct PatchPlace {
    uint record, base;
};
vec3 poolPoint(const PatchPlace at, uint i) { return poolVector(at.base + i); }
#include "shaders/loop/sample.glsl"
const bool kIrregularTriangles = kMeasures == kMeasuresIrregularTriangles;
#endif
#ifdef BACK_FACES
const bool kBackFaces = true; // patches that show their backs are left out
#else
const bool kBackFaces = false;
#endif
const bool kSharp = true;
#include "shaders/blend/blend.glsl"

vec3 coefficient(uint i, bool today) { return poolVector(i); }
#include "shaders/pm/load.glsl"
#ifdef TRIANGLES
#include "shaders/lod/triangle_sectors.glsl"
#endif

// Levels are the same to the bit whether or not back faces are looked for: all that leads to them is precise.

// The net of a bicubic patch, row by row.
vec3[16] bicubicNet(uint record, uint base, bool polar) {
    precise vec3 g[16];
    NetRecord net = netRecord(record);
    for (uint k = 0u; k < 16u; ++k) g[k] = poolVector(base + netIndex(net, polar, k));
    // Offsets from their corners (shared/surface.h); the rows of corners last. A polar patch has its apex all along row 3.
    for (uint k = 4u; k < 8u; ++k) g[k] += g[k / 2u % 2u * 3u];
    for (uint k = 8u; k < 12u; ++k) g[k] += g[12u + k / 2u % 2u * 3u];
    g[1] += g[0];
    g[2] += g[3];
    if (!polar) {
        g[13] += g[12];
        g[14] += g[15];
    }
    return g;
}

// The larger second difference of a row of a net, and its length.
vec2 measureOfRow(vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 first = (a + c) - 2.0 * b, second = (b + d) - 2.0 * c, ab = b - a, bc = c - b, cd = d - c;
    precise float rowLength = lengthOf(ab) + lengthOf(bc) + lengthOf(cd);
    return vec2(max(lengthOf(first), lengthOf(second)), rowLength);
}
// What the inside of a bicubic patch asks for along u and along v: its net's largest second differences.
vec2 bicubicLevels(vec3 g[16]) {
    vec2 alongU = vec2(0.0), alongV = vec2(0.0);
    for (uint k = 0u; k < 4u; ++k) {
        alongU = max(alongU, measureOfRow(g[4u * k], g[4u * k + 1u], g[4u * k + 2u], g[4u * k + 3u]));
        alongV = max(alongV, measureOfRow(g[k], g[4u + k], g[8u + k], g[12u + k]));
    }
    precise vec3 centre = 0.25 * ((g[0] + g[15]) + (g[3] + g[12]));
    precise float radius = 0.25 * (alongU.y + alongV.y);
    float pixels = pixelsPerUnit(centre, radius);
    return vec2(levelOf(alongU.y, alongU.x, pixels), levelOf(alongV.y, alongV.x, pixels));
}

// And of a patch of sectors: how far its centre lies from the mean of its corners.
float sectorLevel(uint record, uint sides, uint base) {
    vec3 corners[5];
    precise vec3 mean = vec3(0.0);
    for (uint i = 0u; i < sides; ++i) {
        corners[i] = poolVector(base + pointIndex(record, i));
        mean += corners[i] / float(sides);
    }
    vec3 centre = poolVector(base + centreIndex(record, sides));
    float reach = 0.0;
    for (uint i = 0u; i < sides; ++i) {
        precise vec3 away = corners[i] - centre;
        reach = max(reach, lengthOf(away));
    }
    precise vec3 sag = mean - centre;
    // A cubic's second differences b make a sag of 3/4 b.
    return levelOf(2.0 * reach, lengthOf(sag) * (4.0 / 3.0), pixelsPerUnit(centre, reach));
}

// And of a blend of charts: along the middle, by quarters.
vec2 chartLevels(uint record, uint base) {
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint poolIndex;
        corners[k] = cornerOf(record + k, poolIndex);
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = poolVector(base + poolIndex + c);
    }
    vec2 bend = vec2(0.0), curveLength = vec2(0.0);
    vec3 centre = vec3(0.0);
    for (uint axis = 0u; axis < 2u; ++axis) {
        vec3 first = vec3(0.0), second = vec3(0.0); // the last point but one, the last
        for (uint i = 0u; i < 5u; ++i) {
            vec2 along = vec2(0.25 * float(i), 1.0 - 0.25 * float(i));
            vec3 point, du, dv;
            blendAt(corners, axis == 0u ? along : vec2(0.5), axis == 0u ? vec2(0.5) : along, point, du, dv);
            if (i > 0u) curveLength[axis] += lengthOf(point - second);
            if (i > 1u) bend[axis] = max(bend[axis], lengthOf((first + point) - 2.0 * second));
            if (i == 2u) centre = point;
            first = second;
            second = point;
        }
    }
    bend *= 16.0 / 6.0;
    float pixels = pixelsPerUnit(centre, 0.25 * (curveLength.x + curveLength.y));
    return vec2(levelOf(curveLength.x, bend.x, pixels), levelOf(curveLength.y, bend.y, pixels));
}

#ifdef HALVES
// And of an irregular quad: the second differences of its corners, the middles of its sides and its own middle, all of them limit
// points. The middles come from the points of level 1, where a sharp side counts alone.
vec2 irregularLevels(uint record, uint base) {
    uvec4 corners = tableElement(record);
    vec3 net[kNetPoints], x[9]; // x: row by row in v
    uvec4 netList[kNetListElements];
    [[unroll]] for (uint e = 0u; e < kNetListElements; ++e) netList[e] = tableElement(record + kQuadNetElement + e);
    uvec4 end = netList[kNetListElements - 1u];
    uint first = base + (end.w >> kNetFirstShift);
    vec4 sharpness = vec4(0.0);
    if (halfOf(end.x, kNetListSharp) != 0u) sharpness = uintBitsToFloat(tableElement(record + kQuadSharpnessElement));
    [[unroll]] for (uint k = 0u; k < kNetPoints; ++k) {
        net[k] = poolVector(first + halfOf(netList[k / 8u][k / 2u % 4u], k));
    }
    const uint kPlaces[4] = uint[4](0u, 2u, 8u, 6u), kMiddles[4] = uint[4](1u, 5u, 7u, 3u);
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        x[kPlaces[k]] = poolVector(base + corners[k]);
        uint middle = SUPPLE_QUAD_SIDE_MIDDLE(k), along = (k & 1u) == 0u ? 1u : kNetSide, across = kNetSide + 1u - along;
        float share = besideLine(sharpness[k]);
        vec3 line[3];
        [[unroll]] for (uint n = 0u; n < 3u; ++n) {
            uint at = middle + n * along - along;
            line[n] = onLine(net[at], net[at - across], net[at + across], share);
        }
        x[kMiddles[k]] = middleOfLine(line[0], line[1], line[2]);
    }
    x[4] = (16.0 * net[kNetMiddle] + 4.0 * (net[7] + net[11] + net[13] + net[17]) + (net[6] + net[8] + net[16] + net[18])) / 36.0;
    vec2 bend = vec2(0.0), curveLength = vec2(0.0);
    [[unroll]] for (uint k = 0u; k < 3u; ++k) {
        vec3 a = x[3u * k], b = x[3u * k + 1u], c = x[3u * k + 2u];
        bend.x = max(bend.x, lengthOf((a + c) - 2.0 * b));
        curveLength.x = max(curveLength.x, lengthOf(b - a) + lengthOf(c - b));
        a = x[k], b = x[k + 3u], c = x[k + 6u];
        bend.y = max(bend.y, lengthOf((a + c) - 2.0 * b));
        curveLength.y = max(curveLength.y, lengthOf(b - a) + lengthOf(c - b));
    }
    bend *= 4.0 / 6.0;
    float pixels = pixelsPerUnit(x[4], 0.25 * (curveLength.x + curveLength.y));
    return vec2(levelOf(curveLength.x, bend.x, pixels), levelOf(curveLength.y, bend.y, pixels));
}
#endif

#ifdef TRIANGLES
// And of a Loop patch: as of sectors. Its middle is that of a leaf, of level 1 in an irregular triangle. That of a triangle with
// semi-sharp creases may lie by 1 / 162 of their excess further in than is measured here.
float triangleLevel(uint record, uint base) {
    PatchPlace at = PatchPlace(record, base);
    Triangle t = triangleOf(record, kIrregularTriangles);
    LeafPoints leaf;
    if (kIrregularTriangles) leaf = leafInCell(at, ownNet(at, t), true, kMiddleCell);
    else leaf = cageLeaf(at, t);
    vec3 outer = (leaf.p[3] + leaf.p[4] + leaf.p[5]) + (leaf.p[9] + leaf.p[10] + leaf.p[11]);
    vec3 centre = (92.0 * (leaf.p[0] + leaf.p[1] + leaf.p[2]) + 14.0 * (leaf.p[6] + leaf.p[7] + leaf.p[8]) + outer) / 324.0;
    vec3 corners[3], mean = vec3(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        corners[i] = cornerLimit(at, t, i);
        mean += corners[i] / 3.0;
    }
    float reach = 0.0;
    for (uint i = 0u; i < 3u; ++i) reach = max(reach, lengthOf(corners[i] - centre));
    return levelOf(2.0 * reach, lengthOf(mean - centre) * (4.0 / 3.0), pixelsPerUnit(centre, reach));
}
#endif

// Orthographic: the direction it looks in, which all rays have.
bool orthographic() { return LOD_CAMERA.orthographic != 0u; }
vec3 camera() { return vec3(LOD_CAMERA.position[0], LOD_CAMERA.position[1], LOD_CAMERA.position[2]); }

mat3 frameAt(vec3 middle) { return frameTowards(orthographic() ? camera() : middle - camera()); }
Pyramid emptyPyramid() {
    return orthographic() ? Pyramid(vec2(0.0), vec2(0.0), 1.0) : Pyramid(vec2(1e30), vec2(-1e30), 1e30);
}

// Degree 5 of p-rep's perturbed patches as what it can differ by at most: h in evaluation order (shared/prep.h).
struct Perturbation {
    float reach, alongU, alongV, bendU, bendV; // of a point, of a cubic's differences and second differences
};
const Perturbation kNoPerturbation = Perturbation(0.0, 0.0, 0.0, 0.0, 0.0);
Perturbation perturbationOf(uint record, uint base) {
    vec3 h[16];
    uvec4 edges = tableElement(record + 2u);
    for (uint k = 0u; k < 16u; ++k) h[k] = poolVector(base + perturbationIndex(edges, k));
    // In either half: (2, j) and (3, j) for j = 0, 1, 4, 5, which the first parameter takes in from 0 and out to 0 again,
    // while the second one's differences are between j = 0 and 1, 1 and 2, 3 and 4, 4 and 5.
    Perturbation p = kNoPerturbation;
    for (uint k = 0u; k < 16u; ++k) p.reach = max(p.reach, lengthOf(h[k]));
    vec2 inner[2] = vec2[2](vec2(0.0), vec2(0.0)), outer[2] = vec2[2](vec2(0.0), vec2(0.0)); // first and second differences
    for (uint part = 0u; part < 2u; ++part) {
        for (uint k = 0u; k < 4u; ++k) {
            // First half: h_2j for four j, then h_3j; second half: (h_i2, h_i3) for four i.
            vec3 two = part == 0u ? h[k] : h[8u + 2u * k], three = part == 0u ? h[4u + k] : h[9u + 2u * k];
            float either = max(lengthOf(two), lengthOf(three));
            inner[part] = max(inner[part], vec2(max(either, lengthOf(three - two)),
                                                max(either, max(lengthOf(three - 2.0 * two), lengthOf(two - 2.0 * three)))));
        }
        for (uint side = 0u; side < 2u; ++side) {
            vec3 a = part == 0u ? h[4u * side] : h[8u + side], b = part == 0u ? h[4u * side + 1u] : h[10u + side];
            vec3 c = part == 0u ? h[4u * side + 2u] : h[12u + side], d = part == 0u ? h[4u * side + 3u] : h[14u + side];
            float either = max(lengthOf(b), lengthOf(c));
            outer[part] = max(outer[part], vec2(max(either, max(lengthOf(b - a), lengthOf(d - c))),
                                                max(either, max(lengthOf(a - 2.0 * b), lengthOf(d - 2.0 * c)))));
        }
    }
    // Degree 5 against 3, and 5 * 4 against 3 * 2.
    vec2 factors = vec2(5.0 / 3.0, 20.0 / 6.0), u = factors * max(inner[0], outer[1]), v = factors * max(inner[1], outer[0]);
    p.alongU = u.x;
    p.alongV = v.x;
    p.bendU = u.y;
    p.bendV = v.y;
    return p;
}

// `reach`: of the borders at i = 0 and 3, j = 0 and 3.
bool bicubicShowsBack(vec3 g[16], Perturbation p, vec4 reach) {
    vec3 from = orthographic() ? vec3(0.0) : camera();
    mat3 frame = frameAt(0.25 * ((g[0] + g[15]) + (g[3] + g[12])));
    vec3 m = frame * ((g[3] - g[0]) + (g[15] - g[12])), n = frame * ((g[12] - g[0]) + (g[15] - g[3]));
    if (!(cross(m, n).z > 0.0)) return false; // the one that most are decided by
    Pyramid pyramid = emptyPyramid();
    for (uint k = 0u; k < 16u; ++k) {
        g[k] = frame * (g[k] - from);
        if (!orthographic()) hold(pyramid, g[k], p.reach);
    }
    Facing f = facingOf(pyramid, m, n);
    if (!(pyramid.nearest > 0.0 && f.leastArea > 0.0)) return false;
    vec2 sizes = vec2(seenSize(f, m), seenSize(f, n));
    for (uint j = 0u; j < 4u; ++j) {
        for (uint i = 0u; i < 3u; ++i) addAlong(f, g[4u * j + i + 1u] - g[4u * j + i], sizes * p.alongU);
    }
    for (uint j = 0u; j < 3u; ++j) {
        for (uint i = 0u; i < 4u; ++i) addAcross(f, g[4u * j + i + 4u] - g[4u * j + i], sizes * p.alongV);
    }
    if (!showsBack(f)) return false;
    for (uint side = 0u; side < 4u; ++side) {
        bool across = side < 2u;
        uint step = across ? 4u : 1u, border = side == 1u ? 3u : side == 3u ? 12u : 0u;
        uint beside = side == 0u ? 1u : side == 1u ? 2u : side == 2u ? 4u : 8u;
        Border b = borderOf(g[border + 3u * step] - g[border], across ? -m : n);
        for (uint row = 0u; row < 2u; ++row) {
            uint at = row == 0u ? border : beside;
            vec3 before = vec3(0.0);
            for (uint k = 0u; k < 3u; ++k, at += step) {
                vec3 d = g[at + step] - g[at];
                addDifference(b, f, d, across ? p.alongV : p.alongU);
                if (k > 0u) addSecondDifference(b, f, d - before, across ? p.bendV : p.bendU);
                before = d;
            }
        }
        float rise = across ? riseAcross(f, b.chord) : riseAlong(f, b.chord);
        if (!isStraight(b, rise, across ? f.mostY : f.mostZ, reach[side], 1.0)) return false;
    }
    return true;
}

bool sectorShowsBack(Sector s, float reach) {
    const uint kFirst[10] = uint[10](0u, 1u, 2u, 3u, 5u, 6u, 7u, 9u, 10u, 12u);
    const uint kSecond[10] = uint[10](1u, 2u, 3u, 4u, 6u, 7u, 8u, 10u, 11u, 13u);
    const uint kInner[10] = uint[10](5u, 6u, 7u, 8u, 9u, 10u, 11u, 12u, 13u, 14u);
    mat3 frame = frameAt(s.centre + (s.c[0] + s.c[4]) / 3.0);
    vec3 centre = orthographic() ? vec3(0.0) : frame * (s.centre - camera());
    Pyramid pyramid = emptyPyramid();
    for (uint k = 0u; k < 15u; ++k) {
        s.c[k] = frame * s.c[k];
        if (!orthographic()) hold(pyramid, centre + s.c[k], 0.0);
    }
    // Across: towards the centre, which rings reach half way along the sides.
    vec3 chord = s.c[4] - s.c[0];
    Facing f = facingOf(pyramid, chord, 2.0 * s.c[14] - s.c[0] - s.c[4]);
    if (!(pyramid.nearest > 0.0 && f.leastArea > 0.0)) return false;
    Border b = borderOf(chord, f.n);
    vec3 before = vec3(0.0);
    for (uint k = 0u; k < 10u; ++k) {
        vec3 along = s.c[kSecond[k]] - s.c[kFirst[k]];
        addAlong(f, along, vec2(0.0));
        addAcross(f, 2.0 * (s.c[kInner[k]] - s.c[kFirst[k]]) - along, vec2(0.0));
        if (k < 7u) { // the border, and the row beside it
            addDifference(b, f, along, 0.0);
            if (k != 0u && k != 4u) addSecondDifference(b, f, along - before, 0.0);
        }
        before = along;
    }
    // Degree 4: 4 * 3 / 4 against 3 * 2 / 3.
    return showsBack(f) && isStraight(b, f.leastT, f.mostZ, reach, 1.5);
}

// Of a patch of sectors: by its corners alone, whether there is anything to it.
bool mayShowBack(uint record, uint sides, uint base) {
    vec3 centre = poolVector(base + centreIndex(record, sides)), w = orthographic() ? camera() : centre - camera();
    vec3 first = poolVector(base + pointIndex(record, 0u)) - centre, from = first;
    bool may = true;
    for (uint i = 1u; i <= sides; ++i) {
        vec3 to = i == sides ? first : poolVector(base + pointIndex(record, i)) - centre;
        may = may && dot(w, cross(from, to)) > 0.0;
        from = to;
    }
    return may;
}

#ifdef TRIANGLES
// Judges a regular triangle of Loop sector by sector.
bool triangleShowsBack(uint record, uint base, vec4 levels, float inside) {
    PatchPlace at = PatchPlace(record, base);
    LeafPoints points = cageLeaf(at, triangleOf(record, false));
    TriangleNet net = triangleNet(leafOf(points));
    bool back = true; // stays false even if lavapipe goes on with lanes that have finished
    uint side = 0u;
    do {
        bool own = sectorShowsBack(sectorOf(net, points.p[0]), reachOfBorder(levels[side], inside));
        back = back && own;
        net = turnedOnce(net);
    } while (back && ++side < 3u);
    return back;
}
#endif

// `levels`: of edges 0..3, `fifth` of edge 4, `inside` of the inside along u and along v: before the budget, which scales
// them together, but none to below 1. A polar patch shows nothing: at its apex the sides across meet, and what bends there
// turns triangles over however little it does.
bool showsItsBack(uint patchClass, uint record, uint base, uint sides, vec3 g[16], vec4 levels, float fifth, vec2 inside) {
#ifdef TRIANGLES
    return triangleShowsBack(record, base, levels, inside.x);
#else
    if (patchClass == kPolarPatch) return false;
    if (!kNets) {
        vec2 ray = vec2(SUPPLE_PM_RAY_MIDDLE(sides), SUPPLE_PM_RAY_SIDE(sides));
        bool back = mayShowBack(record, sides, base);
        for (uint i = 0u; back && i < sides; ++i) {
            float reach = reachOfBorder(i < 4u ? levels[i] : fifth, inside.x);
            back = sectorShowsBack(loadSector(sides, ray, record, base, i, false), reach);
        }
        return back;
    }
    Perturbation p = kNoPerturbation;
    if (patchClass == kPerturbedPatch) p = perturbationOf(record, base);
    vec2 across = max(max(levels.xy, levels.zw), inside); // rows have the finer of theirs, and of the borders beside them
    return bicubicShowsBack(g, p, vec4(reachOfBorder(levels.w, across.x), reachOfBorder(levels.y, across.x),
                                       reachOfBorder(levels.x, across.y), reachOfBorder(levels.z, across.y)));
#endif
}

shared uint commonPlace, commonSums[3];

// Counts a patch into its bin. On GPUs a workgroup first adds up what falls where its first patch does: of instances of one
// level that is all there is, and so many atomics on one word would wait for each other.
void countPatch(bool counted, uint run, uint form, uint priority, uint bin, uint weight) {
    uint split = kLodSplit + (priority * kLodForms + form) * kLodBinStride + bin;
    uint place = SUPPLE_LOD_COUNTS(push.runs) + (run * kPriorityCount + priority) * kCountBins + max(bin, kFirstCountBin) - kFirstCountBin;
    uvec3 own = uvec3(kSplitUnit - weight, weight, 1u);
    if (kWide) {
        bool first = gl_LocalInvocationID.x == 0u;
        if (first) {
            commonPlace = counted ? place : kNoBin;
            for (uint k = 0u; k < 3u; ++k) commonSums[k] = 0u;
        }
        barrier();
        if (counted && place == commonPlace) {
            for (uint k = 0u; k < 3u; ++k) atomicAdd(commonSums[k], own[k]);
            counted = first;
        }
        barrier();
        if (first) own = uvec3(commonSums[0], commonSums[1], commonSums[2]);
    }
    if (!counted) return;
    atomicAdd(lodWords.at[split], own.x);
    if (own.y > 0u) atomicAdd(lodWords.at[split + 1u], own.y);
    atomicAdd(lodWords.at[place], own.z);
}

// Whether the instance hides the patch's part. What it hides is counted where its first patch is.
bool isHidden(uint listed, uint instance, uint patchIndex, uint part, bool inside) {
    if ((listed & kInstanceHidesParts) == 0u) return false;
    uint mask = push.masks + (push.window.firstSlot + instance) * push.maskWords;
    if (inside && patchIndex == 0u && push.countsHidden != 0u) atomicAdd(lodWords.at[kLodHidden], instanceWord(mask));
    return (instanceWord(mask + 1u + part / 32u) >> (part & 31u) & 1u) != 0u;
}

void main() {
    bool inside = invocationIndex() < itemCount(), counted = inside;
    uint item = itemOfLane(), patchIndex = push.first + elementOf(item), listed = entryOf(item);
    uint instance = slotOf(listed), priority = SUPPLE_INSTANCE_PRIORITY(listed);
    uint words = levelBase(instance), base = poolBase(instance);
    uvec4 edges = tableElement(header.levelPatches + 2u * patchIndex), more = tableElement(header.levelPatches + 2u * patchIndex + 1u);
    uint patchClass = more.w & ((1u << kLodPartShift) - 1u), part = more.w >> kLodPartShift;
    if (isHidden(listed, instance, patchIndex, part, inside)) counted = false;
    uint run = push.window.firstRun + more.y, runWord = lodWord(kLodRuns + kLodRunWords * run), form = runForm(runWord);
    uint sides = formSides(form);
    uint target = words + header.edgeCount + kLodPatchLevelWords * patchIndex;
    vec3 g[16];
    if (kNets && (push.levels == 0u || kBackFaces)) g = bicubicNet(more.z, base, patchClass == kPolarPatch);
    float level = 0.0, fifth = 0.0;
    vec4 ofEdges;
    vec2 own;
    if (push.levels != 0u) {
        level = fifth = levelOfEntry(item / push.count);
        ofEdges = vec4(level);
        own = vec2(level);
    } else {
        for (uint k = 0u; k < 4u; ++k) ofEdges[k] = k < sides ? uintBitsToFloat(levelWord(words + edges[k])) : 0.0;
        if (sides > 4u) fifth = uintBitsToFloat(levelWord(words + more.x));
#if defined(TRIANGLES)
        own = vec2(triangleLevel(more.z, base));
#elif defined(CHARTS)
        own = chartLevels(more.z, base);
#elif defined(HALVES)
        own = irregularLevels(more.z, base);
#else
        if (kNets) own = bicubicLevels(g);
        else own = vec2(sectorLevel(more.z, sides, base));
#endif
        level = max(max(max(ofEdges.x, ofEdges.y), max(ofEdges.z, ofEdges.w)), max(fifth, max(own.x, own.y)));
    }
    if (kBackFaces && counted) {
        bool doubleSided = (runWord & kRunIsDoubleSided) != 0u;
        vec2 across = form == kLodQuadForm ? own : vec2(level);
        if (!doubleSided && showsItsBack(patchClass, more.z, base, sides, g, ofEdges, fifth, across)) counted = false;
    }

    float at = (clamp(log2(max(level, 1e-3)), -float(kOctavesBelow), 7.99) + float(kOctavesBelow)) * float(kBinsPerOctave);
    uint bin = min(uint(at), kLodBins - 2u), weight = min(uint((at - float(bin)) * float(kSplitUnit)), kSplitUnit);
    if (inside) {
        scratchWords.at[target] = counted ? bin : kNoBin;
        scratchWords.at[target + 1u] = floatBitsToUint(own.x);
        scratchWords.at[target + 2u] = floatBitsToUint(own.y);
    }
    countPatch(counted, run, form, priority, bin, weight);
    bool chains = patchClass == kLoopIrregularPatch || patchClass == kLoopIrregularSharpPatch || patchClass == kIrregularPatch ||
                  patchClass == kIrregularSharpPatch;
    // Patches of hidden parts count too, so that hiding a part changes no other one.
    if (!kCubics && inside && chains) atomicMax(scratchWords.at[words + header.depths], floatBitsToUint(level));
}
