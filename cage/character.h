// The plain data of a character on the CPU: control cage, skeleton, skin, clips, materials. No Vulkan, no behaviour.
// Filled by the readers of this folder, read by every floor above. Units are the asset's; +Y up, right-handed, as glTF.
#pragma once

#include "cage/shared_bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace supple::cage {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;

/// Sharpness as OpenSubdiv, USD and Maya count it: 0 is smooth, kHardSharpness and more is infinitely sharp. (Blender's
/// crease c in 0..1 is 10 c^2.)
inline constexpr float kHardSharpness = 10.0f;

/// A crease along one edge of the cage.
struct Crease {
    uint32_t a = 0; ///< cage vertices, in either order
    uint32_t b = 0;
    float sharpness = 0.0f;
    uint32_t set = kNone; ///< index into Cage::creaseSets: each instance may give the edge another sharpness
};

/// A sharp vertex of the cage. Surfaces interpolate it where sharpness >= kHardSharpness; less is carried, not used.
struct SharpVertex {
    uint32_t vertex = 0;
    float sharpness = 0.0f;
};

/// P_m's own crease control: alpha of the edge vertex -> toward at `vertex`, in [0, 1]; 2/3 is smooth. Overrides what
/// follows from sharpness at that end of the edge.
struct CreaseScalar {
    uint32_t vertex = 0;
    uint32_t toward = 0;
    float alpha = 0.0f;
};

/// A primitive of a glTF file, and where its triangles begin in Cage::sourceTriangles. A mesh that several nodes carry
/// comes once for each part.
struct SourcePrimitive {
    uint32_t mesh = 0;
    uint32_t primitive = 0;
    uint32_t firstTriangle = 0;

    bool operator==(const SourcePrimitive&) const = default;
};

/// A control cage: oriented polygons (counter-clockwise seen from outside) over welded cage vertices.
/// Attributes stay per corner, so that UV and color seams survive welding.
struct Cage {
    std::vector<glm::vec3> positions; ///< one per cage vertex: the rest position
    std::vector<uint32_t> faceStarts; ///< faceCount + 1 entries; corners of face f are [faceStarts[f], faceStarts[f+1])
    std::vector<uint32_t> faceVertices;  ///< one per corner: cage vertex
    std::vector<glm::vec2> cornerUvs;    ///< one per corner, or empty (TEXCOORD_0)
    std::vector<glm::vec2> cornerUvs1;   ///< one per corner, or empty (TEXCOORD_1)
    std::vector<glm::vec4> cornerColors; ///< one per corner, or empty (COLOR_0, linear RGBA)
    /// One per corner, or empty: unit normals as the file has them (NORMAL, vn). A corner whose normal is zero has
    /// none: it is flat, as its face. Subdivision surfaces have normals of their own and ignore these.
    std::vector<glm::vec3> cornerNormals;
    /// One per corner, or empty: tangent and sign as a glTF file has them (TANGENT). Zero: the corner has none.
    std::vector<glm::vec4> cornerTangents;
    /// How the file cuts faces into triangles: three corners per triangle, sides - 2 triangles per face, face after
    /// face. Empty if the file does not say: triangulate() (cage/triangulation.h) then cuts them.
    std::vector<uint32_t> faceTriangles;
    std::vector<uint32_t> faceMaterials; ///< one per face: index into Character::materials or kNone; or empty
    std::vector<uint32_t> faceParts;     ///< one per face: index into Character::parts; or empty, if there is one part
    std::vector<uint32_t> faceTrimTiles; ///< one per face: tile of its material's trim (Trim) or kNone; or empty
    /// One per corner, or empty: where it lies in its face's tile, in the form of tileCoordinates() (cage/trim.h). Not
    /// read from files: laid when a surface is built, which carries it as it does UVs.
    std::vector<glm::vec2> cornerFaceUvs;
    std::vector<uint32_t> sourceVertices; ///< one per cage vertex: first POSITION element it came from (weld order)
    /// glTF files: the triangles of the file, three corners of one face each, or kNone three times where no face has
    /// them. Else empty, also in cooked files.
    std::vector<uint32_t> sourceTriangles;
    std::vector<SourcePrimitive> sourcePrimitives; ///< in the order of their triangles
    std::vector<Crease> creases;                   ///< at most one an edge
    std::vector<std::string> creaseSets;           ///< names, each once; kMaxCreaseSets (limits.h) at most
    std::vector<SharpVertex> sharpVertices;
    std::vector<CreaseScalar> creaseScalars;
    /// Vertices that round the border off if they have one face. Elsewhere such a vertex is a corner.
    /// (SUPPLE_mesh_cage: interpolateBoundary edgeOnly.) Catmull-Clark and Loop follow it.
    std::vector<uint32_t> roundCorners;
    std::vector<uint32_t> holes; ///< rising: faces that shape their neighbors but are not drawn

