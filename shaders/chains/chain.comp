// Limit points, normals and chains of vertices that are not plain (docs/catmull_clark.md; with TRIANGLES docs/loop.md). Limits: one
// invocation a vertex and instance. Chains: one a spoke or centre and instance. In the narrow mapping they make one level. In the
// wide mapping they go from level to level in workgroup memory, unless a vertex has many faces. With LEVELS a level is made for the
// instances that lod/depth.comp has listed.
#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef LEVELS
#define PUSH_CONSTANTS DepthPush
#include "shaders/shared/lod.h"
#else
#define PUSH_CONSTANTS ConstructPush
#endif
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/chains.h"
#include "shaders/shared/subdivision.h"

#ifdef LEVELS
#include "shaders/lod/scratch.glsl"
uint listedCount() { return min(levelWord(header.depths + kDepthCounts + push.depth), instanceCount()); }
uint itemOfList() { return min(invocationIndex(), push.count * listedCount() - 1u); }
uint slotOfItem(uint item) {
    return slotOf(levelWord(levelBase(item / push.count) + header.depths + kDepthEntries + push.depth));
}
#else
uint itemOfList() { return itemOfLane(); }
uint slotOfItem(uint item) { return instanceOf(item); }
#endif

#ifdef TRIANGLES
#define LOOP_RULES
const uint kPointsOfSpoke = 1u; // of ring 1
#else
const uint kPointsOfSpoke = 2u;
#endif

layout(constant_id = kKindConstant) const uint kMakes = kMakesLimits;

uint base;   // of the instance in the pool
uint source; // what the rules read: the first word of the net, or the first point of the level before
uint netFirst; // what the net counts from
vec3 centre; // of level 1

#ifdef WIDE
const uint kBlocks = gl_WorkGroupSize.x / kBlockLanes; // of a workgroup
shared vec4 localPoints[kMakes == kMakesChains ? kBlocks * kBlockPoints : 1u];
#endif

vec3 netPoint(uint i) { return poolVector(base + netFirst + halfOf(tableWord(source + i / 2u), i)); }
vec3 netOffset(uint i) {
    precise vec3 offset = netPoint(i) - centre;
    return offset;
}
vec3 point(uint i) {
#ifdef WIDE
    if (kMakes == kMakesChains) return localPoints[source + i].xyz;
#endif
    if (kMakes == kMakesLevel) return poolVector(source + i);
    return netOffset(i);
}
#include "shaders/subdivision/rules.glsl"

// Sums over offsets of spoke and face points of ring 1 from the centre.
struct RingSums {
    vec3 spokes, faces;
};
void addToSums(inout RingSums sums, vec3 p, uint i) {
    if (kLoop || (i & 1u) != 0u) {
        precise vec3 spokes = sums.spokes + p;
        sums.spokes = spokes;
    } else {
        precise vec3 faces = sums.faces + p;
        sums.faces = faces;
    }
}

// Weights act on the differences to the centre. The position is the same in all runs. Lanes have loops of different lengths, so
// these are tested at the top: in one that is tested at the bottom lavapipe 22.3 goes on adding for lanes that have finished.
RingSums storeLimits(uint arrangement, uint limitIndex, uint normalIndex) {
    uvec4 head = tableElement(arrangement);
    RingSums sums = RingSums(vec3(0.0), vec3(0.0));
    uint runs = head.x, ring = head.w, at = arrangement + 1u;
    for (uint run = 0u; run < runs; ++run) {
        uint blocks = tableElement(at++).x;
        vec3 normal = vec3(0.0), last = vec3(0.0);
        for (uint block = 0u; block < blocks; ++block) {
            precise vec3 a = vec3(0.0), b = vec3(0.0), d = vec3(0.0), e = vec3(0.0);
            for (uint i = 1u; i <= ring; ++i) {
                vec3 p = point(i);
                if (run == 0u && block == 0u) addToSums(sums, p, i);
                vec4 w = uintBitsToFloat(tableElement(at++));
                a = a + w.x * p;
                b = b + w.y * p;
                d = d + w.z * p;
                e = e + w.w * p;
            }
            if (block > 0u) {
                normal += cross(last, a) + cross(a, b);
            } else if (run == 0u) {
                precise vec3 sum = centre + a;
                storePool(limitIndex, sum);
            }
            normal += cross(b, d) + cross(d, e);
            last = e;
        }
        pool.at[normalIndex + run] = vec4(normal, 0.0);
    }
    return sums;
}

