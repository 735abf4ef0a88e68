// The vertices of the mesh that a scheme works on: of the cage or, with MESH_IN_POOL, of what steps of subdivision made of it. A
// kernel that reads the cage does not read the pool: two of them need no barrier. Needs tables.glsl.
#ifndef MESH_IN_POOL
#define POOL_WRITE_ONLY
#endif
#include "shaders/surface/pool.glsl"
#include "shaders/surface/cage.glsl"

#ifdef MESH_IN_POOL
vec3 meshPoint(uint i) { return poolVector(i); }
uint meshStride() { return header.poolStride; }
#else
vec3 meshPoint(uint i) { return cageVertex(i); }
uint meshStride() { return header.cageStride; }
#endif
vec3 vertexAt(uint instance, uint i) { return meshPoint(instance * meshStride() + i); }
