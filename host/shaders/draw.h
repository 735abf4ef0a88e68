// Read by C++ and by these shaders: bindings, the frame's uniforms, push constants.
#ifndef SUPPLE_HOST_DRAW_H
#define SUPPLE_HOST_DRAW_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define SUPPLE_HOST_CONST inline constexpr uint
namespace supple::host::shared {
using uint = uint32_t;
using vec4 = glm::vec4;
using mat4 = glm::mat4;
#else
#define SUPPLE_HOST_CONST const uint
#endif

// Set 0, the frame.
SUPPLE_HOST_CONST kFrameBinding = 0u;
SUPPLE_HOST_CONST kShadowBinding = 1u;
// Set 1, the figure: what Supple hands out, and two tables the host makes of the cage.
SUPPLE_HOST_CONST kSurfaceVertexBinding = 0u;
SUPPLE_HOST_CONST kSurfaceAttributeBinding = 1u;
SUPPLE_HOST_CONST kPatchClassBinding = 2u;
SUPPLE_HOST_CONST kDeformedCageBinding = 3u;
SUPPLE_HOST_CONST kCageCornerBinding = 4u;
SUPPLE_HOST_CONST kCageEdgeBinding = 5u;
SUPPLE_HOST_CONST kSurfaceUv1Binding = 6u;
SUPPLE_HOST_CONST kSurfaceFaceUvBinding = 7u;
SUPPLE_HOST_CONST kInstancesBinding = 8u;
// Set 2, the material.
SUPPLE_HOST_CONST kMaterialBinding = 0u;
SUPPLE_HOST_CONST kBaseColorBinding = 1u;
SUPPLE_HOST_CONST kMetallicRoughnessBinding = 2u;
SUPPLE_HOST_CONST kTrimBinding = 3u;

SUPPLE_HOST_CONST kMaxLights = 40u;

// What is painted on the surface.
SUPPLE_HOST_CONST kViewShaded = 0u;
SUPPLE_HOST_CONST kViewWire = 1u;
SUPPLE_HOST_CONST kViewPatches = 2u;
SUPPLE_HOST_CONST kViewNormals = 3u;
SUPPLE_HOST_CONST kViewZebra = 4u;

// DrawPush::domain: values of SuppleDomain.
SUPPLE_HOST_CONST kDrawQuad = 0u;
SUPPLE_HOST_CONST kDrawPolar = 1u;
SUPPLE_HOST_CONST kDrawTriangle = 2u;
SUPPLE_HOST_CONST kDrawPentagon = 3u;
SUPPLE_HOST_CONST kDrawMesh = 4u;

// DrawPush::flags
SUPPLE_HOST_CONST kDrawVertex24 = 1u;   // surface vertices of 24 bytes
SUPPLE_HOST_CONST kDrawAttributes = 2u; // the group has UV and color
SUPPLE_HOST_CONST kDrawCoverage = 4u;   // alpha becomes coverage of the pixel's samples

// MaterialUniforms::flags
SUPPLE_HOST_CONST kMaterialDoubleSided = 1u;           // back faces are meant to be seen
SUPPLE_HOST_CONST kMaterialMask = 2u;                  // cage: alpha below the cutoff is a hole
SUPPLE_HOST_CONST kMaterialTranslucent = 4u;           // alpha is coverage
SUPPLE_HOST_CONST kMaterialUv1 = 8u;                   // the base color lies on the second UV set
SUPPLE_HOST_CONST kMaterialMetallicRoughness = 16u;    // there is such a texture
SUPPLE_HOST_CONST kMaterialMetallicRoughnessUv1 = 32u; // it lies on the second UV set
SUPPLE_HOST_CONST kMaterialTrim = 64u;       // surface: where the trim's texture is below the cutoff is a hole
SUPPLE_HOST_CONST kMaterialTrimUv1 = 128u;   // it lies on the second UV set
SUPPLE_HOST_CONST kMaterialTrimFace = 256u;  // it is a strip of tiles, one a face
SUPPLE_HOST_CONST kMaterialTrimAlpha = 512u; // base color and vertex alpha multiply it

// Which part of the rig a light belongs to; in Light::color.w.
SUPPLE_HOST_CONST kLightKey = 0u;
SUPPLE_HOST_CONST kLightRim = 1u;
SUPPLE_HOST_CONST kLightSky = 2u;

struct Light {
    vec4 direction; // towards the light
    vec4 color;     // irradiance on a surface that faces it
    mat4 shadow;    // world to the light's shadow map
};

struct FrameUniforms {
    mat4 viewProjection;
    mat4 view;
    vec4 eye;
    vec4 target;       // what the camera looks at; w: radius of the scene
    vec4 ground;       // x: height, y: 1 where there is one
    vec4 viewport;     // width, height, 1 / width, 1 / height
    vec4 bounce;       // light from below
    vec4 keyDirection; // the middle of the key's directions, and all their light together
    vec4 keyColor;
    vec4 rimDirection;
    vec4 rimColor;
    uint lightCount;
    float exposure;
    float shadowTexel; // its width in the world
    float pixelScale;  // line widths are multiplied by it
    float softShadows; // how far shadow lookups are spread, in the map; 0: one lookup
    float unused0;
    float unused1;
    float unused2;
    Light lights[kMaxLights];
};

struct DrawPush {
    vec4 lineColor;
    uint firstPatch;
    uint patchCount; // of the draw range
    uint domain;     // SuppleDomain
    uint rate;
    uint samplesPerPatch;
    uint firstVertex; // of the draw range
    uint verticesPerInstance;
    uint cageVerticesPerInstance;
    uint view;
    uint flags;
    uint light;     // whose shadow map is being drawn
    uint primitive; // first cage corner or edge of the draw
};

// Of a texture on texture coordinates (x, y): it is looked up at (dot(u.xyz, (x, y, 1)), dot(v.xyz, (x, y, 1))).
struct TexturePlace {
    vec4 u;
    vec4 v;
};

struct MaterialUniforms {
    vec4 baseColor;
    TexturePlace baseColorPlace;
    TexturePlace metallicRoughnessPlace;
    TexturePlace trimPlace;
    float metallic;
    float roughness;
    float cutoff; // the trim's, or the mask's
    float trimTiles;
    uint flags;
    uint trimChannel;
    uint unused0;
    uint unused1;
};

// One corner of a triangle of a cage face; three in a row make the triangle.
struct CageCorner {
    uint vertex;    // cage vertex
    uint faceStart; // the face's vertices in the list behind the corners' buffer: see cage_face.vert
    uint faceSides;
    uint color;       // RGBA8
    float baseColorU; // texture coordinates, before the material's transforms
    float baseColorV;
    float metallicRoughnessU;
    float metallicRoughnessV;
};

#ifdef __cplusplus
} // namespace supple::host::shared
#endif

#endif
