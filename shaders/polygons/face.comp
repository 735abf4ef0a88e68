// Polygons, vertex stage: twice the area vector of every face of the deformed cage. One invocation per face and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_WRITE_ONLY
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/surface/cage.glsl"
#include "shaders/polygons/vector.glsl"
#include "shaders/shared/polygons.h"

layout(constant_id = kKindConstant) const uint kFaces = kShortFaces;

// Relative to the first vertex, which keeps cancellation small far from the origin.
vec3 longFaceArea(uint first, uint count, uint cageBase) {
    vec3 origin = cageVertex(cageBase + tableWord(first));
    precise vec3 spoke = cageVertex(cageBase + tableWord(first + 1u)) - origin;
    precise vec3 area = vec3(0.0);
    for (uint k = 2u; k < count; ++k) {
        precise vec3 next = cageVertex(cageBase + tableWord(first + k)) - origin;
        area = area + crossProduct(spoke, next);
        spoke = next;
    }
    return area;
}

void main() {
    uint item = itemOfLane(), index = elementOf(item), instance = instanceOf(item);
    uint cageBase = instance * header.cageStride;
    uvec4 record = tableElement(push.table + index);
    uint face = kFaces == kLongFaces ? record.z : index;
    precise vec3 area;
    if (kFaces == kLongFaces) {
        area = longFaceArea(record.x, record.y, cageBase);
    } else {
        precise vec3 a = cageVertex(cageBase + record.y) - cageVertex(cageBase + record.x);
        precise vec3 b = cageVertex(cageBase + record.w) - cageVertex(cageBase + record.z);
        area = crossProduct(a, b);
    }
    storePool(instance * header.poolStride + face, area);
}
