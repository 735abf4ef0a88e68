// Polygons, evaluation: surface vertices from the frames of cage vertices. One invocation per surface vertex and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS FragmentPush
#include "shaders/shared/subdivision.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/todays_pool.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/polygons/vector.glsl"
#include "shaders/shared/polygons.h"

// Two axes across a unit normal: Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017). The words of
// directions are made with the same (surface/polygons/scheme.cpp).
void axesAcross(vec3 n, out vec3 x, out vec3 y) {
    float s = n.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + n.z), b = n.x * n.y * a;
    x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    y = vec3(b, s + n.y * n.y * a, -n.y);
}

// -1 where the pose mirrors, else 1.
#ifdef WIDE
float sideOfFrame(uint frame) { return pool.at[frame].w; }
#else
float sideOfFrame(uint frame) { return texelFetch(poolTexels, int(frame)).w; }
#endif

void main() {
    uint item = itemOfLane(), index = elementOf(item), entry = entryOf(item), instance = slotOf(entry);
    uvec4 record = tableElement(push.table + index);
    uint frame = instance * header.poolStride + record.x, vertex = instance * push.verticesPerInstance + push.firstVertex + index;
    if (kVertexFormat == kVertexPosition) {
        // In a view, instances without a past come from today's frames.
        bool isNew = push.today != 0u && (entry & kInstanceIsNew) != 0u;
        vec3 position;
        setPast(isNew);
        if (isNew) position = todaysVector(frame);
        else position = poolVector(frame);
        storeSurfaceVertex(vertex, position, vec3(0.0));
        return;
    }
    vec3 coordinates = uintBitsToFloat(record.yzw);
    vec3 z = poolVector(frame + kFrameNormal), x = poolVector(frame + kFrameTangent), y = crossProduct(z, x);
    // Where the pose mirrors, the faces' normal is the mirror image's turned round, and x and y are images. The normal goes with the
    // faces, the tangent with the image.
    float side = sideOfFrame(frame);
    precise vec3 normal = ((side * coordinates.x) * x + (side * coordinates.y) * y) + coordinates.z * z;
    storeSurfaceVertex(vertex, poolVector(frame), normal);
    if (kTangents) {
        const mat3 axes = mat3(x, y, side * z);
        vec3 du, dv;
        axesAcross(coordinates, du, dv);
        tangents.at[vertex] = tangentWord(tableWord(header.directions + index), Frame(axes * du, axes * dv, normal));
    }
}
