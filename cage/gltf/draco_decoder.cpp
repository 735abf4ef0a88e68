#include "cage/gltf/draco_decoder.h"

#include "cage/gltf/model.h"
#include "cage/limits.h"
#include "cage/message.h"
#include "cage/refusal.h"

#ifndef SUPPLE_WITHOUT_DRACO
#include <cstring>
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <memory>
#include <optional>
#include <utility>
#endif

namespace supple::cage::gltf {

#ifdef SUPPLE_WITHOUT_DRACO

bool canDecodeDraco() {
    return false;
}

DracoMesh decodeDracoMesh(std::span<const std::byte>, std::span<const DracoAttribute>, MemoryBudget&,
                          const std::string& element) {
    refuse(element, "this build of Supple reads no Draco-compressed files (SUPPLE_WITH_DRACO is off)");
}

#else

namespace {

// What the decoder has of each corner of a triangle, once and for each attribute that is cut along seams, and of each
// vertex for each attribute, beside the value and its integers: measured, and rounded up.
constexpr uint64_t kConnectivityBytes = 64;
constexpr uint64_t kSeamBytes = 16;
constexpr uint64_t kDecodedVertexBytes = 16;

/// What a mesh claims to have, as the beginning of its connectivity says.
struct Claims {
    uint64_t faces = 0;
    uint64_t points = 0;
    uint64_t seams = 0; ///< attributes with a connectivity of their own
};

/// Compares claims with what the file may take. The library has frames between these and whoever catches, so nothing
/// is thrown through it: what is refused is kept.
class Bounds {
public:
    Bounds(const MemoryBudget& memory, const std::string& element) : memory_(memory), element_(element) {}

    [[nodiscard]] bool allows(const std::optional<Claims>& claims) {
        return keep([&] {
            if (!claims) {
                refuse(element_, "its compressed bytes are damaged: no counts");
            }
            if (claims->faces > kMaxCorners / 3 || claims->points > kMaxVertices) {
                refuse(element_,
                       "more than " + std::to_string(kMaxCorners) + " corners or " + std::to_string(kMaxVertices) +
                           " vertices",
                       ErrorCode::limit);
            }
            connectivity_ = 3 * claims->faces * (kConnectivityBytes + kSeamBytes * claims->seams);
            memory_.check(connectivity_, element_);
        });
    }

    /// Before there are values.
    [[nodiscard]] bool allows(const draco::PointCloud& points) {
        return keep([&] {
            uint64_t each = 0;
            for (int i = 0; i < points.num_attributes(); ++i) {
                const draco::PointAttribute& attribute = *points.attribute(i);
                each += static_cast<uint64_t>(attribute.byte_stride()) + 4 * uint64_t{attribute.num_components()} +
                        kDecodedVertexBytes;
            }
            if (points.num_points() > kMaxVertices) {
                refuse(element_, "more than " + std::to_string(kMaxVertices) + " vertices", ErrorCode::limit);
            }
            memory_.check(connectivity_ + points.num_points() * each, element_);
        });
    }

    /// Throws what was refused, if anything was.
    void raise() const {
        if (refused_) {
            throw *refused_;
        }
    }

private:
    template <class Check>
    [[nodiscard]] bool keep(Check&& check) {
        try {
            check();
            return true;
        } catch (const Refusal& refusal) {
            refused_ = refusal;
            return false;
        }
    }

    const MemoryBudget& memory_;
    const std::string& element_;
    uint64_t connectivity_ = 0;
    std::optional<Refusal> refused_;
};

/// One of Draco's two decoders of meshes. Its library does not ask before it makes room for what a file claims.
template <class Decoder>
class BoundedDecoder : public Decoder {
public:
    explicit BoundedDecoder(Bounds& bounds) : bounds_(bounds) {}

protected:
    bool DecodeConnectivity() override { return bounds_.allows(claims()) && Decoder::DecodeConnectivity(); }
    /// All attributes are known then, and have no values yet.
    bool DecodeAllAttributes() override {
        return bounds_.allows(*this->point_cloud()) && Decoder::DecodeAllAttributes();
    }

private:
    std::optional<Claims> claims() {
        constexpr bool kIsSequential = std::is_same_v<Decoder, draco::MeshSequentialDecoder>;
        draco::DecoderBuffer ahead = *this->buffer();
        uint32_t first = 0, second = 0;
        uint8_t seams = 0;
        if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) {
            return std::nullopt;
        }
        if (kIsSequential) {
            return Claims{first, second, 0};
        }
        return ahead.Decode(&seams) ? std::optional(Claims{second, first, seams}) : std::nullopt;
    }