// The centre of level 2 of a chain that is made level by level. It is made of the points that the limit is made of.
void storeCentre(uint fanElement, uint arrangement, RingSums sums, uint to) {
    uvec4 step = tableElement(tableElement(arrangement).z);
    vec2 weights = uintBitsToFloat(tableElement(fanElement + 1u).xy);
    vec3 first = point(1u + kPointsOfSpoke * step.z), second = point(1u + kPointsOfSpoke * step.w);
    vec3 p = nextCentre(vec3(0.0), sums.spokes, sums.faces, weights, uintBitsToFloat(step.x), uintBitsToFloat(step.y), first, second);
    pool.at[to] = vec4(p, 0.0);
}

uvec4 fan; // sectors, points of a level, whether it is open

void put(uint to, vec3 p) {
#ifdef WIDE
    if (kMakes == kMakesChains) {
        localPoints[to] = vec4(p, 0.0);
        return;
    }
#endif
    pool.at[to] = vec4(p, 0.0);
}

#ifdef TRIANGLES
// Spiral index of a point a steps along spoke h and b along the next one (surface/subdivision/pattern.h).
uint pointIndex(uint h, uint a, uint b) {
    uint r = a + b;
    if (r == 0u) return 0u;
    uint place = r * h + b;
    if (fan.z == 0u && place == r * fan.x) place = 0u; // the last spoke is the first
    return 1u + fan.x * r * (r - 1u) / 2u + fan.z * (r - 1u) + place;
}

// What comes of a spoke: its own three points, and those of its sector at (1, 1), (2, 1), (1, 2); or the centre alone.
struct SpokePoints {
    vec3 onSpoke[3], inside[3];
};
SpokePoints spokePoints(uint h, float sharpness) {
    // What lies outside of an open fan counts nothing: its borders are sharp. Its last spoke has no sector.
    uint before = h == 0u ? fan.x - 1u : h - 1u, own = h == fan.x ? 0u : 1u, beside = fan.z != 0u && h == 0u ? 0u : 1u;
    vec3 c = point(0u), near = point(pointIndex(h, 1u, 0u)), far = point(pointIndex(h, 2u, 0u));
    vec3 left = point(own * pointIndex(h, 0u, 1u)), leftFar = point(own * pointIndex(h, 1u, 1u));
    vec3 leftEnd = point(own * pointIndex(h, 0u, 2u));
    vec3 right = point(beside * pointIndex(before, 1u, 0u)), rightFar = point(beside * pointIndex(before, 1u, 1u));
    SpokePoints to;
    to.onSpoke[0] = edgePoint(c, near, left, left, right, right, sharpness);
    to.onSpoke[1] = vertexPoint(near, vec3[8](far, leftFar, left, c, right, rightFar, c, c), sharpness);
    to.onSpoke[2] = edgePoint(near, far, leftFar, leftFar, rightFar, rightFar, sharpness);
    to.inside[0] = edgePoint(near, left, c, c, leftFar, leftFar, 0.0);
    to.inside[1] = edgePoint(near, leftFar, far, far, left, left, 0.0);
    to.inside[2] = edgePoint(left, leftFar, near, near, leftEnd, leftEnd, 0.0);
    return to;
}
void putSpokePoints(uint target, uint h, SpokePoints p) {
    for (uint i = 0u; i < 3u; ++i) put(target + pointIndex(h, i + 1u, 0u), p.onSpoke[i]);
    if (h == fan.x) return;
    put(target + pointIndex(h, 1u, 1u), p.inside[0]);
    put(target + pointIndex(h, 2u, 1u), p.inside[1]);
    put(target + pointIndex(h, 1u, 2u), p.inside[2]);
}
#else
// Spiral index of a point a steps along spoke h and b along the next one (surface/subdivision/pattern.h).
uint pointIndex(uint h, uint a, uint b) {
    uint r = max(a, b);
    if (r == 0u) return 0u;
    uint place = 2u * r * h + (a >= b ? b : 2u * b - a);
    if (fan.z == 0u && place == 2u * r * fan.x) place = 0u; // the last spoke is the first
    return 1u + fan.x * r * (r - 1u) + fan.z * (r - 1u) + place;
}

