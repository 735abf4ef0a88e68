#include "cage/gltf_reader.h"

#include "cage/gltf_accessors.h"
#include "cage/gltf_document.h"
#include "cage/gltf_refusal.h"
#include "cage/gltf_uri.h"
#include "cage/polygons.h"
#include "cage/weld.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <new>
#include <numeric>
#include <set>

namespace supple::cage {
namespace {

using supple_tinygltf::Model;
using supple_tinygltf::Primitive;

// Accessors may be shared, so a small file can ask for a large character; these bound what is built from it.
constexpr uint64_t kMaxVertices = 1u << 24;
constexpr uint64_t kMaxCorners = 3u << 24;
constexpr uint64_t kMaxAttributeFloats = 1u << 27;
constexpr uint64_t kMaxKeyFloats = 1u << 26;
constexpr size_t kMaxSkinSets = 16; // of four influences each

std::string at(const char* what, size_t index) {
    return std::string(what) + " " + std::to_string(index);
}
std::string item(const std::string& element, size_t index) {
    return element + "[" + std::to_string(index) + "]";
}
std::string counted(size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}
std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// Messages are one line, whatever a file calls its parts.
std::string oneLine(std::string text) {
    for (char& c : text)
        if (std::iscntrl(static_cast<unsigned char>(c)) != 0)
            c = '?';
    return text;
}

class Reader {
public:
    Reader(const GltfDocument& document, const GltfOptions& options, Character& character)
        : document_(document), model_(document.model), options_(options), out_(character) {}

    void read() {
        out_.warnings = document_.warnings;
        readNodes();
        const uint32_t meshNode = chooseMeshNode();
        readSkin(meshNode);
        readMaterials();
        readMesh(meshNode);
        readClips();
    }

private:
    void warn(const std::string& element, const std::string& reason) {
        out_.warnings.push_back(element + ": " + reason);
    }

    // ---- nodes ------------------------------------------------------------------------------------------------------

    void readNodes() {
        const size_t count = model_.nodes.size();
        auto& skeleton = out_.skeleton;
        skeleton.nodes.resize(count);
        for (size_t i = 0; i < count; ++i) {
            const auto& from = model_.nodes[i];
            Node& node = skeleton.nodes[i];
            node.name = from.name;
            for (const int child : from.children)
                skeleton.nodes[static_cast<size_t>(child)].parent = static_cast<uint32_t>(i);
            if (!from.matrix.empty()) {
                node.hasMatrix = true;
                for (int k = 0; k < 16; ++k)
                    node.matrix[k / 4][k % 4] = static_cast<float>(from.matrix[static_cast<size_t>(k)]);
                makeAffine(node.matrix, at("node", i) + " matrix");
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                if (!from.translation.empty())
                    node.translation[k] = static_cast<float>(from.translation[static_cast<size_t>(k)]);
                if (!from.scale.empty())
                    node.scale[k] = static_cast<float>(from.scale[static_cast<size_t>(k)]);
            }
            if (!from.rotation.empty()) {
                const auto& q = from.rotation;
                const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
                if (!(length > 1e-6))
                    refuse(at("node", i) + " rotation", "zero quaternion");
                // A unit quaternion is kept bit by bit.
                const double scale = std::abs(length - 1.0) > 1e-5 ? 1.0 / length : 1.0;
                node.rotation = glm::quat(static_cast<float>(q[3] * scale), static_cast<float>(q[0] * scale),
                                          static_cast<float>(q[1] * scale), static_cast<float>(q[2] * scale));
            }
        }
        orderParentsFirst();
    }

    void orderParentsFirst() {
        // Breadth-first from the roots, no recursion; the document has made sure that this is a forest.
        const auto& nodes = out_.skeleton.nodes;
        auto& order = out_.skeleton.parentsFirst;
        order.reserve(nodes.size());
        for (uint32_t i = 0; i < nodes.size(); ++i)
            if (nodes[i].parent == kNone)
                order.push_back(i);
        uint32_t depth = 1;
        for (size_t begin = 0, end = order.size(); begin < end; ++depth) {
            if (depth > kMaxNodeDepth)
                refuse(at("node", order[begin]), "nested deeper than " + std::to_string(kMaxNodeDepth) + " levels",
                       ErrorCode::limit);
            for (size_t k = begin; k < end; ++k)
                for (const int child : model_.nodes[order[k]].children)
                    order.push_back(static_cast<uint32_t>(child));
            begin = end;
            end = order.size();
        }
    }