    [[nodiscard]] uint32_t vertexCount() const { return static_cast<uint32_t>(positions.size()); }
    [[nodiscard]] uint32_t faceCount() const {
        return faceStarts.empty() ? 0u : static_cast<uint32_t>(faceStarts.size() - 1);
    }
    [[nodiscard]] uint32_t cornerCount() const { return static_cast<uint32_t>(faceVertices.size()); }
    [[nodiscard]] uint32_t sides(uint32_t face) const { return faceStarts[face + 1] - faceStarts[face]; }
    /// The face that has the corner, found by bisection; faceCount() if there is no such corner.
    [[nodiscard]] uint32_t faceOf(uint32_t corner) const;
};

/// A scene node. Either TRS or (hasMatrix) a fixed matrix; animated nodes are always TRS.
struct Node {
    std::string name;
    uint32_t parent = kNone;
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};
    bool hasMatrix = false;
    glm::mat4 matrix{1.0f};
};

/// The node hierarchy of the asset, in glTF's node order, with an order in which parents stand before children.
struct Skeleton {
    std::vector<Node> nodes;
    std::vector<uint32_t> parentsFirst; ///< permutation of the nodes; acyclic by the reader's check
};

/// Joint palette layout: joint j of the palette is node joints[j]; its matrix is global(node) * inverseBinds[j]. The
/// skins of all parts share it: a node that is bound with several matrices is several joints. A mesh without a skin is
/// bound to its own node, with the identity as inverse bind matrix.
struct Skin {
    std::vector<uint32_t> joints;
    std::vector<glm::mat4> inverseBinds; ///< same length as joints; identity where the file had none
};

struct Influence {
    uint32_t joint = 0; ///< index into Skin::joints
    float weight = 0.0f;
};

/// Which of a character's jiggles or cloths is painted on a vertex, and how much of it.
struct PaintedWeight {
    uint32_t index = kNone; ///< kNone: none is
    float weight = 0.0f;    ///< above 0 to 1, if one is

    bool operator==(const PaintedWeight&) const = default;
};

/// Skin weights, packed by start index: influences of cage vertex v are [starts[v], starts[v+1]), weights sum to 1,
/// zero weights dropped, at least one influence a vertex.
struct SkinWeights {
    std::vector<uint32_t> starts; ///< vertexCount + 1 entries
    std::vector<Influence> influences;
    // One per cage vertex; or empty: none is painted. A vertex that has both is cloth.
    std::vector<PaintedWeight> jiggles; ///< of Character::jiggles
    std::vector<PaintedWeight> cloths;  ///< of Character::cloths; the weight is what part of its mobility it has
    std::vector<float> mushMask;        ///< how much delta mush smooths each cage vertex, 0 to 1; or empty: wholly
};

enum class Interpolation { step, linear, cubicSpline };
enum class ChannelPath { translation, rotation, scale, weights };