// What comes of a spoke: the nine points of its sector and its own three, or the centre alone.
struct SpokePoints {
    vec3 onSpoke[3], inside[3][3];
};
// They are sums of the 3 x 4 points round them, with the masks (1, 1) / 2 and (1, 6, 1) / 8 along either direction. On a sharp
// spoke the second mask is left out.
SpokePoints spokePoints(uint h, float sharpness) {
    bool beyond = h == fan.x; // the last spoke of an open fan has no sector
    uint before = h == 0u ? fan.x - 1u : h - 1u;
    vec3 rows[4][3]; // by j of -1..2
    for (uint j = 0u; j < 4u; ++j) {
        vec3 p[3];
        for (uint i = 0u; i < 3u; ++i) {
            // What lies outside of an open fan counts nothing: its borders are sharp.
            bool outside = j == 0u ? fan.z != 0u && h == 0u : beyond && j > 1u;
            p[i] = point(outside ? 0u : j == 0u ? pointIndex(before, 1u, i) : pointIndex(h, i, j - 1u));
        }
        precise vec3 first = (p[0] + p[1]) * 0.5, second = (p[0] + p[2] + 6.0 * p[1]) * 0.125, third = (p[1] + p[2]) * 0.5;
        rows[j] = vec3[3](first, second, third);
    }
    SpokePoints to;
    for (uint i = 0u; i < 3u; ++i) {
        precise vec3 onSpoke = (rows[0][i] + rows[2][i] + 6.0 * rows[1][i]) * 0.125;
        to.onSpoke[i] = blended(sharpness, onSpoke, rows[1][i]);
        precise vec3 first = (rows[1][i] + rows[2][i]) * 0.5, second = (rows[1][i] + rows[3][i] + 6.0 * rows[2][i]) * 0.125;
        precise vec3 third = (rows[2][i] + rows[3][i]) * 0.5;
        to.inside[i] = vec3[3](first, second, third);
    }
    return to;
}
void putSpokePoints(uint target, uint h, SpokePoints p) {
    for (uint i = 0u; i < 3u; ++i) {
        put(target + pointIndex(h, i + 1u, 0u), p.onSpoke[i]);
        if (h == fan.x) continue;
        for (uint j = 0u; j < 3u; ++j) put(target + pointIndex(h, i + 1u, j + 1u), p.inside[i][j]);
    }
}
#endif

// A spoke or the centre of a chain. Level 2 has spokes alone here, unless it is made with the others in workgroup memory.
struct ChainItem {
    uint spoke; // the number of spokes: the centre
    uint steps, sharpness; // of its arrangement
};
ChainItem chainItem(uint record, uint spoke) {
    uvec4 arrangement = tableElement(tableElement(record).z);
    return ChainItem(spoke, arrangement.z, arrangement.y);
}
bool isCentre(ChainItem item) { return kMakes != kMakesFirstLevel && item.spoke == fan.x + fan.z; }
SpokePoints pointsOf(ChainItem item, uint firstWeights, uint level) {
    if (isCentre(item)) {
        vec2 weights = uintBitsToFloat(tableElement(firstWeights).xy);
        uvec4 step = tableElement(item.steps + level - 2u);
        SpokePoints to;
        to.onSpoke[0] = centrePoint(fan.x, weights, uintBitsToFloat(step.x), uintBitsToFloat(step.y), step.z, step.w);
        return to;
    }
    float sharpness = 0.0;
    if (item.sharpness != kNoSharpness) sharpness = softened(uintBitsToFloat(tableWord(item.sharpness + item.spoke)), level - 2u);
    return spokePoints(item.spoke, sharpness);
}
void putPoints(uint target, ChainItem item, SpokePoints p) {
    if (isCentre(item)) {
        put(target, p.onSpoke[0]);
        return;
    }
    putSpokePoints(target, item.spoke, p);
}