    static void makeAffine(glm::mat4& matrix, const std::string& element) {
        const glm::vec4 last(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
        const glm::vec4 wanted(0.0f, 0.0f, 0.0f, 1.0f);
        for (int k = 0; k < 4; ++k) {
            if (!(std::abs(last[k] - wanted[k]) <= 1e-4f))
                refuse(element, "last row is not 0 0 0 1");
            matrix[k][3] = wanted[k];
        }
    }

    // ---- which mesh, which skin
    // ---------------------------------------------------------------------------------------

    [[nodiscard]] std::vector<uint32_t> nodesInSceneOrder() const {
        std::vector<uint32_t> order;
        std::vector<uint8_t> seen(model_.nodes.size(), 0);
        std::vector<uint32_t> stack;
        if (!model_.scenes.empty()) {
            const size_t scene = model_.defaultScene >= 0 ? static_cast<size_t>(model_.defaultScene) : 0;
            const auto& roots = model_.scenes[scene].nodes;
            stack.assign(roots.rbegin(), roots.rend()); // the first on top
        }
        while (!stack.empty()) {
            const uint32_t node = stack.back();
            stack.pop_back();
            if (seen[node] != 0)
                continue;
            seen[node] = 1;
            order.push_back(node);
            const auto& children = model_.nodes[node].children;
            stack.insert(stack.end(), children.rbegin(), children.rend());
        }
        for (uint32_t i = 0; i < seen.size(); ++i)
            if (seen[i] == 0)
                order.push_back(i);
        return order;
    }

    [[nodiscard]] uint32_t chooseMeshNode() {
        if (model_.meshes.empty())
            refuse("meshes", "none");
        uint32_t chosen = kNone;
        size_t others = 0;
        for (const uint32_t i : nodesInSceneOrder()) {
            const auto& node = model_.nodes[i];
            if (node.mesh < 0)
                continue;
            if (chosen == kNone) {
                chosen = i;
            } else if (node.skin >= 0 && model_.nodes[chosen].skin < 0) {
                chosen = i;
                ++others;
            } else {
                ++others;
            }
        }
        if (chosen == kNone)
            refuse("nodes", "none has a mesh");
        if (others > 0)
            warn(at("node", chosen), "the mesh of this node is read; " +
                                         counted(others, "other node with a mesh is", "other nodes with meshes are") +
                                         " left out");
        return chosen;
    }

    void readSkin(uint32_t meshNode) {
        auto& skin = out_.skin;
        const int index = model_.nodes[meshNode].skin;
        if (index < 0) {
            skin.joints = {meshNode};
            skin.inverseBinds = {glm::mat4(1.0f)};
            return;
        }
        const auto& from = model_.skins[static_cast<size_t>(index)];
        for (const int joint : from.joints)
            skin.joints.push_back(static_cast<uint32_t>(joint));
        skin.inverseBinds.assign(skin.joints.size(), glm::mat4(1.0f));
        if (from.inverseBindMatrices < 0)
            return;
        const std::string element = at("skin", static_cast<size_t>(index)) + " inverseBindMatrices";
        const auto values = readFloats(document_, from.inverseBindMatrices, TINYGLTF_TYPE_MAT4, kFloat, element);
        if (values.size() / 16 < skin.joints.size())
            refuse(element, counted(values.size() / 16, "matrix", "matrices") + " for " +
                                counted(skin.joints.size(), "joint", "joints"));
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            for (size_t k = 0; k < 16; ++k) {
                if (!std::isfinite(values[16 * j + k]))
                    refuse(item(element, j), "not finite");
                skin.inverseBinds[j][static_cast<int>(k / 4)][static_cast<int>(k % 4)] = values[16 * j + k];
            }
            makeAffine(skin.inverseBinds[j], item(element, j));
        }
    }

    // ---- materials
    // ----------------------------------------------------------------------------------------------------

    static Wrap wrapOf(int value) {
        return value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::clampToEdge
               : value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirroredRepeat
                                                                : Wrap::repeat;
    }

    void readMaterials() {
        out_.images = document_.images;
        for (size_t i = 0; i < model_.materials.size(); ++i) {
            const auto& from = model_.materials[i];
            Material material;
            material.name = from.name;
            const auto& pbr = from.pbrMetallicRoughness;
            for (int k = 0; k < 4; ++k)
                material.baseColorFactor[k] = static_cast<float>(pbr.baseColorFactor[static_cast<size_t>(k)]);
            material.doubleSided = from.doubleSided;
            material.alphaCutoff = static_cast<float>(from.alphaCutoff);
            if (from.alphaMode == "MASK")
                material.alphaMode = AlphaMode::mask;
            else if (from.alphaMode == "BLEND")
                material.alphaMode = AlphaMode::blend;
            else if (!from.alphaMode.empty() && from.alphaMode != "OPAQUE")
                warn(at("material", i) + " alphaMode", "\"" + from.alphaMode + "\" is unknown; opaque");
            if (pbr.baseColorTexture.index >= 0) {
                const auto& texture = model_.textures[static_cast<size_t>(pbr.baseColorTexture.index)];
                if (pbr.baseColorTexture.texCoord != 0)
                    warn(at("material", i) + " baseColorTexture", "only TEXCOORD_0 is read");
                if (pbr.baseColorTexture.extensions.count("KHR_texture_transform") != 0)
                    warn(at("material", i) + " baseColorTexture", "KHR_texture_transform is ignored");
                if (texture.source < 0)
                    warn(at("texture", static_cast<size_t>(pbr.baseColorTexture.index)),
                         "no image in a core format; left out");
                else if (!out_.images[static_cast<size_t>(texture.source)].bytes.empty())
                    material.baseColorImage = static_cast<uint32_t>(texture.source);
                if (texture.sampler >= 0) {
                    const auto& sampler = model_.samplers[static_cast<size_t>(texture.sampler)];
                    material.wrapU = wrapOf(sampler.wrapS);
                    material.wrapV = wrapOf(sampler.wrapT);
                }
            }
            out_.materials.push_back(std::move(material));
        }
    }