/// One animated property of one node. values holds, per key, one value (step, linear) or in-tangent, value, out-tangent
/// (cubicSpline); a value is 3 floats, 4 (x, y, z, w) for rotations, one a morph target for weights. Those are of the
/// part that the node carries; channels of other nodes' weights are left out.
struct Channel {
    uint32_t node = 0;
    ChannelPath path = ChannelPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times; ///< seconds, strictly increasing, at least one
    std::vector<float> values;
    uint32_t firstTarget = 0; ///< weights: of the targets that a value has a number for

    /// Numbers of one value.
    [[nodiscard]] size_t width() const {
        return values.size() / (times.size() * (interpolation == Interpolation::cubicSpline ? 3 : 1));
    }
};

/// A named time of a clip.
struct Marker {
    std::string name;
    double time = 0.0; ///< seconds, 0..Clip::duration
};

/// What sharpness a clip gives to a crease set, by name. Of `keys` the node, the path and the targets do not count.
struct SharpnessCurve {
    std::string set;
    Channel keys; ///< one number per value
};

/// A clip in a few bits, as the pose pass reads it (skinning/packed_clip.h).
struct PackedChannels {
    std::vector<uint32_t> words; ///< none: the clip is not packed
    uint32_t channelCount = 0;   ///< the first so many channels of the clip are what the words say
    double error = 0.0;          ///< how far this moves a vertex at most, as a part of the extent
    uint64_t unpackedBytes = 0;  ///< what the clip took in the clip table before
    /// The coarse twin, if the clip has one: the same frames in fewer bits. It plays while segments of the clip are
    /// missing on the device.
    std::vector<uint32_t> coarseWords;
    double coarseError = 0.0; ///< as `error`
};

struct Clip {
    std::string name;
    double duration = 0.0; ///< seconds: the last key of any channel; the clip starts at 0
    std::vector<Channel> channels;
    std::vector<Marker> markers;           ///< by rising time
    std::vector<SharpnessCurve> sharpness; ///< one per set
    PackedChannels packed;
};

/// Displacements of cage vertices, added with a weight before skinning. Only vertices that move are listed.
struct MorphTarget {
    std::string name;               ///< targetNames in the extras of the mesh, else of a primitive; or empty
    std::vector<uint32_t> vertices; ///< rising cage vertices
    std::vector<glm::vec3> deltas;  ///< one per entry of `vertices`
};

struct Morphs {
    std::vector<MorphTarget> targets;
    std::vector<float> weights; ///< one a target: node.weights, else mesh.weights, else 0
};

/// What an expression does, for those that hold others back. VRM 1.0 tells by the preset.
enum class ExpressionKind : uint8_t { other, blink, look, mouth };
inline constexpr size_t kExpressionKinds = 4;
/// Whether an expression holds back those of a kind: not at all, by its own weight, or wholly.
enum class ExpressionHold : uint8_t { none, blend, block };

/// A named set of weights of morph targets: "happy", "blink".
struct Expression {
    std::string name; ///< never empty, and unlike all others
    ExpressionKind kind = ExpressionKind::other;
    bool isBinary = false;                                ///< a weight above 0.5 counts as 1, any other as 0
    std::vector<uint32_t> targets;                        ///< rising: Morphs::targets
    std::vector<float> weights;                           ///< one per target, where the expression's own weight is 1
    std::array<ExpressionHold, kExpressionKinds> holds{}; ///< by kind
};

/// What of a node's rotation from its rest pose a driver looks at: rotation = swing * twist, the twist about an axis of
/// the node's own.
enum class TurnPart : uint8_t { rotation, swing, twist };
[[nodiscard]] const char* turnPartName(TurnPart part);

struct DriverInput {
    uint32_t node = 0;
    TurnPart part = TurnPart::rotation;
    glm::vec3 axis{0.0f, 1.0f, 0.0f}; ///< of swing and twist
    float weight = 1.0f;              ///< of squared distances between poses

