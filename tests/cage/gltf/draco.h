// Files of builder.h, compressed by Draco's own encoder.
#pragma once

#include "tests/cage/gltf/compressed.h"

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>

namespace supple::test {

struct DracoCompression {
    bool sequential = false; ///< vertices and triangles keep their order
    bool fallback = false;   ///< accessors keep their bufferViews
    int positionBits = 14;
    uint32_t strideAttributes = 0; ///< so many attributes more that nobody asks for
    std::string apart;             ///< an attribute that is not compressed
};

namespace draco_detail {

inline draco::GeometryAttribute::Type typeOf(const std::string& name) {
    return name == "POSITION"             ? draco::GeometryAttribute::POSITION
           : name == "NORMAL"             ? draco::GeometryAttribute::NORMAL
           : name.starts_with("TEXCOORD") ? draco::GeometryAttribute::TEX_COORD
                                          : draco::GeometryAttribute::GENERIC;
}

inline draco::DataType dataTypeOf(int componentType) {
    return componentType == 5126   ? draco::DT_FLOAT32
           : componentType == 5125 ? draco::DT_UINT32
           : componentType == 5123 ? draco::DT_UINT16
                                   : draco::DT_UINT8;
}

/// Adds a vertex attribute; returns its unique number.
inline uint32_t addAttribute(draco::Mesh& mesh, const std::string& name, const nlohmann::json& accessor,
                             const std::byte* bytes) {
    const std::map<std::string, int8_t> widths{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const int8_t width = widths.at(accessor["type"]);
    const draco::DataType type = dataTypeOf(accessor["componentType"]);
    const auto count = accessor["count"].get<uint32_t>();
    const int64_t stride = width * draco::DataTypeLength(type);
    draco::GeometryAttribute attribute;
    attribute.Init(typeOf(name), nullptr, static_cast<uint8_t>(width), type, false, stride, 0);
    mesh.set_num_points(count);
    const int id = mesh.AddAttribute(attribute, true, count);
    for (uint32_t i = 0; i < count; ++i) {
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), bytes + i * stride);
    }
    return mesh.attribute(id)->unique_id();
}

} // namespace draco_detail

/// Every primitive compressed. They must have indices.
inline std::vector<std::byte> dracoCompressed(const GltfBuilder& builder, const DracoCompression& how = {}) {
    nlohmann::json root = nlohmann::json::parse(builder.json());
    std::vector<std::byte> binary = builder.binary();
    const auto bytesOf = [&](const nlohmann::json& accessor) {
        return builder.binary().data() +
               root["bufferViews"][accessor["bufferView"].get<size_t>()].value("byteOffset", 0);
    };
    std::vector<size_t> compressed;
    for (nlohmann::json& mesh : root["meshes"]) {
        for (nlohmann::json& primitive : mesh["primitives"]) {
            draco::Mesh encoded;
            nlohmann::json numbers;
            for (const auto& [name, index] : primitive["attributes"].items()) {
                if (name == how.apart) {
                    continue;
                }
                const nlohmann::json& accessor = root["accessors"][index.get<size_t>()];
                numbers[name] = draco_detail::addAttribute(encoded, name, accessor, bytesOf(accessor));
                compressed.push_back(index);
            }
            const nlohmann::json& position = root["accessors"][primitive["attributes"]["POSITION"].get<size_t>()];
            for (uint32_t i = 0; i < how.strideAttributes; ++i) {
                draco_detail::addAttribute(encoded, "_MORE", position, bytesOf(position));
            }
            const nlohmann::json& indices = root["accessors"][primitive["indices"].get<size_t>()];
            compressed.push_back(primitive["indices"]);
            for (size_t i = 0; i < indices["count"]; i += 3) {
                draco::Mesh::Face face;
                for (size_t c = 0; c < 3; ++c) {
                    const size_t size = indices["componentType"] == 5123 ? 2 : 4;
                    uint32_t index = 0;
                    std::memcpy(&index, bytesOf(indices) + (i + c) * size, size);
                    face[c] = index;
                }
                encoded.AddFace(face);
            }
            draco::Encoder encoder;
            encoder.SetEncodingMethod(how.sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                     : draco::MESH_EDGEBREAKER_ENCODING);
            encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, how.positionBits);
            encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
            encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
            draco::EncoderBuffer buffer;
            EXPECT_TRUE(encoder.EncodeMeshToBuffer(encoded, &buffer).ok());
            const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
            primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", root["bufferViews"].size()},
                                                                     {"attributes", numbers}};
            root["bufferViews"].push_back(
                {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", buffer.size()}});
            binary.insert(binary.end(), data, data + buffer.size());
            binary.resize((binary.size() + 3) / 4 * 4);
        }
    }
    for (const size_t accessor : compressed) {
        if (!how.fallback) {
            root["accessors"][accessor].erase("bufferView");
        }
    }
    root["buffers"][0]["byteLength"] = binary.size();
    root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    if (!how.fallback) {
        root["extensionsRequired"] = root["extensionsUsed"];
    }
    return packGlb(root.dump(), binary);
}

} // namespace supple::test