    // ---- mesh
    // ---------------------------------------------------------------------------------------------------------

    /// One primitive's share of the mesh.
    struct Part {
        std::string element;
        int material = -1;
        bool ngonEncoded = false;
        uint32_t firstVertex = 0; ///< of its POSITION elements among all vertices read
        uint32_t vertexCount = 0;
        std::vector<uint32_t> triangles; ///< three vertices each, counted over all parts
        std::vector<float> uvs;          ///< two per POSITION element, or empty
        std::vector<float> colors;       ///< four per POSITION element, or empty
    };

    void readMesh(uint32_t meshNode) {
        const auto meshIndex = static_cast<size_t>(model_.nodes[meshNode].mesh);
        const auto& mesh = model_.meshes[meshIndex];
        const bool skinned = model_.nodes[meshNode].skin >= 0;
        size_t morphed = 0;
        for (size_t k = 0; k < mesh.primitives.size(); ++k) {
            const Primitive& primitive = mesh.primitives[k];
            const std::string element = at("mesh", meshIndex) + " " + at("primitive", k);
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
                static constexpr const char* kModes[] = {"POINTS", "LINES",          "LINE_LOOP",   "LINE_STRIP",
                                                         "",       "TRIANGLE_STRIP", "TRIANGLE_FAN"};
                warn(element, std::string(kModes[primitive.mode]) + " instead of TRIANGLES; left out");
                continue;
            }
            morphed += primitive.targets.empty() ? 0 : 1;
            readPrimitive(primitive, element, skinned);
        }
        if (parts_.empty())
            refuse(at("mesh", meshIndex), "no primitive of TRIANGLES");
        if (morphed > 0)
            warn(at("mesh", meshIndex), "morph targets are ignored");
        reportWeights(at("mesh", meshIndex));
        buildCage(at("mesh", meshIndex));
    }

    void readPrimitive(const Primitive& primitive, const std::string& element, bool skinned) {
        Part part;
        part.element = element;
        part.material = primitive.material;
        part.ngonEncoded = primitive.extensions.count("FB_ngon_encoding") != 0;

        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end())
            refuse(element, "no POSITION");
        if (primitive.extensions.count("KHR_draco_mesh_compression") != 0 &&
            model_.accessors[static_cast<size_t>(position->second)].bufferView < 0)
            refuse(element, "compressed with KHR_draco_mesh_compression; export the mesh uncompressed");

        // Primitives over the same accessors share their vertices.
        std::vector<int> joints;
        std::vector<int> weights;
        if (skinned)
            findSkinSets(primitive, element, joints, weights);
        std::vector<int> key{position->second};
        key.insert(key.end(), joints.begin(), joints.end());
        key.insert(key.end(), weights.begin(), weights.end());
        const auto [known, isNew] = streams_.try_emplace(key, static_cast<uint32_t>(positions_.size()));
        part.firstVertex = known->second;
        const size_t count = accessorCount(document_, position->second);
        if (isNew)
            readVertices(position->second, joints, weights, element, count);
        part.vertexCount = static_cast<uint32_t>(count);

        readIndices(primitive, element, part);
        readCornerAttributes(primitive, element, part);
        parts_.push_back(std::move(part));
    }

    void findSkinSets(const Primitive& primitive, const std::string& element, std::vector<int>& joints,
                      std::vector<int>& weights) const {
        for (size_t n = 0;; ++n) {
            const auto joint = primitive.attributes.find("JOINTS_" + std::to_string(n));
            const auto weight = primitive.attributes.find("WEIGHTS_" + std::to_string(n));
            const bool hasJoint = joint != primitive.attributes.end();
            const bool hasWeight = weight != primitive.attributes.end();
            if (hasJoint != hasWeight)
                refuse(element, (hasJoint ? "JOINTS_" : "WEIGHTS_") + std::to_string(n) + " without " +
                                    (hasJoint ? "WEIGHTS_" : "JOINTS_") + std::to_string(n));
            if (!hasJoint)
                break;
            if (n == kMaxSkinSets)
                refuse(element, "more than " + std::to_string(kMaxSkinSets) + " sets of joints and weights",
                       ErrorCode::limit);
            joints.push_back(joint->second);
            weights.push_back(weight->second);
        }
        if (joints.empty())
            refuse(element, "no JOINTS_0 and WEIGHTS_0, but its node has a skin");
        for (const auto& [name, accessor] : primitive.attributes) {
            (void)accessor;
            for (const std::string prefix : {"JOINTS_", "WEIGHTS_"}) {
                if (!name.starts_with(prefix))
                    continue;
                const std::string number = name.substr(prefix.size());
                bool found = false;
                for (size_t n = 0; n < joints.size() && !found; ++n)
                    found = number == std::to_string(n);
                if (!found)
                    refuse(element, name + " does not continue the sets from 0");
            }
        }
    }

