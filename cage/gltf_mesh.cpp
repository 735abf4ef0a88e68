#include "cage/gltf_mesh.h"

#include "cage/gltf_accessors.h"
#include "cage/gltf_refusal.h"

#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace supple::cage {
namespace {

using supple_tinygltf::Model;
using supple_tinygltf::Primitive;

// Accessors may be shared, so a small file can ask for a large mesh; these bound what is built from it.
constexpr uint64_t kMaxVertices = 1u << 24;
constexpr uint64_t kMaxCorners = 3u << 24;
constexpr uint64_t kMaxAttributeFloats = 1u << 27;

class MeshReader {
public:
    MeshReader(const GltfDocument& document, size_t jointCount, Warnings& warnings)
        : document_(document), model_(document.model), jointCount_(jointCount), warnings_(warnings) {}

    GltfMesh read(uint32_t meshNode) && {
        const auto meshIndex = static_cast<size_t>(model_.nodes[meshNode].mesh);
        const auto& mesh = model_.meshes[meshIndex];
        out_.index = meshIndex;
        out_.element = at("mesh", meshIndex);
        const bool skinned = model_.nodes[meshNode].skin >= 0;
        for (size_t k = 0; k < mesh.primitives.size(); ++k) {
            const Primitive& primitive = mesh.primitives[k];
            const std::string element = out_.element + " " + at("primitive", k);
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
                static constexpr const char* kModes[] = {"POINTS", "LINES",          "LINE_LOOP",   "LINE_STRIP",
                                                         "",       "TRIANGLE_STRIP", "TRIANGLE_FAN"};
                warn(warnings_, element, std::string(kModes[primitive.mode]) + " instead of TRIANGLES; left out");
                continue;
            }
            readPrimitive(primitive, element, skinned);
        }
        if (out_.parts.empty()) {
            refuse(out_.element, "no primitive of TRIANGLES");
        }
        out_.weights.report(out_.element, warnings_);
        return std::move(out_);
    }

private:
    /// Accessors of position, joints, weights and morph targets: what makes a vertex.
    using Stream = std::tuple<int, std::vector<int>, std::vector<int>, std::vector<int>>;

    void readPrimitive(const Primitive& primitive, const std::string& element, bool skinned) {
        MeshPart part;
        part.element = element;
        part.material = primitive.material;
        part.ngonEncoded = primitive.extensions.count("FB_ngon_encoding") != 0;

        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) {
            refuse(element, "no POSITION");
        }
        if (primitive.extensions.count("KHR_draco_mesh_compression") != 0 &&
            model_.accessors[static_cast<size_t>(position->second)].bufferView < 0) {
            refuse(element, "compressed with KHR_draco_mesh_compression; export the mesh uncompressed");
        }

        // Primitives over the same accessors share their vertices.
        SkinSets sets;
        if (skinned) {
            sets = findSkinSets(primitive, element);
        }
        const std::vector<int> targets = findMorphTargets(primitive);
        const Stream stream{position->second, sets.joints, sets.weights, targets};
        const auto [known, isNew] = streams_.try_emplace(stream, static_cast<uint32_t>(out_.positions.size()));
        part.firstVertex = known->second;
        const size_t count = accessorCount(document_, position->second);
        if (isNew) {
            readVertices(position->second, sets, count, element);
            out_.morphs.append(document_, targets, count, element);
        }
        part.vertexCount = static_cast<uint32_t>(count);

