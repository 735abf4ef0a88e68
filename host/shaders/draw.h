// Read by C++ and by these shaders: bindings, the frame's uniforms, push constants.
#ifndef SUPPLE_HOST_DRAW_H
#define SUPPLE_HOST_DRAW_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define SUPPLE_HOST_CONST inline constexpr uint
#define SUPPLE_HOST_FLOAT inline constexpr float
#define SUPPLE_HOST_INLINE [[nodiscard]] constexpr
namespace supple::host::shared {
using uint = uint32_t;
using vec4 = glm::vec4;
using mat4 = glm::mat4;
#else
#define SUPPLE_HOST_CONST const uint
#define SUPPLE_HOST_FLOAT const float
#define SUPPLE_HOST_INLINE
#endif

// Set 0, the frame.
SUPPLE_HOST_CONST kFrameBinding = 0u;
SUPPLE_HOST_CONST kShadowBinding = 1u;
SUPPLE_HOST_CONST kEnvironmentBinding = 2u;
SUPPLE_HOST_CONST kShadowDepthBinding = 3u; // the image of kShadowBinding
SUPPLE_HOST_CONST kRayBinding = 4u;         // pictures that are traced: what rays meet
// Set 1, the figure: what Supple hands out, and two tables the host makes of the cage.
SUPPLE_HOST_CONST kSurfaceVertexBinding = 0u;
SUPPLE_HOST_CONST kSurfaceAttributeBinding = 1u;
SUPPLE_HOST_CONST kPatchBinding = 2u;
SUPPLE_HOST_CONST kDeformedCageBinding = 3u;
SUPPLE_HOST_CONST kCageCornerBinding = 4u;
SUPPLE_HOST_CONST kCageEdgeBinding = 5u;
SUPPLE_HOST_CONST kSurfaceUv1Binding = 6u;
SUPPLE_HOST_CONST kSurfaceFaceUvBinding = 7u;
SUPPLE_HOST_CONST kInstancesBinding = 8u;
SUPPLE_HOST_CONST kSurfaceTangentBinding = 9u;
SUPPLE_HOST_CONST kSurfaceValueBinding = 10u;
SUPPLE_HOST_CONST kLevelBucketBinding = 11u; // groups with levels
SUPPLE_HOST_CONST kLevelPatchBinding = 12u;
// Set 2, the material: its numbers, then a binding for each texture below kClearcoat, then one for all of its layers'.
SUPPLE_HOST_CONST kMaterialBinding = 0u;
SUPPLE_HOST_CONST kFirstTextureBinding = 1u;
SUPPLE_HOST_CONST kLayerTextureBinding = 7u;
SUPPLE_HOST_CONST kLayerTextureCount = 8u; // with six above and two of the frame 16, which Vulkan promises

// Set 1 of what sits on the figure (host/attachments.h).
SUPPLE_HOST_CONST kAttachmentFrameBinding = 0u; // SUPPLE_POINT_FRAME_48
SUPPLE_HOST_CONST kAttachmentVertexBinding = 1u;
SUPPLE_HOST_CONST kAttachmentInstanceBinding = 2u;
SUPPLE_HOST_CONST kDecalColorBinding = 3u;
SUPPLE_HOST_CONST kDecalNormalBinding = 4u;

// The textures of a material.
SUPPLE_HOST_CONST kBaseColor = 0u;
SUPPLE_HOST_CONST kMetallicRoughness = 1u;
SUPPLE_HOST_CONST kNormal = 2u;
SUPPLE_HOST_CONST kOcclusion = 3u;
SUPPLE_HOST_CONST kEmissive = 4u;
SUPPLE_HOST_CONST kTrim = 5u;
// Those of its layers (layers.glsl). Few materials have many of them, so they share kLayerTextureBinding.
SUPPLE_HOST_CONST kClearcoat = 6u;
SUPPLE_HOST_CONST kClearcoatRoughness = 7u;
SUPPLE_HOST_CONST kClearcoatNormal = 8u;
SUPPLE_HOST_CONST kSheenColor = 9u;
SUPPLE_HOST_CONST kSheenRoughness = 10u;
SUPPLE_HOST_CONST kTransmission = 11u;
SUPPLE_HOST_CONST kAnisotropy = 12u;
SUPPLE_HOST_CONST kDiffuseTransmissionColor = 13u;
SUPPLE_HOST_CONST kSpecular = 14u;
SUPPLE_HOST_CONST kSpecularColor = 15u;
SUPPLE_HOST_CONST kIridescence = 16u;
SUPPLE_HOST_CONST kIridescenceThickness = 17u;
SUPPLE_HOST_CONST kDiffuseTransmission = 18u;
SUPPLE_HOST_CONST kThickness = 19u;
SUPPLE_HOST_CONST kTextureCount = 20u;
// Where each of them is in the array of kLayerTextureBinding: four bits from kClearcoat on, in two words.
SUPPLE_HOST_CONST kLayerSlotsPerWord = 8u;
SUPPLE_HOST_CONST kNoLayerSlot = 8u; // it has none
SUPPLE_HOST_CONST kNoLayerSlots = 0x88888888u;
#define SUPPLE_LAYER_SLOT_SHIFT(texture) (4u * (((texture)-kClearcoat) % kLayerSlotsPerWord))
#define SUPPLE_LAYER_SLOT(word, texture) (((word) >> SUPPLE_LAYER_SLOT_SHIFT(texture)) & 15u)

// The map of the studio (host/environment.h).
SUPPLE_HOST_CONST kEnvironmentSize = 256u;
SUPPLE_HOST_CONST kEnvironmentLevels = 5u;

SUPPLE_HOST_CONST kMaxLights = 40u;

// What is painted on the surface.
SUPPLE_HOST_CONST kViewShaded = 0u;
SUPPLE_HOST_CONST kViewWire = 1u;
SUPPLE_HOST_CONST kViewPatches = 2u;
SUPPLE_HOST_CONST kViewNormals = 3u;
// Stripes: stripes.glsl.
SUPPLE_HOST_CONST kViewZebra = 4u;      // reflected tubes, which stay with the viewer
SUPPLE_HOST_CONST kViewHighlights = 5u; // lines of light, which stay with the figure
SUPPLE_HOST_CONST kViewIsophotes = 6u;  // angles from a direction, which stays with the figure
// Without the studio's light, from here on: flat_views.glsl.
SUPPLE_HOST_CONST kViewTangents = 7u;
SUPPLE_HOST_CONST kViewUv = 8u;
SUPPLE_HOST_CONST kViewUv1 = 9u; // the second texture coordinates
SUPPLE_HOST_CONST kViewVertexColor = 10u;
SUPPLE_HOST_CONST kViewBaseColor = 11u;
SUPPLE_HOST_CONST kViewMetallic = 12u;
SUPPLE_HOST_CONST kViewRoughness = 13u;
SUPPLE_HOST_CONST kViewNormalMap = 14u;
SUPPLE_HOST_CONST kViewOcclusion = 15u;
SUPPLE_HOST_CONST kViewEmissive = 16u;
// As colors of a scale, from 0 to 1; below 0 there is no value.
SUPPLE_HOST_CONST kViewWeights = 17u;  // values of the vertices (kSurfaceValueBinding)
SUPPLE_HOST_CONST kViewDistance = 18u; // the same
SUPPLE_HOST_CONST kViewLevels = 19u; // the largest level of the patch, or the rate, by its logarithm; kScaledLevel is 1
SUPPLE_HOST_FLOAT kScaledLevel = 16.0f;
// The same with a sign: 1/2 is zero. With contour lines.
SUPPLE_HOST_CONST kViewMeanCurvature = 20u; // values of the vertices
SUPPLE_HOST_CONST kViewGaussianCurvature = 21u;
SUPPLE_HOST_FLOAT kContours = 20.0f; // steps of the scale

SUPPLE_HOST_CONST kHighlightCount = 24u;    // lines of light, parallel to the x axis, all round the figure
SUPPLE_HOST_FLOAT kIsophoteDegrees = 15.0f; // of a bright and a dark band together
// The colors of a scale at 0, 1/4 .. 1, 0xRRGGBB, from dark blue over green to yellow; monotonic in brightness, so that
// gray prints tell as much (a short viridis).
#define SUPPLE_SCALE_COLORS 0x440154u, 0x3B528Bu, 0x21918Cu, 0x5EC962u, 0xFDE725u
// The same for values with a sign: blue, white, red.
#define SUPPLE_SIGNED_COLORS 0x2166ACu, 0x92C5DEu, 0xF7F7F7u, 0xF4A582u, 0xB2182Bu
// A color a class of patches, 0xRRGGBB, by SupplePatchClass: regular slate, perturbed violet, polar wine; P_3 yellow,
// P_4 vermilion, P_5 blue; fragments mauve, Loop cyan; blend light green, sharp sky blue; polygons sand; irregular
// amber, sharp red; creased purple; Loop, regular teal, irregular salmon, sharp electric violet; blend, regular taupe.
// Chosen so that classes of one scheme keep apart for eyes of every kind, those of different schemes as well as so many
// colors can: under simulated protanopia, deuteranopia and tritanopia the former are 0.12 and more apart in OKLab, the
// latter 0.05, with differences of lightness, which shading changes, counted half.
#define SUPPLE_CLASS_COLORS                                                                                            \
    0x8E9BA8u, 0x502080u, 0x802050u, 0xF0E442u, 0xD55E00u, 0x2020C8u, 0x985098u, 0x80E0E0u, 0xB0E098u, 0x5080E0u,      \
        0xC8B898u, 0xF0A848u, 0xC00018u, 0x7830A8u, 0x489890u, 0xF8B8A8u, 0x9030F0u, 0x907860u
SUPPLE_HOST_CONST kClassCount = 18u;

// DrawPush::domain: values of SuppleDomain.
SUPPLE_HOST_CONST kDrawQuad = 0u;
SUPPLE_HOST_CONST kDrawPolar = 1u;
SUPPLE_HOST_CONST kDrawTriangle = 2u;
SUPPLE_HOST_CONST kDrawPentagon = 3u;
SUPPLE_HOST_CONST kDrawMesh = 4u;
SUPPLE_HOST_CONST kDrawRings = 5u; // levels: SUPPLE_GRID_TRIANGLE_RINGS and the like

// DrawPush::flags
SUPPLE_HOST_CONST kDrawVertex24 = 1u;   // surface vertices of 24 bytes
SUPPLE_HOST_CONST kDrawAttributes = 2u; // the group has UV and color
SUPPLE_HOST_CONST kDrawCoverage = 4u;   // alpha becomes coverage of the pixel's samples
SUPPLE_HOST_CONST kDrawTangents = 8u;   // the surface has tangents
SUPPLE_HOST_CONST kDrawSolid = 16u;     // of a translucent material: only where it is solid
SUPPLE_HOST_CONST kDrawLevels = 32u;    // a SuppleLevelDraw
SUPPLE_HOST_CONST kDrawFrontSide =
    64u; // the shader leaves back faces out: poses may mirror, so winding does not tell them
SUPPLE_HOST_CONST kDrawBackSide = 128u;  // the shader leaves front faces out
SUPPLE_HOST_CONST kDrawBothSides = 256u; // nothing tells the sides apart: both are shown alike
SUPPLE_HOST_CONST kDrawMayMirror = 512u; // poses may mirror

// What a material has: a constant of its shaders.
SUPPLE_HOST_CONST kMaterialDoubleSided = 1u; // back faces are meant to be seen
SUPPLE_HOST_CONST kMaterialMask = 2u;        // cage: alpha below the cutoff is a hole
SUPPLE_HOST_CONST kMaterialTranslucent = 4u; // alpha is coverage
SUPPLE_HOST_CONST kMaterialUnlit = 8u;       // the base color is shown as it is
SUPPLE_HOST_CONST kMaterialTrim = 16u;       // surface: where the trim's texture is below the cutoff is a hole
SUPPLE_HOST_CONST kMaterialTrimFace = 32u;   // it is a strip of tiles, one a face
SUPPLE_HOST_CONST kMaterialTrimAlpha = 64u;  // base color and vertex alpha multiply it
SUPPLE_HOST_CONST kMaterialUvs1 = 128u;      // a texture lies on the second texture coordinates
SUPPLE_HOST_CONST kMaterialTexture = 256u;   // << kBaseColor and so on, below kClearcoat: that texture
SUPPLE_HOST_CONST kMaterialClearcoat = 1u << 22;
SUPPLE_HOST_CONST kMaterialSheen = 1u << 23;
SUPPLE_HOST_CONST kMaterialTransmission = 1u << 24;
SUPPLE_HOST_CONST kMaterialSpecular = 1u << 25; // MaterialUniforms::dielectric differs from what it usually is
SUPPLE_HOST_CONST kMaterialAnisotropy = 1u << 26;
SUPPLE_HOST_CONST kMaterialDiffuseTransmission = 1u << 27;
SUPPLE_HOST_CONST kMaterialIridescence = 1u << 28;

// A patch in kPatchBinding: its class, then the vertices of its face, which say whether the pose mirrors it:
// CageCorner::faceStart and faceSides.
SUPPLE_HOST_CONST kPatchWords = 3u;
// The patch that the vertex shader hands on: set where the pose mirrors it.
SUPPLE_HOST_CONST kPatchIsMirrored = 0x80000000u;

// Whether the pose mirrors a face, or a vertex: `sides` is the sum of w over its vertices in
// SuppleGroupInfo::deformedCage. So half of the vertices are enough. Pictures and bakes go by this.
SUPPLE_HOST_INLINE bool isMirrored(float sides) {
    return sides <= 0.0f;
}

// From here on a translucent material is solid.
SUPPLE_HOST_FLOAT kSolidAlpha = 0.99f;

// Which part of the rig a light belongs to; in Light::color.w.
SUPPLE_HOST_CONST kLightKey = 0u;
SUPPLE_HOST_CONST kLightRim = 1u;
SUPPLE_HOST_CONST kLightSky = 2u;

struct Light {
    vec4 direction; // towards the light; w: its cone, a tangent
    vec4 color;     // irradiance on a surface that faces it
    mat4 shadow;    // world to the light's shadow map
};

struct FrameUniforms {
    mat4 viewProjection;
    mat4 view;
    vec4 eye;          // w: light tubes of the zebra, from one pole to the other
    vec4 target;       // the middle of the scene; w: its radius
    vec4 ground;       // x: height, y: 1 where there is one
    vec4 viewport;     // width, height, 1 / width, 1 / height
    vec4 bounce;       // light from below
    vec4 keyDirection; // the middle of the key's directions, and all their light together
    vec4 keyColor;
    vec4 rimDirection;
    vec4 rimColor;
    vec4 environment; // sine and cosine of the yaw that it is turned by; radiance over irradiance of key and rim
    vec4 backdrop;    // w: 1 if it has this color all over
    vec4 openSky;     // irradiance from straight above, where no lights sample the sky; w: 1 if so
    uint lightCount;
    float exposure;
    float shadowTexel; // its width in the world
    float pixelScale;  // line widths are multiplied by it
    float softShadows; // how far shadow lookups are spread, in the map; 0: one lookup
    uint pass;         // of those that make the picture, from 1 on; 0: there is one only
    float shadowWorld; // half the width of a shadow map in the world
    float shadowDepth; // its depth
    Light lights[kMaxLights];
};

struct DrawPush {
    vec4 lineColor;
    uint firstPatch; // of the draw range; kDrawLevels: number of the draw
    uint patchCount; // of the draw range; kDrawLevels: sides of its patches
    uint domain;     // SuppleDomain, or kDrawRings
    uint rate;       // kDrawLevels: the capacity
    uint samplesPerPatch;
    uint firstVertex;         // of the draw range
    uint verticesPerInstance; // kDrawLevels: of a draw instance
    uint cageVerticesPerInstance;
    uint flags;
    uint light;     // whose shadow map is being drawn
    uint primitive; // first cage corner or edge of the draw; kDrawMesh: a cage vertex of its part
};

// Of a texture on texture coordinates (x, y): it is looked up at (dot(u.xyz, (x, y, 1)), dot(v.xyz, (x, y, 1))).
struct TexturePlace {
    vec4 u; // w: 1 if these are the second texture coordinates
    vec4 v;
};

struct MaterialUniforms {
    vec4 baseColor;
    vec4 emissive;   // with its strength
    vec4 sheen;      // w: its roughness
    vec4 dielectric; // what it mirrors if it is looked at straight, at most 1; w: a factor of all that it mirrors
    vec4 diffuseTransmission; // its color; w: its share of scattered light
    vec4 extinction;  // inside: what is left after a length x is exp(-x * extinction); w: thickness, 0: a thin wall
    vec4 anisotropy;  // x: its strength; y, z: cosine and sine of its rotation
    vec4 iridescence; // x: its factor; y: the film's index; z, w: its thickness in nanometres, least and most
    TexturePlace places[kTextureCount];
    float metallic;
    float roughness;
    float normalScale;
    float occlusionStrength;
    float cutoff; // the trim's, or the mask's
    float trimTiles;
    uint trimChannel;
    float clearcoat;
    float clearcoatRoughness;
    float clearcoatNormalScale;
    float transmission;
    float unused;
};

// A vertex of a prop: position and roughness, normal and how much it shines by itself, color and metallic. Of a decal,
// one per point: u, v, opacity, and how far it is moved towards the eye besides.
struct AttachmentVertex {
    vec4 a;
    vec4 b;
    vec4 c;
};

SUPPLE_HOST_CONST kNoLight = 0xFFFFFFFFu;
struct AttachmentPush {
    uint pointCount; // of the point set
    uint light;      // whose shadow map is being drawn, or kNoLight
    float scale;     // of a prop
    float lift;      // of a decal: how far it is moved towards the eye, if it faces it
    float roughness; // of a decal
};

// One corner of a triangle of a cage face; three in a row make the triangle.
struct CageCorner {
    uint vertex;    // cage vertex
    uint faceStart; // the face's vertices in the list behind the corners' buffer: see cage_buffers.glsl
    uint faceSides;
    uint color; // RGBA8
    float u0;   // the first texture coordinates, and the second
    float v0;
    float u1;
    float v1;
};

#ifdef __cplusplus
} // namespace supple::host::shared
#endif

#endif