    bool operator==(const DriverInput&) const = default;
};
/// Weights of morph targets that follow from how joints are turned (SUPPLE_deformers, docs/pose_drivers.md). The rest
/// pose, in which all are 0, is one of its poses without being listed.
struct PoseDriver {
    std::string name;
    std::vector<DriverInput> inputs;
    std::vector<uint32_t> targets; ///< Morphs::targets, all of one part
    std::vector<glm::vec4> poses;  ///< rotations from the rest pose (x, y, z, w), pose after pose, one per input
    std::vector<float> values;     ///< weights, pose after pose, one per target
    float width = 2.0f;            ///< sigma^2 by the mean, over poses, of the squared distance to the nearest other
    float low = 0.0f, high = 1.0f; ///< of what it sets

    [[nodiscard]] size_t poseCount() const { return poses.size() / inputs.size(); }
    bool operator==(const PoseDriver&) const = default;
};

/// How painted vertices jiggle about where joints have them (SUPPLE_deformers, docs/soft.md).
struct Jiggle {
    float frequency = 4.0f; ///< of the undamped spring, in Hz
    float damping = 0.2f;   ///< of the critical one
    float limit = 0.05f;    ///< the farthest that a vertex of weight 1 gets, in model space

    bool operator==(const Jiggle&) const = default;
};

/// A cape, a skirt, a soft ball: painted vertices hang on the others, and hold their distances to each other
/// (SUPPLE_deformers, docs/cloth.md). A compliance is by how much a constraint gives: 0 is rigid.
struct Cloth {
    float stretch = 1e-7f;           ///< compliance of edges
    float shear = 1e-7f;             ///< of diagonals
    float bend = 1e-3f;              ///< of vertices two apart
    bool volume = false;             ///< what it encloses is kept
    float tether = 1.02f;            ///< the farthest from where it hangs, by the way over edges; 0: any
    float drag = 0.1f;               ///< of its speed in the model, lost in 1/60 s
    float air = 0.05f;               ///< of its speed through the air, lost in 1/60 s
    float gravity = 9.81f;           ///< units of model space a second squared
    float hitRadius = 0.01f;         ///< against colliders, in units of model space
    uint32_t substeps = 4;           ///< of a step of 1/60 s
    std::vector<uint32_t> colliders; ///< SpringBones::colliders

    bool operator==(const Cloth&) const = default;
};

/// A joint that swings. Without numbers of its own it has VRM's.
struct SpringJoint {
    uint32_t node = 0;
    float hitRadius = 0.0f; ///< against colliders
    float stiffness = 1.0f;
    float gravityPower = 0.0f;
    float drag = 0.5f;
    glm::vec3 gravityDirection{0.0f, -1.0f, 0.0f};
};
enum class ColliderShape : uint8_t { sphere, capsule, plane };
struct SpringCollider {
    uint32_t node = 0;
    ColliderShape shape = ColliderShape::sphere;
    bool inside = false;    ///< tails stay in it, not out of it; not of a plane
    glm::vec3 offset{0.0f}; ///< in the node's space: a sphere's center, one of a capsule's two, a point of a plane
    glm::vec3 tail{0.0f};   ///< a capsule's other one; of a plane its normal, to the side where tails stay
    float radius = 0.0f;
};
/// Hair, a skirt, an ear: joints with those above before those below. No node is in two springs.
struct Spring {
    std::string name;
    uint32_t center = kNone; ///< the node in whose space it moves, or kNone: the world
    /// VRM 0.x: every joint moves, its tail is its first child, and of a leaf 7 cm beyond. VRM 1.0: its tail is the
    /// next joint, and the last joint is a tail alone.
    bool isTree = false;
    std::vector<SpringJoint> joints;
    std::vector<uint32_t> colliderGroups;

