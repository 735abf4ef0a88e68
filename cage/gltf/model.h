// The tables of a glTF file as structs. Private to cage/gltf/.
#pragma once

#include "cage/gltf/broken.h"
#include "cage/gltf/json.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// As a file has things: indices are into its own tables, -1 where it names none.
namespace supple::cage::gltf::file {

/// Elements of accessors that something reads, by their places in kTypeNames.
enum ElementType : int { kScalar = 0, kVec2 = 1, kVec3 = 2, kVec4 = 3, kMat4 = 6 };
/// Components of elements; the values are glTF's, as are those of modes.
enum Component : int {
    kByte = 5120,
    kUnsignedByte = 5121,
    kShort = 5122,
    kUnsignedShort = 5123,
    kUnsignedInt = 5125,
    kFloat = 5126
};
enum Mode : int { kPoints = 0, kLines = 1, kLineStrip = 3, kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

/// The names of all element types that glTF has.
inline constexpr const char* kTypeNames[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};

/// If one of the structs below is broken, its other members are not read, and what uses it is left out.
struct BufferView {
    bool broken = false;
    size_t buffer = 0;
    uint64_t byteOffset = 0;
    uint64_t byteLength = 0;
    uint64_t byteStride = 0; ///< 0: packed
};

/// Where numbers of a sparse accessor lie.
struct SparsePart {
    int bufferView = -1;
    uint64_t byteOffset = 0;
    int componentType = 0; ///< of indices
};

struct Accessor {
    bool broken = false;
    int bufferView = -1; ///< -1: zeros
    uint64_t byteOffset = 0;
    int componentType = 0;
    bool normalized = false;
    uint64_t count = 0;
    int type = kScalar;
    uint64_t sparseCount = 0; ///< 0: not sparse
    SparsePart sparseIndices, sparseValues;
};

/// By attribute: the accessor.
using Attributes = std::map<std::string, int, std::less<>>;

struct Primitive {
    bool broken = false;
    Attributes attributes;
    std::vector<Attributes> targets;
    int indices = -1;
    int material = -1;
    int mode = kTriangles;
    bool isReordered = false; ///< decoded in another order of vertices and triangles than it was encoded in
    Json json;                ///< with the extensions
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives; ///< none: the mesh is broken
    std::vector<double> weights;
};

struct Node {
    std::string name;
    int mesh = -1;
    int skin = -1;
    bool hidden = false; ///< by KHR_node_visibility, with all that is below it
    std::vector<int> children;
    // Empty where the file says nothing.
    std::vector<double> translation, rotation, scale, matrix, weights;
};

struct Skin {
    std::vector<int> joints; ///< none: the skin is broken. No node has it then
    int inverseBindMatrices = -1;
};

struct AnimationSampler {
    bool broken = false;
    int input = -1;
    int output = -1;
    std::string interpolation; ///< empty: LINEAR
};

struct AnimationChannel {
    bool broken = false;
    int sampler = -1;
    int node = 0;
    std::string path;    ///< "pointer" where an extension says what moves
    std::string pointer; ///< of KHR_animation_pointer; empty: an unknown extension says it
};

struct Animation {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
    Json extras;
};

struct Scene {
    std::vector<int> nodes;
};

/// Every index is in range, and every array of numbers has its right length and finite members.
struct Model {
    std::string copyright;
    std::set<std::string, std::less<>> extensionsUsed, extensionsRequired;
    std::vector<BufferView> bufferViews;
    std::vector<Accessor> accessors;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Scene> scenes;
    int defaultScene = -1;
};

/// The model of a document that checkStructure() has passed, without what it found broken. Where decodedInto[view] is
/// not -1, that buffer takes the place of what the bufferView names.
[[nodiscard]] Model toModel(const Json& root, const std::vector<int>& decodedInto, const Broken& broken);

[[nodiscard]] size_t componentSize(int componentType);
[[nodiscard]] size_t componentsOf(int type);

} // namespace supple::cage::gltf::file