        readIndices(primitive, element, part);
        readCornerAttributes(primitive, element, part);
        out_.parts.push_back(std::move(part));
    }

    /// Without sets, a mesh without a skin.
    void readVertices(int position, const SkinSets& sets, size_t count, const std::string& element) {
        if (out_.positions.size() + count > kMaxVertices) {
            refuse(element, "more than " + std::to_string(kMaxVertices) + " vertices", ErrorCode::limit);
        }
        const auto values = readFloats(document_, position, TINYGLTF_TYPE_VEC3, kFloat, element + " POSITION");
        for (size_t v = 0; v < count; ++v) {
            const glm::vec3 p(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                refuse(item(element + " POSITION", v), "not finite");
            }
            out_.positions.push_back(p);
        }
        if (sets.joints.empty()) {
            out_.weights.appendUnskinned(count);
        } else {
            out_.weights.append(document_, sets, count, jointCount_, element);
        }
    }

    void readIndices(const Primitive& primitive, const std::string& element, MeshPart& part) {
        if (primitive.indices < 0) {
            if (part.vertexCount % 3 != 0) {
                refuse(element,
                       counted(part.vertexCount, "vertex", "vertices") + " without indices, not a multiple of 3");
            }
            part.triangles.resize(part.vertexCount);
            std::iota(part.triangles.begin(), part.triangles.end(), part.firstVertex);
        } else {
            const std::string name = element + " indices";
            part.triangles = readIntegers(document_, primitive.indices, TINYGLTF_TYPE_SCALAR, kU8 | kU16 | kU32, name);
            if (part.triangles.size() % 3 != 0) {
                refuse(name, std::to_string(part.triangles.size()) + ", not a multiple of 3");
            }
            const int type = model_.accessors[static_cast<size_t>(primitive.indices)].componentType;
            const uint32_t restart = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xFFu
                                     : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xFFFFu
                                                                                      : 0xFFFFFFFFu;
            for (size_t i = 0; i < part.triangles.size(); ++i) {
                uint32_t& index = part.triangles[i];
                if (index == restart) {
                    refuse(item(name, i), std::to_string(index) + " is the restart value, which glTF 2.0 forbids");
                }
                if (index >= part.vertexCount) {
                    refuse(item(name, i), std::to_string(index) + " is out of range: the primitive has " +
                                              counted(part.vertexCount, "vertex", "vertices"));
                }
                index += part.firstVertex;
            }
        }
        cornerCount_ += part.triangles.size();
        if (cornerCount_ > kMaxCorners) {
            refuse(element, "more than " + std::to_string(kMaxCorners) + " triangle corners", ErrorCode::limit);
        }
    }

    /// Reads TEXCOORD_0, TEXCOORD_1 and COLOR_0. What is not finite becomes 0: it spoils a texture, not the shape.
    void readCornerAttributes(const Primitive& primitive, const std::string& element, MeshPart& part) {
        const auto read = [&](const char* attribute, int type) {
            std::vector<float> values;
            const auto found = primitive.attributes.find(attribute);
            if (found == primitive.attributes.end()) {
                return values;
            }
            const std::string name = element + " " + attribute;
            values = readFloats(document_, found->second, type, kFloat | kNormalizedU8 | kNormalizedU16, name);
            checkVertexCount(document_, found->second, part.vertexCount, name);
            attributeFloats_ += values.size();
            if (attributeFloats_ > kMaxAttributeFloats) {
                refuse(name,
                       "the primitives' attributes hold more than " + std::to_string(kMaxAttributeFloats) + " numbers",
                       ErrorCode::limit);
            }
            size_t repaired = 0;
            for (float& value : values) {
                if (!std::isfinite(value)) {
                    value = 0.0f;
                    ++repaired;
                }
            }
            if (repaired > 0) {
                warn(warnings_, name, counted(repaired, "value is", "values are") + " not finite; 0 instead");
            }
            return values;
        };
        part.uvs = read("TEXCOORD_0", TINYGLTF_TYPE_VEC2);
        part.uvs1 = read("TEXCOORD_1", TINYGLTF_TYPE_VEC2);
        if (primitive.attributes.count("TEXCOORD_2") != 0) {
            warn(warnings_, element, "only TEXCOORD_0 and TEXCOORD_1 are read");
        }
        const auto color = primitive.attributes.find("COLOR_0");
        if (color == primitive.attributes.end()) {
            return;
        }
        if (model_.accessors[static_cast<size_t>(color->second)].type != TINYGLTF_TYPE_VEC3) {
            part.colors = read("COLOR_0", TINYGLTF_TYPE_VEC4);
            return;
        }
        const auto rgb = read("COLOR_0", TINYGLTF_TYPE_VEC3);
        part.colors.resize(rgb.size() / 3 * 4, 1.0f);
        for (size_t i = 0; i < rgb.size(); ++i) {
            part.colors[i / 3 * 4 + i % 3] = rgb[i];
        }
    }

    const GltfDocument& document_;
    const Model& model_;
    const size_t jointCount_;
    Warnings& warnings_;

    GltfMesh out_;
    std::map<Stream, uint32_t> streams_; ///< -> first vertex
    uint64_t cornerCount_ = 0;
    uint64_t attributeFloats_ = 0;
};

} // namespace

GltfMesh readMesh(const GltfDocument& document, uint32_t meshNode, size_t jointCount, Warnings& warnings) {
    return MeshReader(document, jointCount, warnings).read(meshNode);
}

} // namespace supple::cage
