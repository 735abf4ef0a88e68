// What main.cpp and trace.comp both read.
#ifdef __cplusplus
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
namespace ray_query {
using glm::vec4;
using uint = uint32_t;
#define CONSTANT inline constexpr uint32_t
#else
#define CONSTANT const uint
#endif

CONSTANT kSceneBinding = 0u;
CONSTANT kVertexBinding = 1u;    // SUPPLE_VERTEX_16
CONSTANT kIndexBinding = 2u;     // SuppleRayGeometry.indexBuffer
CONSTANT kAttributeBinding = 3u; // SuppleVertexStreams.attributes
CONSTANT kGeometryBinding = 4u;
CONSTANT kPictureBinding = 5u;
CONSTANT kGroupSize = 8u; // pixels a side

// A range of SuppleRayGeometry: what a hit's geometry index leads to.
struct Geometry {
    vec4 color; // of its material, linear
    uint firstIndex, unused0, unused1, unused2;
};

struct Push {
    vec4 eye;   // w: the height of the floor
    vec4 right; // half of the picture's width at distance 1; w: how far rays start off a surface
    vec4 up;    // the same of its height
    vec4 ahead;
    uint width, height, samples, verticesPerInstance;
};

#ifdef __cplusplus
} // namespace ray_query
#endif
