// The vertices of the mesh that a scheme works on: of the cage or, with MESH_IN_POOL, of what steps of subdivision made of it. A
// kernel that reads the cage does not read the pool: two of them need no barrier. Needs tables.glsl.
#ifndef MESH_IN_POOL
#define POOL_WRITE_ONLY
#endif
#include "shaders/surface/pool.glsl"
#include "shaders/surface/cage.glsl"

#ifdef MESH_IN_POOL
vec3 meshPoint(uint i) { return poolVector(i); }
uint meshBase(uint instance) { return poolBase(instance); }
#else
vec3 meshPoint(uint i) { return cageVertex(i); }
uint meshBase(uint instance) { return instance * header.cageStride; }
#endif
