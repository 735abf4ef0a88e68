// Small glTF files made in memory, to be right or wrong in exactly one place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace supple::test {

inline std::vector<std::byte> toBytes(const std::string& text) {
    std::vector<std::byte> bytes(text.size());
    if (!text.empty())
        std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

inline void appendU32(std::vector<std::byte>& bytes, uint32_t value) {
    for (int i = 0; i < 4; ++i)
        bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xFFu));
}

/// A GLB of the two chunks; no BIN chunk when `binary` is empty.
inline std::vector<std::byte> packGlb(std::string json, std::vector<std::byte> binary) {
    while (json.size() % 4 != 0)
        json += ' ';
    while (binary.size() % 4 != 0)
        binary.push_back(std::byte{0});
    std::vector<std::byte> bytes = toBytes("glTF");
    const size_t length = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
    appendU32(bytes, 2);
    appendU32(bytes, static_cast<uint32_t>(length));
    appendU32(bytes, static_cast<uint32_t>(json.size()));
    appendU32(bytes, 0x4E4F534Au);
    const auto text = toBytes(json);
    bytes.insert(bytes.end(), text.begin(), text.end());
    if (!binary.empty()) {
        appendU32(bytes, static_cast<uint32_t>(binary.size()));
        appendU32(bytes, 0x004E4942u);
        bytes.insert(bytes.end(), binary.begin(), binary.end());
    }
    return bytes;
}

inline std::string base64(std::span<const std::byte> bytes) {
    static const char* const kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint32_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kAlphabet[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

/// One bufferView an accessor, all in the GLB's binary chunk; the rest of the file is JSON text.
class GltfBuilder {
public:
    std::string nodes = R"([{"mesh":0}])";
    std::string meshes;
    std::string more; ///< further top-level members, each with a comma in front

    int addFloats(const std::string& type, const std::vector<float>& values) {
        std::vector<std::byte> bytes(values.size() * 4);
        std::memcpy(bytes.data(), values.data(), bytes.size());
        return add(type, 5126, values.size(), bytes);
    }

    /// Component type 5121, 5123 or 5125; for the signed 5120 and 5122 the values are bit patterns.
    int addIntegers(const std::string& type, int componentType, const std::vector<uint32_t>& values,
                    bool normalized = false) {
        const size_t size = componentType <= 5121 ? 1 : componentType <= 5123 ? 2 : 4;
        std::vector<std::byte> bytes;
        for (const uint32_t value : values)
            for (size_t i = 0; i < size; ++i)
                bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xFFu));
        return add(type, componentType, values.size(), bytes, normalized);
    }

    void setFloat(int accessor, size_t component, float value) {
        std::memcpy(binary_.data() + offsets_[static_cast<size_t>(accessor)] + 4 * component, &value, 4);
    }
    void setByte(int accessor, size_t index, uint8_t value) {
        binary_[offsets_[static_cast<size_t>(accessor)] + index] = static_cast<std::byte>(value);
    }

    [[nodiscard]] std::string json(const std::string& bufferUri = "") const {
        return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(binary_.size()) +
               (bufferUri.empty() ? "" : R"(,"uri":")" + bufferUri + "\"") + R"(}],"bufferViews":[)" + views_ +
               R"(],"accessors":[)" + accessors_ + R"(],"nodes":)" + nodes + R"(,"meshes":)" + meshes + more + "}";
    }
    [[nodiscard]] const std::vector<std::byte>& binary() const { return binary_; }
    [[nodiscard]] std::vector<std::byte> glb() const { return packGlb(json(), binary_); }
    [[nodiscard]] std::vector<std::byte> embedded() const {
        return toBytes(json("data:application/octet-stream;base64," + base64(binary_)));
    }

