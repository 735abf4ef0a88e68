// Limit points, normals and chains of vertices that are not plain (docs/exact.md). One invocation a vertex or a point of a
// chain's level, and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/shared/exact.h"
#include "shaders/shared/subdivision.h"

layout(constant_id = kKindConstant) const uint kReads = kReadsNet;

uint base;   // of the instance in the pool
uint source; // what the rules read: the first word of the net, or the pool index of the level before
vec3 centre; // of level 1

vec3 netPoint(uint i) { return poolVector(base + tableWord(source + i)); }
vec3 point(uint i) {
    if (kReads == kReadsLevel) return poolVector(source + i);
    precise vec3 offset = netPoint(i) - centre;
    return offset;
}
#include "shaders/subdivision/rules.glsl"

// Weights act on the differences to the centre. The position is the same in all runs.
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

float sharpnessOf(uint words, uint spoke, uint level) {
    if (spoke == 0u || words == kNoSharpness) return 0.0;
    return softened(uintBitsToFloat(tableWord(words + spoke - 1u)), level);
}

vec3 chainPoint(uint i, uvec4 fan, uint words, uvec4 centreStep, vec2 weights, uint level) {
    uvec4 packed = tableElement(fan.z + i);
    uint rule = packed.w >> 16 & 3u;
    float sharpness = sharpnessOf(words, packed.w >> 18, level);
    Sources s = unpackSources(packed);
    if (rule == kCentreRule)
        return centrePoint(fan.x, weights, uintBitsToFloat(centreStep.x), uintBitsToFloat(centreStep.y), centreStep.z,
                           centreStep.w);
    if (rule == kFaceRule) return facePoint(point(s.s[0]), point(s.s[1]), point(s.s[2]), point(s.s[3]));
    if (rule == kEdgeRule)
        return edgePoint(point(s.s[0]), point(s.s[1]), point(s.s[2]), point(s.s[3]), point(s.s[4]), point(s.s[5]), sharpness);
    return vertexPoint(point(s.s[0]), pointsOf(unpackSources(tableElement(fan.w + s.s[0]))), sharpness);
}

void main() {
    uint item = itemOfLane(), lane = elementOf(item);
    base = instanceOf(item) * push.poolStride;
    uvec4 block = tableElement(push.table + lane / kBlockLanes);
    uint vertices = block.z & ((1u << kChainLevelShift) - 1u), level = block.z >> kChainLevelShift;
    uint n = block.w + lane % kBlockLanes;
    if (kReads == kReadsNet && block.x == 0u) {
        uint record = block.y + 2u * min(n, vertices - 1u);
        uvec4 a = tableElement(record), b = tableElement(record + 1u);
        source = a.x;
        centre = netPoint(0u);
        storeLimits(a.z, base + a.w, base + b.z);
        if (b.x != 0u) pool[base + b.x - 1u] = vec4(centre, 0.0);
        return;
    }
    uvec4 fan = tableElement(block.x);
    n = min(n, vertices * fan.y - 1u);
    uint i = n / vertices, record = block.y + 2u * (n - i * vertices);
    uvec4 a = tableElement(record), arrangement = tableElement(a.z);
    uint target = base + tableElement(record + 1u).x + (level - 2u) * fan.y;
    source = kReads == kReadsNet ? a.x : target - fan.y;
    if (kReads == kReadsNet) centre = netPoint(0u);
    vec2 weights = uintBitsToFloat(tableElement(block.x + 1u).xy);
    pool[target + i] =
        vec4(chainPoint(i, fan, arrangement.y, tableElement(arrangement.z + level - 2u), weights, level - 2u), 0.0);
}