    Bounds& bounds_;
};

/// glTF allows one version of the bit stream.
draco::DracoHeader readHeader(std::span<const std::byte> bytes, const std::string& element) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) {
        refuse(element, "its compressed bytes are not Draco's");
    }
    if (header.version_major != draco::kDracoMeshBitstreamVersionMajor ||
        header.version_minor != draco::kDracoMeshBitstreamVersionMinor) {
        refuse(element, "version " + std::to_string(header.version_major) + "." + std::to_string(header.version_minor) +
                            " of Draco's bit stream; glTF has 2.2");
    }
    if (header.encoder_type != draco::TRIANGULAR_MESH) {
        refuse(element, "a point cloud: no triangles");
    }
    if (header.encoder_method != draco::MESH_SEQUENTIAL_ENCODING &&
        header.encoder_method != draco::MESH_EDGEBREAKER_ENCODING) {
        refuse(element, "an encoding that is not known");
    }
    return header;
}

std::unique_ptr<draco::Mesh> decode(std::span<const std::byte> bytes, bool isSequential, const MemoryBudget& memory,
                                    const std::string& element) {
    Bounds bounds(memory, element);
    std::unique_ptr<draco::MeshDecoder> decoder;
    if (isSequential) {
        decoder = std::make_unique<BoundedDecoder<draco::MeshSequentialDecoder>>(bounds);
    } else {
        decoder = std::make_unique<BoundedDecoder<draco::MeshEdgebreakerDecoder>>(bounds);
    }
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    auto mesh = std::make_unique<draco::Mesh>();
    const draco::Status status = decoder->Decode({}, &buffer, mesh.get());
    bounds.raise();
    if (!status.ok()) {
        refuse(element, "its compressed bytes are damaged");
    }
    return mesh;
}

template <class T>
void copyValues(const draco::PointAttribute& from, size_t count, const DracoAttribute& wanted,
                const std::string& element, std::vector<std::byte>& values) {
    const auto components = static_cast<int8_t>(wanted.components);
    const auto stride = static_cast<uint64_t>(from.byte_stride());
    const uint64_t present = stride == 0 ? 0 : from.buffer()->data_size() / stride;
    T value[16];
    for (size_t i = 0; i < count; ++i) {
        const draco::AttributeValueIndex index = from.mapped_index(draco::PointIndex(static_cast<uint32_t>(i)));
        if (index.value() >= present || !from.ConvertValue<T>(index, components, value)) {
            refuse(element, item(wanted.name, i) + " is damaged or does not fit its accessor's component type");
        }
        std::memcpy(&values[i * wanted.components * sizeof(T)], value, wanted.components * sizeof(T));
    }
}

std::vector<std::byte> valuesOf(const draco::Mesh& mesh, const DracoAttribute& wanted, MemoryBudget& memory,
                                const std::string& element) {
    const draco::PointAttribute* from = mesh.GetAttributeByUniqueId(wanted.id);
    if (from == nullptr) {
        refuse(element, wanted.name + ": no attribute " + std::to_string(wanted.id) + " among the compressed ones");
    }
    if (from->num_components() != static_cast<int>(wanted.components)) {
        refuse(element, wanted.name + ": " + std::to_string(from->num_components()) +
                            " components are compressed, its accessor has " + std::to_string(wanted.components));
    }
    const size_t count = mesh.num_points();
    if (!from->is_mapping_identity() && from->indices_map_size() < count) {
        refuse(element, "its compressed bytes are damaged: " + wanted.name);
    }
    const size_t size = wanted.components * file::componentSize(wanted.componentType);
    memory.take(count, size, element);
    std::vector<std::byte> values(count * size);
    const auto copy = [&]<class T>(T) { copyValues<T>(*from, count, wanted, element, values); };
    switch (wanted.componentType) {
    case file::kByte:
        copy(int8_t{});
        break;
    case file::kUnsignedByte:
        copy(uint8_t{});
        break;
    case file::kShort:
        copy(int16_t{});
        break;
    case file::kUnsignedShort:
        copy(uint16_t{});
        break;
    case file::kUnsignedInt:
        copy(uint32_t{});
        break;
    default:
        copy(float{});
        break;
    }
    return values;
}

} // namespace

bool canDecodeDraco() {
    return true;
}

DracoMesh decodeDracoMesh(std::span<const std::byte> bytes, std::span<const DracoAttribute> wanted,
                          MemoryBudget& memory, const std::string& element) {
    DracoMesh decoded;
    decoded.keepsOrder = readHeader(bytes, element).encoder_method == draco::MESH_SEQUENTIAL_ENCODING;
    const std::unique_ptr<draco::Mesh> mesh = decode(bytes, decoded.keepsOrder, memory, element);
    decoded.vertexCount = mesh->num_points();
    if (decoded.vertexCount == 0 || mesh->num_faces() == 0) {
        refuse(element, "no triangles");
    }
    memory.take(mesh->num_faces(), 3 * sizeof(uint32_t), element);
    decoded.indices.reserve(size_t{3} * mesh->num_faces());
    for (uint32_t f = 0; f < mesh->num_faces(); ++f) {
        for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) {
            if (corner.value() >= decoded.vertexCount) {
                refuse(element, "its compressed bytes are damaged: " + at("triangle", f));
            }
            decoded.indices.push_back(corner.value());
        }
    }
    for (const DracoAttribute& attribute : wanted) {
        decoded.attributes.push_back(valuesOf(*mesh, attribute, memory, element));
    }
    return decoded;
}

#endif

} // namespace supple::cage::gltf
