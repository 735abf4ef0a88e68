// The plain data of a character on the CPU: control cage, skeleton, skin, clips, materials. No Vulkan, no behaviour.
// Filled by the readers of this folder, read by every floor above. Units are the asset's; +Y up, right-handed, as glTF.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace supple::cage {

inline constexpr uint32_t kNone = 0xFFFFFFFFu;

/// A control cage: oriented polygons (counter-clockwise seen from outside) over welded cage vertices.
/// Attributes stay per corner, so that UV and colour seams survive welding.
struct Cage {
    std::vector<glm::vec3> positions; ///< one per cage vertex: the rest position
    std::vector<uint32_t> faceStarts; ///< faceCount + 1 entries; corners of face f are [faceStarts[f], faceStarts[f+1])
    std::vector<uint32_t> faceVertices;   ///< one per corner: cage vertex
    std::vector<glm::vec2> cornerUvs;     ///< one per corner, or empty (TEXCOORD_0)
    std::vector<glm::vec4> cornerColors;  ///< one per corner, or empty (COLOR_0, linear RGBA)
    std::vector<uint32_t> faceMaterials;  ///< one per face: index into Character::materials or kNone; or empty
    std::vector<uint32_t> sourceVertices; ///< one per cage vertex: first POSITION element it came from (weld order)

    [[nodiscard]] uint32_t vertexCount() const { return static_cast<uint32_t>(positions.size()); }
    [[nodiscard]] uint32_t faceCount() const {
        return faceStarts.empty() ? 0u : static_cast<uint32_t>(faceStarts.size() - 1);
    }
    [[nodiscard]] uint32_t cornerCount() const { return static_cast<uint32_t>(faceVertices.size()); }
    [[nodiscard]] uint32_t sides(uint32_t face) const { return faceStarts[face + 1] - faceStarts[face]; }
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

/// Joint palette layout: joint j of the palette is node joints[j]; its matrix is global(node) * inverseBinds[j].
/// An unskinned mesh becomes a skin of one joint, its own node, with the identity as inverse bind matrix.
struct Skin {
    std::vector<uint32_t> joints;
    std::vector<glm::mat4> inverseBinds; ///< same length as joints; identity where the file had none
};

struct Influence {
    uint32_t joint = 0; ///< index into Skin::joints
    float weight = 0.0f;
};

/// Skin weights, packed by start index: influences of cage vertex v are [starts[v], starts[v+1]), weights sum to 1,
/// zero weights dropped, at least one influence a vertex.
struct SkinWeights {
    std::vector<uint32_t> starts; ///< vertexCount + 1 entries
    std::vector<Influence> influences;
};

enum class Interpolation { step, linear, cubicSpline };
enum class ChannelPath { translation, rotation, scale };

/// One animated property of one node. values holds, per key, one value (step, linear) or in-tangent, value, out-tangent
/// (cubicSpline); a value is 3 floats, or 4 (x, y, z, w) for rotations.
struct Channel {
    uint32_t node = 0;
    ChannelPath path = ChannelPath::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times; ///< seconds, strictly increasing, at least one
    std::vector<float> values;
};

struct Clip {
    std::string name;
    double duration = 0.0; ///< seconds: the last key of any channel; the clip starts at 0
    std::vector<Channel> channels;
};

/// Encoded image bytes as the file holds them; decoding is the host's.
struct Image {
    std::string name;
    std::string mimeType; ///< "image/png", "image/jpeg" or empty
    std::vector<std::byte> bytes;
};

enum class AlphaMode { opaque, mask, blend };
enum class Wrap { repeat, clampToEdge, mirroredRepeat };

struct Material {
    std::string name;
    glm::vec4 baseColorFactor{1.0f};
    uint32_t baseColorImage = kNone; ///< index into Character::images
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
};

/// Where the polygons came from (refs: glTF FB_ngon_encoding draft; plain triangles; opt-in pairing; host arrays).
enum class PolygonSource { triangles, ngonEncoding, pairedTriangles, arrays };
[[nodiscard]] const char* polygonSourceName(PolygonSource source);

struct Character {
    std::string name; ///< file name or the host's name for it; begins every message about it
    Cage cage;
    PolygonSource polygonSource = PolygonSource::arrays;
    Skeleton skeleton;
    Skin skin;
    SkinWeights weights;
    std::vector<Clip> clips;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<std::string> warnings; ///< what was repaired or ignored, one line each
    uint32_t sourceVertexCount = 0;    ///< vertices before welding
    uint32_t seamVertexCount = 0;      ///< vertices that welding merged away
};

} // namespace supple::cage
