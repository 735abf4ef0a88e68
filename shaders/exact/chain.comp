// Limit points, normals and chains of vertices that are not plain (docs/exact.md). One invocation a vertex, or a spoke or the
// centre of a chain's level, and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/exact.h"
#include "shaders/shared/subdivision.h"

layout(constant_id = kKindConstant) const uint kMakes = kMakesLimits;

uint base;   // of the instance in the pool
uint source; // what the rules read: the first word of the net, or the pool index of the level before
vec3 centre; // of level 1

vec3 netPoint(uint i) { return poolVector(base + tableWord(source + i)); }
vec3 point(uint i) {
    if (kMakes == kMakesLevel) return poolVector(source + i);
    precise vec3 offset = netPoint(i) - centre;
    return offset;
}
#include "shaders/subdivision/rules.glsl"

// Weights act on the differences to the centre. The position is the same in all runs. Lanes have loops of different lengths, so
// these are tested at the top: in one that is tested at the bottom lavapipe 22.3 goes on adding for lanes that have finished.
void storeLimits(uint arrangement, uint limitIndex, uint normalIndex) {
    uvec4 head = tableElement(arrangement);
    uint runs = head.x, ring = head.w, at = arrangement + 1u;
    for (uint run = 0u; run < runs; ++run) {
        uint blocks = tableElement(at++).x;
        vec3 normal = vec3(0.0), last = vec3(0.0);
        for (uint block = 0u; block < blocks; ++block) {
            precise vec3 a = vec3(0.0), b = vec3(0.0), d = vec3(0.0), e = vec3(0.0);
            for (uint i = 1u; i <= ring; ++i) {
                vec3 p = point(i);
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
        pool[normalIndex + run] = vec4(normal, 0.0);
    }
}

uvec4 fan; // sectors, points of a level, whether it is open

// Spiral index of a point a steps along spoke h and b along the next one (surface/subdivision/pattern.h).
uint pointIndex(uint h, uint a, uint b) {
    uint r = max(a, b);
    if (r == 0u) return 0u;
    uint place = 2u * r * h + (a >= b ? b : 2u * b - a);
    if (fan.z == 0u && place == 2u * r * fan.x) place = 0u; // the last spoke is the first
    return 1u + fan.x * r * (r - 1u) + fan.z * (r - 1u) + place;
}

// The nine points of a sector and the three on its first spoke: of the 3 x 4 points round them, with the masks (1, 1) / 2 and
// (1, 6, 1) / 8 along either direction. On a sharp spoke the second mask is left out.
void storeSector(uint target, uint h, float sharpness) {
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
    for (uint i = 0u; i < 3u; ++i) {
        precise vec3 onSpoke = (rows[0][i] + rows[2][i] + 6.0 * rows[1][i]) * 0.125;
        pool[target + pointIndex(h, i + 1u, 0u)] = vec4(blended(sharpness, onSpoke, rows[1][i]), 0.0);
        if (beyond) continue;
        precise vec3 first = (rows[1][i] + rows[2][i]) * 0.5, second = (rows[1][i] + rows[3][i] + 6.0 * rows[2][i]) * 0.125;
        precise vec3 third = (rows[2][i] + rows[3][i]) * 0.5;
        pool[target + pointIndex(h, i + 1u, 1u)] = vec4(first, 0.0);
        pool[target + pointIndex(h, i + 1u, 2u)] = vec4(second, 0.0);
        pool[target + pointIndex(h, i + 1u, 3u)] = vec4(third, 0.0);
    }
}

void main() {
    uint item = itemOfLane(), lane = elementOf(item);
    base = instanceOf(item) * push.poolStride;
    if (kMakes == kMakesLimits) {
        uint record = push.table + 2u * lane;
        uvec4 a = tableElement(record), b = tableElement(record + 1u);
        source = a.x;
        centre = netPoint(0u);
        storeLimits(a.z, base + a.w, base + b.y);
        if (b.x != 0u) pool[base + b.x - 1u] = vec4(centre, 0.0);
        return;
    }
    uvec4 block = tableElement(push.table + lane / kBlockLanes);
    uint vertices = block.z & ((1u << kChainLevelShift) - 1u), level = block.z >> kChainLevelShift;
    fan = tableElement(block.x);
    uint spokes = fan.x + fan.z, n = min(block.w + lane % kBlockLanes, vertices * (spokes + 1u) - 1u);
    uint h = n / vertices, record = block.y + 2u * (n - h * vertices);
    uvec4 a = tableElement(record), arrangement = tableElement(a.z);
    uint target = base + tableElement(record + 1u).x + (level - 2u) * fan.y;
    source = kMakes == kMakesFirstLevel ? a.x : target - fan.y;
    if (kMakes == kMakesFirstLevel) centre = netPoint(0u);
    if (h == spokes) {
        vec2 weights = uintBitsToFloat(tableElement(block.x + 1u).xy);
        uvec4 step = tableElement(arrangement.z + level - 2u);
        pool[target] =
            vec4(centrePoint(fan.x, weights, uintBitsToFloat(step.x), uintBitsToFloat(step.y), step.z, step.w), 0.0);
        return;
    }
    float sharpness = 0.0;
    if (arrangement.y != kNoSharpness) sharpness = softened(uintBitsToFloat(tableWord(arrangement.y + h)), level - 2u);
    storeSector(target, h, sharpness);
}
