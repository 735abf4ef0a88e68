#include "runtime/vertex_streams.h"

namespace supple::runtime {

namespace {

template <class F>
void forEachStream(F&& visit) {
    for (size_t s = 0; s < kStreamCount; ++s) {
        visit(static_cast<Stream>(s), kStreams[s]);
    }
}

} // namespace

StreamSet StreamSet::ofGroup(uint32_t groupFlags) {
    StreamSet set;
    forEachStream([&](Stream stream, const StreamRow& row) {
        if (row.groupFlag == 0 || (groupFlags & row.groupFlag) != 0) {
            set.add(stream);
        }
    });
    return set;
}

StreamSet StreamSet::ofView(uint32_t viewFlags) {
    StreamSet set;
    forEachStream([&](Stream stream, const StreamRow& row) {
        if (row.viewFlag == 0 || (viewFlags & row.viewFlag) != 0) {
            set.add(stream);
        }
    });
    return set;
}

uint32_t StreamSet::attributeOutputs() const {
    uint32_t outputs = 0;
    forEachStream([&](Stream stream, const StreamRow& row) { outputs |= has(stream) ? row.attribute : 0; });
    return outputs;
}

void StreamSet::keepAttributes(uint32_t present) {
    forEachStream([&](Stream stream, const StreamRow& row) {
        if (row.attribute != 0 && (present & row.attribute) == 0) {
            remove(stream);
        }
    });
}

void VertexStreams::plan(gpu::BufferPlan& plan, StreamSet set, SuppleVertexFormat format, VkDeviceSize vertices,
                         VkDeviceSize stride, uint32_t capacity, VkBufferUsageFlags usage) {
    set_ = set;
    format_ = format;
    forEachStream([&](Stream stream, const StreamRow& row) {
        const VkDeviceSize count = row.written == Written::perFrame ? stride * capacity : vertices;
        buffers_[static_cast<size_t>(stream)] =
            plan.add({row.name, set.has(stream) ? count * bytes(stream) : 0,
                      row.usage | (stream == Stream::vertices ? usage : 0),
                      stream == Stream::vertices ? gpu::MemoryPurpose::vertices : gpu::MemoryPurpose::streams});
    });
}

uint32_t VertexStreams::bytes(Stream stream) const {
    const uint32_t bytes = kStreams[static_cast<size_t>(stream)].bytes;
    return bytes != 0 ? bytes : vertexBytes(format_);
}

uint32_t VertexStreams::frameBytes() const {
    return bytes(Stream::vertices) + (has(Stream::tangents) ? bytes(Stream::tangents) : 0);
}

VkDeviceSize VertexStreams::staticBytes() const {
    VkDeviceSize sum = 0;
    forEachStream(
        [&](Stream stream, const StreamRow& row) { sum += row.written == Written::static_ ? size(stream) : 0; });
    return sum;
}

void VertexStreams::fill(SuppleVertexStreams& output) const {
    output.vertexFormat = format_;
    forEachStream([&](Stream stream, const StreamRow& row) {
        if (row.output != nullptr) {
            output.*row.output = {buffer(stream), 0, size(stream), bytes(stream)};
        }
    });
}

void VertexStreams::addTransfers(Transfers& transfers, bool statics) const {
    forEachStream([&](Stream stream, const StreamRow& row) {
        if (row.output != nullptr && (row.written == Written::perFrame || statics)) {
            transfers.add(buffer(stream));
        }
    });
}

} // namespace supple::runtime
