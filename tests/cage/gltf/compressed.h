// Files of builder.h, compressed by meshoptimizer's own encoders.
#pragma once

#include "tests/cage/gltf/builder.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace supple::test {

inline size_t binaryOffset(const std::vector<std::byte>& glb) {
    uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    return 28 + size_t{length};
}

inline nlohmann::json jsonOf(const std::vector<std::byte>& glb) {
    const char* text = reinterpret_cast<const char*>(glb.data());
    return nlohmann::json::parse(text + 20, text + binaryOffset(glb) - 8);
}

/// A GLB with its JSON changed.
inline std::vector<std::byte> changed(const std::vector<std::byte>& glb,
                                      const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json root = jsonOf(glb);
    change(root);
    return packGlb(root.dump(), {glb.begin() + static_cast<ptrdiff_t>(binaryOffset(glb)), glb.end()});
}

struct Compression {
    bool tagPlaceholder = true;        ///< the buffer that is not there says so
    std::string placeholderUri = "";   ///< or is there
    int plainView = -1;                ///< a bufferView left uncompressed
    bool sequences = false;            ///< indices as such, and not as triangles
    std::vector<int> exponential = {}; ///< accessors of floats for that filter
    std::vector<int> quaternions = {}; ///< accessors of float quaternions, which become 16-bit integers
};

/// All bufferViews compressed; the uncompressed buffer becomes a placeholder.
inline std::vector<std::byte> compressed(const GltfBuilder& builder, const std::string& extension,
                                         const Compression& how = {}) {
    nlohmann::json root = nlohmann::json::parse(builder.json());
    const std::vector<std::byte>& source = builder.binary();
    std::vector<std::byte> packed;
    const auto has = [](const std::vector<int>& list, size_t value) {
        return std::find(list.begin(), list.end(), static_cast<int>(value)) != list.end();
    };
    for (size_t i = 0; i < root["accessors"].size(); ++i) { // one bufferView each
        nlohmann::json& accessor = root["accessors"][i];
        nlohmann::json& view = root["bufferViews"][i];
        const std::map<std::string, size_t> widths{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        const auto count = accessor["count"].get<size_t>();
        const size_t width = widths.at(accessor["type"]);
        const int componentType = accessor["componentType"];
        size_t stride = width * (componentType <= 5121 ? 1 : componentType <= 5123 ? 2 : 4);
        const std::byte* from = source.data() + view["byteOffset"].get<size_t>();
        std::vector<std::byte> elements(from, from + count * stride);
        const auto* floats = reinterpret_cast<const float*>(from);
        std::string filter = "NONE";
        if (has(how.exponential, i)) {
            filter = "EXPONENTIAL";
            meshopt_encodeFilterExp(elements.data(), count, stride, 24, floats);
        } else if (has(how.quaternions, i)) {
            filter = "QUATERNION";
            stride = 8;
            elements.resize(count * stride);
            meshopt_encodeFilterQuat(elements.data(), count, stride, 16, floats);
            accessor["componentType"] = 5122;
            accessor["normalized"] = true;
            view["byteLength"] = count * stride;
        }
        view["buffer"] = 1;
        if (static_cast<int>(i) == how.plainView) {
            continue;
        }
        std::string mode = "ATTRIBUTES";
        std::vector<unsigned char> bytes;
        size_t length = 0;
        if (stride == 2 || (width == 1 && componentType == 5125)) {
            std::vector<unsigned> indices(count);
            for (size_t k = 0; k < count; ++k) {
                std::memcpy(&indices[k], elements.data() + k * stride, stride);
            }
            mode = how.sequences || count % 3 != 0 ? "INDICES" : "TRIANGLES";
            const size_t vertexCount = *std::max_element(indices.begin(), indices.end()) + size_t{1};
            bytes.resize(mode == "INDICES" ? meshopt_encodeIndexSequenceBound(count, vertexCount)
                                           : meshopt_encodeIndexBufferBound(count, vertexCount));
            length = mode == "INDICES" ? meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), count)
                                       : meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), count);
        } else {
            bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
            length = meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), elements.data(), count, stride);
        }
        view["extensions"][extension] = {{"buffer", 0},          {"byteOffset", packed.size()},
                                         {"byteLength", length}, {"byteStride", stride},
                                         {"count", count},       {"mode", mode},
                                         {"filter", filter}};
        const auto* encoded = reinterpret_cast<const std::byte*>(bytes.data());
        packed.insert(packed.end(), encoded, encoded + length);
        packed.resize((packed.size() + 3) / 4 * 4);
    }
    nlohmann::json placeholder = {{"byteLength", source.size()}};
    if (how.tagPlaceholder) {
        placeholder["extensions"][extension] = {{"fallback", true}};
    }
    if (!how.placeholderUri.empty()) {
        placeholder["uri"] = how.placeholderUri;
    }
    root["buffers"] = {{{"byteLength", packed.size()}}, placeholder};
    root["extensionsUsed"].push_back(extension);
    if (how.placeholderUri.empty()) {
        root["extensionsRequired"].push_back(extension);
    }
    return packGlb(root.dump(), packed);
}

} // namespace supple::test