    /// How many of its joints may swing: the first ones.
    [[nodiscard]] size_t swingingCount() const { return isTree || joints.empty() ? joints.size() : joints.size() - 1; }
};
/// The spring bones of a file. Groups with SUPPLE_GROUP_SPRINGS move by them.
struct SpringBones {
    std::vector<Spring> springs;
    std::vector<std::vector<uint32_t>> colliderGroups; ///< of colliders
    std::vector<SpringCollider> colliders;
};

/// Encoded image bytes as the file holds them; decoding is the host's.
struct Image {
    std::string name;
    std::string mimeType; ///< "image/png", "image/jpeg", "image/webp", "image/ktx2", what else the file says, or empty
    SharedBytes bytes;
};

enum class AlphaMode { opaque, mask, blend };
enum class Wrap { repeat, clampToEdge, mirroredRepeat };
/// As glTF has them. `any`: the file leaves it to the host.
enum class Filter {
    any,
    nearest,
    linear,
    nearestMipmapNearest,
    linearMipmapNearest,
    nearestMipmapLinear,
    linearMipmapLinear
};

/// A texture as a material uses it: an image, how it is sampled, and where it lies.
struct Texture {
    uint32_t image = kNone;          ///< index into Character::images; kNone: no texture
    uint32_t alternateImage = kNone; ///< the same picture as KTX2 or WebP, where `image` is in a core format
    uint32_t uvSet = 0;              ///< 0: cornerUvs, 1: cornerUvs1
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    Filter magFilter = Filter::any; ///< any, nearest or linear
    Filter minFilter = Filter::any;
    // KHR_texture_transform: with c and s the cosine and sine of the rotation, (u, v) is looked up at
    // offset + (c * scale.x * u + s * scale.y * v, -s * scale.x * u + c * scale.y * v).
    glm::vec2 offset{0.0f};
    float rotation = 0.0f; ///< radians
    glm::vec2 scale{1.0f};

    [[nodiscard]] bool exists() const { return image != kNone; }
    bool operator==(const Texture&) const = default;
};

/// What the coordinates are that a trim's image is looked up at.
enum class TrimDomain {
    uv,  ///< a UV set of the cage
    face ///< a tile of the image a face (Cage::faceTrimTiles), which covers the whole face
};

/// Takes parts of the surface away: where a channel of an image is below the cutoff (docs/trimming.md).
struct Trim {
    TrimDomain domain = TrimDomain::uv;
    Texture texture;      ///< domain face: its UV set and its transform are not used
    uint32_t channel = 0; ///< 0..3: red, green, blue, alpha
    float cutoff = 0.5f;
    uint32_t tiles = 0; ///< domain face: equal tiles of the image, side by side

    bool operator==(const Trim&) const = default;
};