private:
    int add(const std::string& type, int componentType, size_t components, const std::vector<std::byte>& bytes,
            bool normalized = false) {
        const size_t width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
        const auto number = static_cast<int>(offsets_.size());
        const std::string comma = number == 0 ? "" : ",";
        offsets_.push_back(binary_.size());
        views_ += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(binary_.size()) + R"(,"byteLength":)" +
                  std::to_string(bytes.size()) + "}";
        accessors_ += comma + R"({"bufferView":)" + std::to_string(number) + R"(,"componentType":)" +
                      std::to_string(componentType) + R"(,"count":)" + std::to_string(components / width) +
                      R"(,"type":")" + type + "\"" + (normalized ? R"(,"normalized":true)" : "") + "}";
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        while (binary_.size() % 4 != 0)
            binary_.push_back(std::byte{0});
        return number;
    }

    std::vector<size_t> offsets_;
    std::vector<std::byte> binary_;
    std::string views_;
    std::string accessors_;
};

/// An unskinned mesh over one set of attributes: accessors 0, its positions, and 1, its indices.
inline GltfBuilder plainMesh(const std::vector<float>& positions, const std::vector<uint32_t>& indices,
                             const std::string& primitiveMore = "") {
    GltfBuilder b;
    b.addFloats("VEC3", positions);
    b.addIntegers("SCALAR", 5125, indices);
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1)" + primitiveMore + "}]}]";
    return b;
}

/// One triangle, skinned to the nodes 1..`jointCount`; joints (16 bits each) and weights of its vertices, in sets of
/// four.
inline GltfBuilder skinnedTriangle(uint32_t jointCount, const std::vector<std::vector<uint32_t>>& joints,
                                   const std::vector<std::vector<float>>& weights) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    std::string attributes = R"("POSITION":0)";
    for (size_t n = 0; n < joints.size(); ++n) {
        attributes += ",\"JOINTS_" + std::to_string(n) + "\":" + std::to_string(b.addIntegers("VEC4", 5123, joints[n]));
        attributes += ",\"WEIGHTS_" + std::to_string(n) + "\":" + std::to_string(b.addFloats("VEC4", weights[n]));
    }
    b.meshes = R"([{"primitives":[{"attributes":{)" + attributes + "}}]}]";
    b.nodes = R"([{"mesh":0,"skin":0})";
    std::string list;
    for (uint32_t j = 1; j <= jointCount; ++j) {
        b.nodes += ",{}";
        list += (j == 1 ? "" : ",") + std::to_string(j);
    }
    b.nodes += "]";
    b.more = R"(,"skins":[{"joints":[)" + list + "]}]";
    return b;
}

/// A centre and a ring of four, in the xy plane.
inline const std::vector<float> kRing = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};

// Accessors of skinnedQuad(), in their order.
enum QuadAccessor { kPositions, kJoints, kWeights, kIndices, kInverseBinds, kTimes, kRotations, kTranslations, kUvs };

/// A quad of two triangles, two joints, one clip of two channels; right in every way.
inline GltfBuilder skinnedQuad() {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addIntegers("VEC4", 5121, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    b.addFloats("VEC4", {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0.75f, 0, 0, 0, 1, 0, 0});
    b.addIntegers("SCALAR", 5123, {0, 1, 2, 0, 2, 3});
    b.addFloats("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1, //
                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
    b.addFloats("SCALAR", {0, 1, 2});
    b.addFloats("VEC4", {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1});
    b.addFloats("VEC3", {0, 0, 0, 1, 2, 3, 0, 0, 0});
    b.addFloats("VEC2", {0, 0, 1, 0, 1, 1, 0, 1});
    b.nodes = R"([{"mesh":0,"skin":0},{"name":"root","children":[2]},{"name":"tip","translation":[1,0,0]}])";
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"TEXCOORD_0":8},)"
               R"("indices":3,"mode":4}]}])";
    b.more = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4}],"scenes":[{"nodes":[0,1]}],"scene":0)"
             R"(,"animations":[{"samplers":[{"input":5,"output":6},{"input":5,"output":7}],"channels":[)"
             R"({"sampler":0,"target":{"node":2,"path":"rotation"}},)"
             R"({"sampler":1,"target":{"node":2,"path":"translation"}}]}])";
    return b;
}

} // namespace supple::test
