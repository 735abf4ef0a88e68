// The streams of surface vertices: what a sample carries, one row a stream.
#pragma once

#include "gpu/buffer_plan.h"
#include "runtime/transfers.h"
#include "shaders/shared/surface.h"
#include "supple/supple.h"

#include <array>
#include <cstdint>

namespace supple::runtime {

enum class Stream : uint32_t { vertices, previousPositions, tangents, attributes, uvs1, faceUvs, directions, count };
inline constexpr size_t kStreamCount = static_cast<size_t>(Stream::count);

/// When a stream is written.
enum class Written : uint32_t {
    perFrame, ///< by evaluate or motion: a run of vertices per instance
    static_   ///< by attributes: instances of a group share one run
};

struct StreamRow {
    const char* name; ///< for debuggers and messages
    uint32_t bytes;   ///< per surface vertex; 0: by vertex format
    VkBufferUsageFlags usage;
    Written written;    ///< in groups; a view's streams are all written in every frame
    uint32_t groupFlag; ///< SuppleGroupFlags that ask for it; 0: always there
    uint32_t viewFlag;  ///< SuppleViewFlags
    uint32_t binding;   ///< shaders/shared/surface.h
    uint32_t attribute; ///< shared::kOutput..., if only cages that have it fill the stream; else 0
    SuppleBufferRange SuppleVertexStreams::*output; ///< null: hosts do not see it
};
/// What hosts may do with streams: draw, read and copy them.
inline constexpr VkBufferUsageFlags kStreamUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                   VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
/// To add a stream, add a row, the binding, the member of the output, and the shader that writes it
/// (docs/architecture.md).
inline constexpr StreamRow kStreams[kStreamCount] = {
    {"supple surface vertices", 0, kStreamUsage, Written::perFrame, 0, 0, shared::kSurfaceBinding, 0,
     &SuppleVertexStreams::vertices},
    {"supple previous positions", 12, kStreamUsage, Written::perFrame, SUPPLE_GROUP_MOTION, SUPPLE_VIEW_MOTION,
     shared::kSurfaceBinding, 0, &SuppleVertexStreams::previousPositions},
    {"supple tangents", 4, kStreamUsage, Written::perFrame, SUPPLE_GROUP_TANGENTS, SUPPLE_VIEW_TANGENTS,
     shared::kTangentBinding, 0, &SuppleVertexStreams::tangents},
    {"supple surface attributes", 16, kStreamUsage, Written::static_, SUPPLE_GROUP_ATTRIBUTES, SUPPLE_VIEW_ATTRIBUTES,
     shared::kAttributeBinding, 0, &SuppleVertexStreams::attributes},
    {"supple second UV set", 8, kStreamUsage, Written::static_, SUPPLE_GROUP_ATTRIBUTES, SUPPLE_VIEW_UVS1,
     shared::kUv1Binding, shared::kOutputUvs1, &SuppleVertexStreams::uvs1},
    {"supple face UVs", 8, kStreamUsage, Written::static_, SUPPLE_GROUP_ATTRIBUTES, SUPPLE_VIEW_FACE_UVS,
     shared::kFaceUvBinding, shared::kOutputFaceUvs, &SuppleVertexStreams::faceUvs},
    {"supple tangent directions", 4, kStreamUsage, Written::static_, SUPPLE_GROUP_TANGENTS, SUPPLE_VIEW_TANGENTS,
     shared::kDirectionOutputBinding, shared::kOutputDirections, nullptr},
};

/// The flags that ask for streams: all of SuppleGroupFlags, or of SuppleViewFlags.
[[nodiscard]] constexpr uint32_t streamFlags(uint32_t StreamRow::*flag) {
    uint32_t flags = 0;
    for (const StreamRow& row : kStreams) {
        flags |= row.*flag;
    }
    return flags;
}

/// Which streams there are: a bit per stream.
class StreamSet {
public:
    [[nodiscard]] static StreamSet ofGroup(uint32_t groupFlags);
    [[nodiscard]] static StreamSet ofView(uint32_t viewFlags);

    [[nodiscard]] bool has(Stream stream) const { return (bits_ >> static_cast<uint32_t>(stream) & 1u) != 0; }
    void remove(Stream stream) { bits_ &= ~(1u << static_cast<uint32_t>(stream)); }
    /// The attributes beside the first that are wanted: shared::kOutput... bits.
    [[nodiscard]] uint32_t attributeOutputs() const;
    /// Takes out the streams that need an attribute which is not in `present` (shared::kOutput... bits).
    void keepAttributes(uint32_t present);

private:
    void add(Stream stream) { bits_ |= 1u << static_cast<uint32_t>(stream); }
    uint32_t bits_ = 0;
};

/// Bytes of a surface vertex.
[[nodiscard]] constexpr uint32_t vertexBytes(SuppleVertexFormat format) {
    return format == SUPPLE_VERTEX_24 ? 24 : format == SUPPLE_VERTEX_12 ? 12 : 16;
}

/// The buffers of the streams. Their owner is a group, or a view for all its groups with levels.
class VertexStreams {
public:
    /// `vertices`: of an instance, without padding; `stride`: with it. A view is one instance.
    /// `usage`: what the surface vertices have beside the usage of their row.
    void plan(gpu::BufferPlan& plan, StreamSet set, SuppleVertexFormat format, VkDeviceSize vertices,
              VkDeviceSize stride, uint32_t capacity, VkBufferUsageFlags usage = 0);

    [[nodiscard]] const StreamSet& set() const { return set_; }
    [[nodiscard]] bool has(Stream stream) const { return set_.has(stream); }
    [[nodiscard]] VkBuffer buffer(Stream stream) const { return buffers_[static_cast<size_t>(stream)].buffer(); }
    [[nodiscard]] VkDeviceSize size(Stream stream) const { return buffers_[static_cast<size_t>(stream)].size(); }
    [[nodiscard]] uint32_t bytes(Stream stream) const; ///< per surface vertex
    [[nodiscard]] uint32_t frameBytes() const;         ///< that evaluation writes per surface vertex
    [[nodiscard]] VkDeviceSize staticBytes() const;    ///< of all streams that are Written::static_

    void fill(SuppleVertexStreams& output) const;
    /// Those that are written in every frame, and with `statics` the others.
    void addTransfers(Transfers& transfers, bool statics) const;

private:
    StreamSet set_;
    SuppleVertexFormat format_ = SUPPLE_VERTEX_16;
    std::array<gpu::PlannedBuffer, kStreamCount> buffers_;
};

} // namespace supple::runtime