/// What glTF's extensions add to a material; what is not said is as if there were no such extension. Factors multiply
/// their textures (cage/material_layers.h lists all of these).
struct MaterialLayers {
    // KHR_materials_clearcoat: a clear layer over all.
    float clearcoatFactor = 0.0f;
    Texture clearcoatTexture; ///< red
    float clearcoatRoughnessFactor = 0.0f;
    Texture clearcoatRoughnessTexture; ///< green
    Texture clearcoatNormalTexture;    ///< tangent space, +Y up
    float clearcoatNormalScale = 1.0f;
    // KHR_materials_sheen: fibers, as of velvet.
    glm::vec3 sheenColorFactor{0.0f};
    Texture sheenColorTexture; ///< sRGB
    float sheenRoughnessFactor = 0.0f;
    Texture sheenRoughnessTexture; ///< alpha
    // KHR_materials_transmission: light goes through, as through thin glass.
    float transmissionFactor = 0.0f;
    Texture transmissionTexture; ///< red
    // KHR_materials_ior. 0: infinite.
    float ior = 1.5f;
    // KHR_materials_specular: what a dielectric mirrors.
    float specularFactor = 1.0f;
    Texture specularTexture; ///< alpha
    glm::vec3 specularColorFactor{1.0f};
    Texture specularColorTexture; ///< sRGB
    // KHR_materials_iridescence: a thin film. Thickness in nanometres: of black texels, and of white ones.
    float iridescenceFactor = 0.0f;
    Texture iridescenceTexture; ///< red
    float iridescenceIor = 1.3f;
    float iridescenceThicknessMinimum = 100.0f;
    float iridescenceThicknessMaximum = 400.0f;
    Texture iridescenceThicknessTexture; ///< green
    // KHR_materials_anisotropy: brushed metal.
    float anisotropyStrength = 0.0f;
    float anisotropyRotation = 0.0f; ///< radians, counter-clockwise from the tangent
    Texture anisotropyTexture;       ///< red and green: direction, blue: strength
    // KHR_materials_diffuse_transmission: light comes through and is scattered, as by leaves, wax and skin.
    float diffuseTransmissionFactor = 0.0f;
    Texture diffuseTransmissionTexture; ///< alpha
    glm::vec3 diffuseTransmissionColorFactor{1.0f};
    Texture diffuseTransmissionColorTexture; ///< sRGB
    // KHR_materials_volume: what light loses inside.
    float thicknessFactor = 0.0f;     ///< in units of the mesh; 0: a thin wall
    Texture thicknessTexture;         ///< green
    float attenuationDistance = 0.0f; ///< after so far, white light has the color below. 0: it loses nothing
    glm::vec3 attenuationColor{1.0f};

    bool operator==(const MaterialLayers&) const = default;
};

/// The core material of glTF 2.0, and what extensions add to it; what is not said is glTF's default. Factors are linear
/// and multiply their textures.
struct Material {
    std::string name;
    glm::vec4 baseColorFactor{1.0f};
    Texture baseColorTexture; ///< sRGB; alpha linear
    float metallicFactor = 1.0f;
    float roughnessFactor = 1.0f;
    Texture metallicRoughnessTexture; ///< green: roughness, blue: metallic
    Texture normalTexture;            ///< tangent space, +Y up
    float normalScale = 1.0f;
    Texture occlusionTexture; ///< red
    float occlusionStrength = 1.0f;
    Texture emissiveTexture; ///< sRGB
    glm::vec3 emissiveFactor{0.0f};
    float emissiveStrength = 1.0f; ///< KHR_materials_emissive_strength: multiplies the factor
    bool unlit = false;            ///< KHR_materials_unlit: the base color alone is shown
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    MaterialLayers layers;
    std::optional<Trim> trim; ///< takes the place of alphaMode mask: see trimOf() (cage/trim.h)
};

/// Where the polygons came from. A reader takes the first of these that a file has (docs/gltf.md).
enum class PolygonSource {
    cageExtension,   ///< SUPPLE_mesh_cage
    meshPolygon,     ///< EXT_mesh_polygon
    ngonEncoding,    ///< FB_ngon_encoding
    hiddenEdges,     ///< EXT_mesh_primitive_edge_visibility
    pairedTriangles, ///< GltfOptions::pairing
    triangles,
    obj,
    arrays ///< the host's
};
[[nodiscard]] const char* polygonSourceName(PolygonSource source);

/// What said which of a file's vertices are one cage vertex.
enum class WeldSource {
    cageExtension,   ///< SUPPLE_mesh_cage: cageVertices
    vertexAttribute, ///< _CAGE_VERTEX
    meshManifold,    ///< EXT_mesh_manifold
    equality,        ///< equal position, skin and morph deltas
    given            ///< nothing to weld: OBJ, the host's arrays
};
[[nodiscard]] const char* weldSourceName(WeldSource source);

/// How texture coordinates are interpolated over a cage: which vertices on seams and borders keep their values. The
/// names are OpenSubdiv's and USD's (docs/smooth_uvs.md).
enum class UvMode : uint8_t { none, cornersOnly, cornersPlus1, cornersPlus2, boundaries, all };
[[nodiscard]] const char* uvModeName(UvMode mode);

