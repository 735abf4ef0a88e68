// Polygons, assemble stage: the frames of the cage's vertices. One invocation per frame and instance. The position is stored as
// it is, to the bit. Behind it stands the vertex's side (shaders/deform/deform.comp).
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/surface/cage.glsl"
#include "shaders/polygons/vector.glsl"
#include "shaders/shared/polygons.h"

void main() {
    uint item = itemOfLane(), index = elementOf(item), instance = instanceOf(item);
    uint base = instance * header.poolStride, cageBase = instance * header.cageStride;
    uvec4 record = tableElement(push.table + index);
    vec4 vertex = cage(cageBase + record.x);
    vec3 position = vertex.xyz;
    precise vec3 area = vec3(0.0);
    for (uint k = 0u; k < record.w; ++k) area = area + poolVector(base + tableWord(record.z + k));
    vec3 normal = directionOf(area);
    precise vec3 edge = cageVertex(cageBase + record.y) - position;
    precise vec3 along = directionOf(edge);
    precise vec3 across = along - dotProduct(along, normal) * normal;
    vec3 tangent = directionOf(across);
    if (record.w == 0u) {
        normal = vec3(0.0, 0.0, 1.0);
        tangent = vec3(1.0, 0.0, 0.0);
    }
    uint frame = base + header.frames + kFrameElements * index;
    pool.at[frame] = vec4(position, vertex.w < 0.0 ? -1.0 : 1.0);
    storePool(frame + kFrameNormal, normal);
    storePool(frame + kFrameTangent, tangent);
}