void readNet(uint record) {
    source = tableElement(record).x;
    netFirst = tableElement(record + 1u).z;
    centre = netPoint(0u);
}

#ifdef WIDE
// All levels. To be called by all lanes.
void makeChains(uvec4 block, uint lane) {
    uint first = gl_LocalInvocationID.x / kBlockLanes * kBlockPoints, vertices = block.z, spokes = fan.x + fan.z;
    uint net = 1u + 3u * kPointsOfSpoke * fan.x + 2u * fan.z; // points up to radius 2
    for (uint n = lane; n < vertices * net; n += kBlockLanes) {
        uint vertex = n / net, i = n - vertex * net;
        readNet(block.y + 2u * vertex);
        localPoints[first + vertex * fan.y + i] = vec4(netOffset(i), 0.0);
    }
    bool idle = lane >= vertices * (spokes + 1u);
    uint spoke = idle ? 0u : lane / vertices, vertex = idle ? 0u : lane - spoke * vertices;
    ChainItem item = chainItem(block.y + 2u * vertex, spoke);
    source = first + vertex * fan.y;
    for (uint level = 2u; level <= block.w; ++level) {
        barrier();
        SpokePoints p = pointsOf(item, block.x + 1u, level);
        barrier();
        if (!idle) putPoints(source, item, p);
        barrier();
        for (uint n = lane; n < vertices * fan.y; n += kBlockLanes) {
            uint of = n / fan.y, chain = tableElement(block.y + 2u * of + 1u).x;
            pool.at[base + chain + (level - 2u) * fan.y + n - of * fan.y] = localPoints[first + n];
        }
    }
}
#endif

// One of them. Idle lanes repeat the last item.
void makeLevel(uvec4 block, uint lane) {
    uint vertices = block.z & ((1u << kChainLevelShift) - 1u), level = block.z >> kChainLevelShift;
    uint items = fan.x + fan.z + (kMakes == kMakesFirstLevel ? 0u : 1u);
    uint n = min(block.w + lane, vertices * items - 1u), spoke = n / vertices;
    uint record = block.y + 2u * (n - spoke * vertices), target = base + tableElement(record + 1u).x + (level - 2u) * fan.y;
    if (kMakes == kMakesFirstLevel) readNet(record);
    else source = target - fan.y;
    ChainItem item = chainItem(record, spoke);
    putPoints(target, item, pointsOf(item, block.x + 1u, level));
}

void main() {
    uint item = itemOfList(), lane = elementOf(item);
    base = poolBase(slotOfItem(item));
    if (kMakes == kMakesLimits) {
        uint record = push.table + 2u * lane;
        uvec4 a = tableElement(record), b = tableElement(record + 1u);
        readNet(record);
        RingSums sums = storeLimits(a.z, base + a.w, base + b.y);
        if (b.w != 0u) storeCentre(a.y, a.z, sums, base + b.w);
        if (b.x != 0u) pool.at[base + b.x - 1u] = vec4(centre, 0.0);
        return;
    }
    uvec4 block = tableElement(push.table + lane / kBlockLanes);
    fan = tableElement(block.x);
#ifdef WIDE
    if (kMakes == kMakesChains) {
        makeChains(block, gl_LocalInvocationID.x % kBlockLanes);
        return;
    }
#endif
    makeLevel(block, lane % kBlockLanes);
}