    void readVertices(int position, const std::vector<int>& joints, const std::vector<int>& weights,
                      const std::string& element, size_t count) {
        if (positions_.size() + count > kMaxVertices)
            refuse(element, "more than " + std::to_string(kMaxVertices) + " vertices", ErrorCode::limit);
        const auto values = readFloats(document_, position, TINYGLTF_TYPE_VEC3, kFloat, element + " POSITION");
        for (size_t v = 0; v < count; ++v) {
            const glm::vec3 p(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                refuse(item(element + " POSITION", v), "not finite");
            positions_.push_back(p);
        }
        if (joints.empty()) {
            for (size_t v = 0; v < count; ++v) {
                influences_.push_back({0, 1.0f});
                influenceStarts_.push_back(static_cast<uint32_t>(influences_.size()));
            }
            return;
        }

        std::vector<std::vector<uint32_t>> jointValues;
        std::vector<std::vector<float>> weightValues;
        double rounding = 0.0; // half a step of the coarsest integer weights
        for (size_t n = 0; n < joints.size(); ++n) {
            const std::string jointName = element + " JOINTS_" + std::to_string(n);
            const std::string weightName = element + " WEIGHTS_" + std::to_string(n);
            if (accessorCount(document_, joints[n]) != count)
                refuse(jointName, counted(accessorCount(document_, joints[n]), "element", "elements") + " for " +
                                      counted(count, "vertex", "vertices"));
            if (accessorCount(document_, weights[n]) != count)
                refuse(weightName, counted(accessorCount(document_, weights[n]), "element", "elements") + " for " +
                                       counted(count, "vertex", "vertices"));
            jointValues.push_back(readIntegers(document_, joints[n], TINYGLTF_TYPE_VEC4, kU8 | kU16, jointName));
            weightValues.push_back(readFloats(document_, weights[n], TINYGLTF_TYPE_VEC4,
                                              kFloat | kNormalizedU8 | kNormalizedU16, weightName));
            const int type = model_.accessors[static_cast<size_t>(weights[n])].componentType;
            if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
                rounding = std::max(rounding, 0.5 / 255.0);
            else if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
                rounding = std::max(rounding, 0.5 / 65535.0);
        }
        std::vector<Influence> own;
        for (size_t v = 0; v < count; ++v) {
            own.clear();
            double sum = 0.0;
            for (size_t n = 0; n < joints.size(); ++n) {
                for (size_t k = 0; k < 4; ++k) {
                    const float weight = weightValues[n][4 * v + k];
                    const uint32_t joint = jointValues[n][4 * v + k];
                    const auto place = [&](const char* name) { return item(element + name + std::to_string(n), v); };
                    if (!std::isfinite(weight))
                        refuse(place(" WEIGHTS_"), "not finite");
                    if (weight < 0.0f)
                        refuse(place(" WEIGHTS_"), "negative");
                    if (weight == 0.0f)
                        continue; // its joint means nothing
                    if (joint >= out_.skin.joints.size())
                        refuse(place(" JOINTS_"), "joint " + std::to_string(joint) + " is out of range: the skin has " +
                                                      std::to_string(out_.skin.joints.size()));
                    own.push_back({joint, weight});
                    sum += weight;
                }
            }
            if (!(sum > 0.0)) {
                const uint32_t joint = jointValues[0][4 * v];
                own.push_back({joint < out_.skin.joints.size() ? joint : 0, 1.0f});
                sum = 1.0;
                ++unweighted_;
            }
            const double deviation = std::abs(sum - 1.0);
            if (deviation > std::max(1e-4, rounding * static_cast<double>(own.size()) * 1.001)) {
                ++renormalised_;
                largestDeviation_ = std::max(largestDeviation_, deviation);
            }
            std::sort(own.begin(), own.end(), [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
            for (size_t i = 0; i < own.size();) {
                double weight = 0.0;
                const uint32_t joint = own[i].joint;
                for (; i < own.size() && own[i].joint == joint; ++i)
                    weight += own[i].weight;
                // A subnormal weight may vanish when divided; the others keep the vertex bound.
                const auto scaled = static_cast<float>(weight / sum);
                if (scaled > 0.0f)
                    influences_.push_back({joint, scaled});
            }
            influenceStarts_.push_back(static_cast<uint32_t>(influences_.size()));
        }
    }

    void reportWeights(const std::string& element) {
        if (renormalised_ > 0)
            warn(element + " WEIGHTS", "normalised: they do not sum to 1 at " +
                                           counted(renormalised_, "vertex", "vertices") + ", largest deviation " +
                                           shortNumber(largestDeviation_));
        if (unweighted_ > 0)
            warn(element + " WEIGHTS", "all zero at " + counted(unweighted_, "vertex", "vertices") +
                                           "; bound to the first joint named there");
    }

    void readIndices(const Primitive& primitive, const std::string& element, Part& part) {
        if (primitive.indices < 0) {
            if (part.vertexCount % 3 != 0)
                refuse(element,
                       counted(part.vertexCount, "vertex", "vertices") + " without indices, not a multiple of 3");
            part.triangles.resize(part.vertexCount);
            std::iota(part.triangles.begin(), part.triangles.end(), part.firstVertex);
        } else {
            const std::string name = element + " indices";
            part.triangles = readIntegers(document_, primitive.indices, TINYGLTF_TYPE_SCALAR, kU8 | kU16 | kU32, name);
            if (part.triangles.size() % 3 != 0)
                refuse(name, std::to_string(part.triangles.size()) + ", not a multiple of 3");
            const int type = model_.accessors[static_cast<size_t>(primitive.indices)].componentType;
            const uint32_t restart = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE    ? 0xFFu
                                     : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 0xFFFFu
                                                                                      : 0xFFFFFFFFu;
            for (size_t i = 0; i < part.triangles.size(); ++i) {
                uint32_t& index = part.triangles[i];
                if (index == restart)
                    refuse(item(name, i), std::to_string(index) + " is the restart value, which glTF 2.0 forbids");
                if (index >= part.vertexCount)
                    refuse(item(name, i), std::to_string(index) + " is out of range: the primitive has " +
                                              counted(part.vertexCount, "vertex", "vertices"));
                index += part.firstVertex;
            }
        }
        cornerCount_ += part.triangles.size();
        if (cornerCount_ > kMaxCorners)
            refuse(element, "more than " + std::to_string(kMaxCorners) + " triangle corners", ErrorCode::limit);
    }

    /// Reads TEXCOORD_0 and COLOR_0. What is not finite becomes 0: it spoils a texture, not the shape.
    void readCornerAttributes(const Primitive& primitive, const std::string& element, Part& part) {
        const auto read = [&](const char* attribute, int type) {
            std::vector<float> values;
            const auto found = primitive.attributes.find(attribute);
            if (found == primitive.attributes.end())
                return values;
            const std::string name = element + " " + attribute;
            values = readFloats(document_, found->second, type, kFloat | kNormalizedU8 | kNormalizedU16, name);
            if (accessorCount(document_, found->second) != part.vertexCount)
                refuse(name, counted(accessorCount(document_, found->second), "element", "elements") + " for " +
                                 counted(part.vertexCount, "vertex", "vertices"));
            attributeFloats_ += values.size();
            if (attributeFloats_ > kMaxAttributeFloats)
                refuse(name,
                       "the primitives' attributes hold more than " + std::to_string(kMaxAttributeFloats) + " numbers",
                       ErrorCode::limit);
            size_t repaired = 0;
            for (float& value : values) {
                if (!std::isfinite(value)) {
                    value = 0.0f;
                    ++repaired;
                }
            }
            if (repaired > 0)
                warn(name, counted(repaired, "value is", "values are") + " not finite; 0 instead");
            return values;
        };
        part.uvs = read("TEXCOORD_0", TINYGLTF_TYPE_VEC2);
        const auto color = primitive.attributes.find("COLOR_0");
        if (color == primitive.attributes.end())
            return;
        if (model_.accessors[static_cast<size_t>(color->second)].type != TINYGLTF_TYPE_VEC3) {
            part.colors = read("COLOR_0", TINYGLTF_TYPE_VEC4);
            return;
        }
        const auto rgb = read("COLOR_0", TINYGLTF_TYPE_VEC3);
        part.colors.resize(rgb.size() / 3 * 4, 1.0f);
        for (size_t i = 0; i < rgb.size(); ++i)
            part.colors[i / 3 * 4 + i % 3] = rgb[i];
    }

    // ---- cage
    // ---------------------------------------------------------------------------------------------------------

    [[nodiscard]] std::span<const Influence> influencesOf(uint32_t vertex) const {
        return std::span(influences_)
            .subspan(influenceStarts_[vertex], influenceStarts_[vertex + 1] - influenceStarts_[vertex]);
    }

    /// Numbers the sets of vertices with equal position and skin; warns where only the position is equal.
    [[nodiscard]] std::vector<uint32_t> candidateSets(const std::vector<uint8_t>& used, const std::string& element) {
        std::vector<uint32_t> order;
        for (uint32_t v = 0; v < positions_.size(); ++v)
            if (used[v] != 0)
                order.push_back(v);
        const auto comparePositions = [&](uint32_t a, uint32_t b) {
            // Finite floats: comparing values is comparing bits, but for -0 = 0.
            for (int k = 0; k < 3; ++k)
                if (positions_[a][k] != positions_[b][k])
                    return positions_[a][k] < positions_[b][k] ? -1 : 1;
            return 0;
        };
        const auto compareSkins = [&](uint32_t a, uint32_t b) {
            const auto x = influencesOf(a);
            const auto y = influencesOf(b);
            if (x.size() != y.size())
                return x.size() < y.size() ? -1 : 1;
            for (size_t i = 0; i < x.size(); ++i) {
                if (x[i].joint != y[i].joint)
                    return x[i].joint < y[i].joint ? -1 : 1;
                if (x[i].weight != y[i].weight)
                    return x[i].weight < y[i].weight ? -1 : 1;
            }
            return 0;
        };
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            const int byPosition = comparePositions(a, b);
            const int byBoth = byPosition != 0 ? byPosition : compareSkins(a, b);
            return byBoth != 0 ? byBoth < 0 : a < b;
        });
        std::vector<uint32_t> sets(positions_.size(), 0);
        uint32_t set = 0;
        size_t cracks = 0;
        uint32_t crack[2] = {0, 0};
        for (size_t i = 0; i < order.size(); ++i) {
            if (i > 0) {
                const bool samePosition = comparePositions(order[i - 1], order[i]) == 0;
                const bool sameSkin = samePosition && compareSkins(order[i - 1], order[i]) == 0;
                if (!sameSkin)
                    ++set;
                if (samePosition && !sameSkin && cracks++ == 0) {
                    crack[0] = std::min(order[i - 1], order[i]);
                    crack[1] = std::max(order[i - 1], order[i]);
                }
            }
            sets[order[i]] = set;
        }
        if (cracks > 0)
            warn(element, counted(cracks, "vertex agrees", "vertices agree") +
                              " with another in position but not in "
                              "skin (first: vertices " +
                              std::to_string(crack[0]) + " and " + std::to_string(crack[1]) + "); kept apart");
        return sets;
    }

    [[nodiscard]] Polygons recoverPolygons(const Part& part, std::span<const uint32_t> welded) const {
        if (part.ngonEncoded)
            return decodeNgons(part.triangles, welded);
        if (!options_.pairQuads)
            return keepTriangles(part.triangles, welded);
        const auto same = [](const std::vector<float>& values, size_t width, size_t a, size_t b) {
            for (size_t k = 0; k < width && !values.empty(); ++k)
                if (values[width * a + k] != values[width * b + k])
                    return false;
            return true;
        };
        const auto sameCorner = [&](uint32_t a, uint32_t b) {
            return same(part.uvs, 2, a - part.firstVertex, b - part.firstVertex) &&
                   same(part.colors, 4, a - part.firstVertex, b - part.firstVertex);
        };
        const auto normal = [&](const uint32_t* t) {
            const glm::dvec3 a(positions_[t[0]]);
            return glm::cross(glm::dvec3(positions_[t[1]]) - a, glm::dvec3(positions_[t[2]]) - a);
        };
        const auto normalsAgree = [&](const uint32_t* a, const uint32_t* b) {
            return glm::dot(normal(a), normal(b)) > 0.0;
        };
        return pairTriangles(part.triangles, welded, sameCorner, normalsAgree);
    }

    void buildCage(const std::string& element) {
        const size_t sourceCount = positions_.size();
        std::vector<uint8_t> used(sourceCount, 0);
        std::vector<uint32_t> triangles;
        for (const Part& part : parts_) {
            for (const uint32_t v : part.triangles)
                used[v] = 1;
            triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
        }
        const auto unused = static_cast<size_t>(std::count(used.begin(), used.end(), uint8_t{0}));
        if (unused > 0)
            warn(element, counted(unused, "vertex has", "vertices have") + " no triangle; left out");

        Welding welding = weld(candidateSets(used, element), triangles);
        triangles.clear();

        Polygons polygons;
        std::vector<size_t> partOfFace;
        bool paired = false;
        for (size_t p = 0; p < parts_.size(); ++p) {
            const Polygons own = recoverPolygons(parts_[p], welding.roots);
            if (own.degenerateTriangles > 0)
                warn(parts_[p].element,
                     counted(own.degenerateTriangles, "triangle", "triangles") + " with a repeated vertex left out");
            if (own.recutRuns > 0)
                warn(parts_[p].element,
                     "FB_ngon_encoding: " + counted(own.recutRuns, "polygon closes", "polygons close") +
                         " on itself; cut into quads and triangles again");
            for (size_t f = 0; f < own.faceCount(); ++f) {
                polygons.vertices.insert(polygons.vertices.end(), own.vertices.begin() + own.starts[f],
                                         own.vertices.begin() + own.starts[f + 1]);
                polygons.close();
                partOfFace.push_back(p);
            }
            paired = paired || (!parts_[p].ngonEncoded && options_.pairQuads);
        }
        if (polygons.faceCount() == 0)
            refuse(element, "no triangle is left");
        const uint32_t apart = unweldDefects(polygons, welding);
        if (apart > 0)
            warn(element, counted(apart, "welded vertex is", "welded vertices are") +
                              " taken apart again: faces do not fit together there");

        const bool encoded = std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.ngonEncoded; });
        out_.polygonSource = encoded  ? PolygonSource::ngonEncoding
                             : paired ? PolygonSource::pairedTriangles
                                      : PolygonSource::triangles;
        fillCage(polygons, partOfFace, welding);
        out_.sourceVertexCount = static_cast<uint32_t>(sourceCount);
    }

    void fillCage(const Polygons& polygons, const std::vector<size_t>& partOfFace, const Welding& welding) {
        Cage& cage = out_.cage;
        std::vector<uint8_t> used(positions_.size(), 0);
        for (const uint32_t v : polygons.vertices)
            used[v] = 1;
        // A root is the smallest vertex of its set, but may itself have lost its faces to degenerate triangles.
        std::vector<uint32_t> cageVertex(positions_.size(), kNone);
        uint32_t usedCount = 0;
        for (uint32_t v = 0; v < positions_.size(); ++v) {
            if (used[v] == 0)
                continue;
            ++usedCount;
            uint32_t& index = cageVertex[welding.roots[v]];
            if (index != kNone)
                continue;
            index = cage.vertexCount();
            cage.positions.push_back(positions_[v]);
            cage.sourceVertices.push_back(v);
        }
        out_.seamVertexCount = usedCount - cage.vertexCount();

        cage.faceStarts = polygons.starts;
        cage.faceVertices.reserve(polygons.vertices.size());
        for (const uint32_t v : polygons.vertices)
            cage.faceVertices.push_back(cageVertex[welding.roots[v]]);
        for (const size_t part : partOfFace)
            cage.faceMaterials.push_back(parts_[part].material < 0 ? kNone
                                                                   : static_cast<uint32_t>(parts_[part].material));
        const auto any = [&](auto member) {
            return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return !(part.*member).empty(); });
        };
        if (any(&Part::uvs))
            cage.cornerUvs.assign(polygons.vertices.size(), glm::vec2(0.0f));
        if (any(&Part::colors))
            cage.cornerColors.assign(polygons.vertices.size(), glm::vec4(1.0f));
        for (size_t f = 0; f < partOfFace.size(); ++f) {
            const Part& part = parts_[partOfFace[f]];
            for (uint32_t c = polygons.starts[f]; c < polygons.starts[f + 1]; ++c) {
                const size_t v = polygons.vertices[c] - part.firstVertex;
                if (!part.uvs.empty())
                    cage.cornerUvs[c] = {part.uvs[2 * v], part.uvs[2 * v + 1]};
                if (!part.colors.empty())
                    cage.cornerColors[c] = {part.colors[4 * v], part.colors[4 * v + 1], part.colors[4 * v + 2],
                                            part.colors[4 * v + 3]};
            }
        }

        out_.weights.starts.push_back(0);
        for (const uint32_t v : cage.sourceVertices) {
            const auto own = influencesOf(v);
            out_.weights.influences.insert(out_.weights.influences.end(), own.begin(), own.end());
            out_.weights.starts.push_back(static_cast<uint32_t>(out_.weights.influences.size()));
        }
    }

    // ---- clips
    // --------------------------------------------------------------------------------------------------------

    void readClips() {
        for (size_t i = 0; i < model_.animations.size(); ++i) {
            const auto& animation = model_.animations[i];
            Clip clip;
            clip.name = animation.name.empty() ? "clip_" + std::to_string(i) : animation.name;
            std::map<std::string, size_t> ignored;
            std::set<std::pair<int, std::string>> targets;
            for (size_t k = 0; k < animation.channels.size(); ++k) {
                const auto& channel = animation.channels[k];
                const std::string& path = channel.target_path;
                if (path != "translation" && path != "rotation" && path != "scale") {
                    ++ignored[path];
                    continue;
                }
                const std::string element = at("animation", i) + " " + at("channel", k);
                if (!targets.emplace(channel.target_node, path).second)
                    refuse(element, "a second channel for " + path + " of node " + std::to_string(channel.target_node));
                if (out_.skeleton.nodes[static_cast<size_t>(channel.target_node)].hasMatrix)
                    refuse(element, "animates node " + std::to_string(channel.target_node) + ", which has a matrix");
                clip.channels.push_back(readChannel(animation, channel, element));
                clip.duration = std::max(clip.duration, static_cast<double>(clip.channels.back().times.back()));
            }
            for (const auto& [path, count] : ignored)
                warn(at("animation", i), counted(count, "channel", "channels") + " of " +
                                             (path == "pointer" ? "KHR_animation_pointer or no node" : path) +
                                             " ignored");
            out_.clips.push_back(std::move(clip));
        }
    }

    Channel readChannel(const supple_tinygltf::Animation& animation, const supple_tinygltf::AnimationChannel& from,
                        const std::string& element) {
        Channel channel;
        channel.node = static_cast<uint32_t>(from.target_node);
        channel.path = from.target_path == "translation" ? ChannelPath::translation
                       : from.target_path == "rotation"  ? ChannelPath::rotation
                                                         : ChannelPath::scale;
        const auto& sampler = animation.samplers[static_cast<size_t>(from.sampler)];
        channel.interpolation = sampler.interpolation == "STEP"          ? Interpolation::step
                                : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubicSpline
                                                                         : Interpolation::linear;

        const std::string input = element + " input";
        channel.times = readFloats(document_, sampler.input, TINYGLTF_TYPE_SCALAR, kFloat, input);
        for (size_t k = 0; k < channel.times.size(); ++k) {
            if (!std::isfinite(channel.times[k]))
                refuse(item(input, k), "not finite");
            if (channel.times[k] < 0.0f)
                refuse(item(input, k), "negative time");
            if (k > 0 && !(channel.times[k] > channel.times[k - 1]))
                refuse(item(input, k), "not later than the key before it");
        }
        const bool cubic = channel.interpolation == Interpolation::cubicSpline;
        if (cubic && channel.times.size() < 2)
            refuse(input, "CUBICSPLINE needs at least two keys");

        const std::string output = element + " output";
        const bool rotation = channel.path == ChannelPath::rotation;
        channel.values = readFloats(document_, sampler.output, rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3,
                                    rotation ? kFloat | kNormalizedU8 | kNormalizedU16 | kNormalizedS8 | kNormalizedS16
                                             : static_cast<uint32_t>(kFloat),
                                    output);
        const size_t width = rotation ? 4 : 3;
        const size_t perKey = cubic ? 3 : 1;
        if (channel.values.size() != channel.times.size() * perKey * width)
            refuse(output, counted(channel.values.size() / width, "element", "elements") + " for " +
                               counted(channel.times.size(), "key", "keys") + (cubic ? " of CUBICSPLINE" : ""));
        for (size_t k = 0; k < channel.values.size(); ++k)
            if (!std::isfinite(channel.values[k]))
                refuse(item(output, k / width), "not finite");
        if (rotation)
            checkRotations(channel, perKey, output);
        keyFloats_ += channel.times.size() + channel.values.size();
        if (keyFloats_ > kMaxKeyFloats)
            refuse(element, "the clips hold more than " + std::to_string(kMaxKeyFloats) + " numbers", ErrorCode::limit);
        return channel;
    }

    /// Key rotations are unit quaternions but for rounding, which 8-bit outputs make coarse. Tangents are left alone.
    static void checkRotations(Channel& channel, size_t perKey, const std::string& output) {
        for (size_t k = perKey / 2; 4 * k < channel.values.size(); k += perKey) {
            float* q = &channel.values[4 * k];
            const double length = std::sqrt(static_cast<double>(q[0]) * q[0] + static_cast<double>(q[1]) * q[1] +
                                            static_cast<double>(q[2]) * q[2] + static_cast<double>(q[3]) * q[3]);
            if (!(length > 1e-6))
                refuse(item(output, k), "zero quaternion");
            if (std::abs(length - 1.0) > 1e-5 && channel.interpolation != Interpolation::cubicSpline)
                for (int c = 0; c < 4; ++c)
                    q[c] = static_cast<float>(q[c] / length);
        }
    }

    const GltfDocument& document_;
    const Model& model_;
    const GltfOptions& options_;
    Character& out_;

    // Vertices of all parts, before welding.
    std::map<std::vector<int>, uint32_t> streams_; ///< accessors of position and skin -> first vertex
    std::vector<glm::vec3> positions_;
    std::vector<uint32_t> influenceStarts_{0};
    std::vector<Influence> influences_; ///< by joint, normalised
    std::vector<Part> parts_;
    uint64_t cornerCount_ = 0;
    uint64_t attributeFloats_ = 0;
    uint64_t keyFloats_ = 0;
    size_t renormalised_ = 0;
    size_t unweighted_ = 0;
    double largestDeviation_ = 0.0;
};