/// How several joints move one vertex. The names are those of the extension SUPPLE_deformers (docs/skinning.md).
enum class SkinningMode : uint8_t { linear, dualQuaternion, centersOfRotation, deltaMush, deltaMushLight };
[[nodiscard]] const char* skinningModeName(SkinningMode mode);

/// How delta mush smooths weights: (1 + lambda times the cage's Laplacian)^-iterations (SUPPLE_deformers,
/// docs/skinning.md).
struct Smoothing {
    float lambda = 1.0f;
    uint32_t iterations = 4;

    bool operator==(const Smoothing&) const = default;
};

/// The subdivision surface that a cage was made for: `scheme` of SUPPLE_mesh_cage. `none`: it is drawn as it is.
enum class MadeFor : uint8_t { catmullClark, loop, bilinear, none };
[[nodiscard]] const char* madeForName(MadeFor scheme);

/// A mesh node of the scene. Its faces are those of the cage from firstFace to the next part's.
struct Part {
    std::string name;             ///< the node's, else the mesh's, else empty
    uint32_t node = 0;            ///< index into Skeleton::nodes: carries the mesh
    bool rigid = false;           ///< all its vertices follow one joint
    std::vector<uint32_t> joints; ///< of its skin, in the skin's order: places in the palette. Empty: the whole palette
    uint32_t firstFace = 0;       ///< of the cage
    uint32_t firstTarget = 0;     ///< its morph targets are Morphs::targets[firstTarget + i]; parts may share them
    uint32_t targetCount = 0;
    PolygonSource polygonSource = PolygonSource::arrays;
    WeldSource weldSource = WeldSource::given;
    std::optional<UvMode> uvMode;         ///< what the file says (SUPPLE_mesh_cage: faceVaryingLinearInterpolation)
    std::optional<MadeFor> madeFor;       ///< what the file says (SUPPLE_mesh_cage: scheme)
    std::optional<SkinningMode> skinning; ///< what the file says (SUPPLE_deformers: skinning)
    std::optional<Smoothing> smoothing;   ///< what the file says (SUPPLE_deformers: smoothing)
};

/// One kind of damage of a cage that its reader has repaired.
struct Damage {
    std::string found;  ///< "mesh 0: 2 edges have three or more faces, the first is edge (3, 4)"
    std::string repair; ///< what was done: "cut into sheets"
};

struct Character {
    std::string name;      ///< file name or the host's name for it; begins every message about it
    std::string copyright; ///< as the file states it
    Cage cage;
    std::vector<Part> parts{1}; ///< one or more, in the order of the cage's faces
    Skeleton skeleton;
    Skin skin;
    SkinWeights weights;
    Morphs morphs;
    std::vector<Expression> expressions;
    std::vector<PoseDriver> drivers;
    std::vector<Jiggle> jiggles; ///< that weights.jiggles name
    std::vector<Cloth> cloths;   ///< that weights.cloths name
    SpringBones springBones;
    std::vector<Clip> clips;
    /// What moves the character in its clips as they were before they were packed (skinning::findRoot); kNone: ask.
    uint32_t clipRoot = kNone;
    std::vector<Material> materials;
    std::vector<std::string> materialVariants; ///< names of KHR_materials_variants; one may have been chosen
    std::vector<Image> images;
    std::vector<std::string> warnings; ///< what was repaired or ignored, one line each
    std::vector<Damage> damages;       ///< what a strict reader refuses; it is among the warnings too
    uint32_t sourceVertexCount = 0;    ///< vertices before welding
    uint32_t seamVertexCount = 0;      ///< vertices that welding merged away, between parts too
};

/// The face behind a part's last one.
[[nodiscard]] uint32_t endFace(const Character& character, size_t part);

} // namespace supple::cage