Error failure(ErrorCode code, const std::string& name, const std::string& message) {
    return Error{code, oneLine(name + ": " + message)};
}

} // namespace

Result<Character> readGltf(std::span<const std::byte> bytes, const std::string& name, const std::string& baseDirectory,
                           const GltfOptions& options) {
    try {
        Character character;
        character.name = name;
        const GltfDocument document = loadGltfDocument(bytes, baseDirectory);
        Reader(document, options, character).read();
        const std::string prefix = name + ": ";
        for (std::string& warning : character.warnings)
            warning = oneLine(warning.insert(0, prefix));
        return character;
    } catch (const Refusal& refusal) {
        return failure(refusal.code, name, refusal.message);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, name, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::asset, name, std::string("file: ") + error.what());
    }
}

Result<Character> readGltfFile(const std::string& path, const GltfOptions& options) {
    std::string name = path;
    try {
        const std::filesystem::path file(path);
        if (file.has_filename())
            name = file.filename().string();
        const UriBytes read = readRegularFile(path);
        if (!read.problem.empty())
            return failure(ErrorCode::io, name, "file: " + read.problem + ": \"" + path + "\"");
        const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
        return readGltf(read.bytes, name, folder, options);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, name, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::io, name, std::string("file: ") + error.what());
    }
}

} // namespace supple::cage
