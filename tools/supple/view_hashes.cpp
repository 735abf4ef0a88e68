#include "tools/supple/view_hashes.h"

#include "host/group_output.h"
#include "tools/common/word_hash.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <span>
#include <vector>

namespace supple::tools {
namespace {

/// Group; slot; patch; capacity or rate; hash of the levels; hash of the vertices.
using Line = std::array<uint64_t, 6>;

struct Stream {
    std::vector<std::byte> bytes;
    uint32_t stride = 0;
};

class ViewReader {
public:
    ViewReader(host::Device& device, const host::GroupOutput& output, uint64_t group, std::vector<Line>& lines)
        : device_(device), output_(output), group_(group), lines_(lines) {}

    Status read() {
        for (const SuppleBufferRange& view : {output_.streams.vertices, output_.streams.previousPositions}) {
            if (view.buffer == VK_NULL_HANDLE) {
                continue;
            }
            Result<std::vector<std::byte>> bytes = device_.readBuffer(view);
            if (!bytes) {
                return bytes.error();
            }
            streams_.push_back({std::move(*bytes), view.stride});
        }
        return output_.levels.drawCount > 0 ? readPatches() : readRates();
    }

private:
    template <class T>
    Result<std::vector<T>> elements(const SuppleBufferRange& view) {
        const Result<std::vector<std::byte>> bytes = device_.readBuffer(view);
        if (!bytes) {
            return bytes.error();
        }
        std::vector<T> values(bytes->size() / sizeof(T));
        std::memcpy(values.data(), bytes->data(), values.size() * sizeof(T));
        return values;
    }

    void addVertices(WordHash& hash, size_t first, size_t count) const {
        for (const Stream& stream : streams_) {
            hash.add(std::span(stream.bytes).subspan(first * stream.stride, count * stream.stride));
        }
    }

    Status readPatches() {
        using Bucket = std::array<uint32_t, 4>;
        using Record = std::array<uint32_t, 16>; // patch, slot, first vertex, -, levels
        const Result<std::vector<Bucket>> buckets = elements<Bucket>(output_.levels.buckets);
        const Result<std::vector<Record>> records = elements<Record>(output_.levels.patches);
        if (!buckets || !records) {
            return buckets ? records.error() : buckets.error();
        }
        for (uint32_t draw = 0; draw < output_.levels.drawCount; ++draw) {
            const auto [firstPatch, firstVertex, patchCount, unused] = (*buckets)[draw];
            for (uint32_t i = 0; i < patchCount; ++i) {
                const Record& record = (*records)[firstPatch + i];
                WordHash levels, vertices;
                levels.add(std::as_bytes(std::span(record).subspan(4)));
                addVertices(vertices, record[2], output_.levels.draws[draw].samplesPerPatch);
                lines_.push_back({group_, record[1] & 0x0FFFFFFFu, record[0], output_.levels.draws[draw].capacity,
                                  levels.value(), vertices.value()});
            }
        }
        return success();
    }

    Status readRates() {
        const Result<std::vector<VkDrawIndexedIndirectCommand>> commands =
            elements<VkDrawIndexedIndirectCommand>(output_.indirect());
        if (!commands) {
            return commands.error();
        }
        for (uint32_t r = 0; r < output_.grid.rateCount; ++r) {
            const SuppleRate& rate = output_.grid.rates[r];
            const Result<std::vector<uint32_t>> slots = elements<uint32_t>(rate.instances);
            if (!slots) {
                return slots.error();
            }
            const uint32_t patches = output_.grid.drawRanges[rate.firstDrawRange].patchCount;
            const uint32_t instances = (*commands)[rate.firstDrawRange].instanceCount / patches;
            for (uint32_t i = 0; i < instances; ++i) {
                const size_t base = size_t{(*slots)[i]} * output_.grid.verticesPerInstance;
                WordHash vertices;
                for (uint32_t d = 0; d < rate.drawRangeCount; ++d) {
                    const SuppleDrawRange& range = output_.grid.drawRanges[rate.firstDrawRange + d];
                    addVertices(vertices, base + range.firstVertex, size_t{range.patchCount} * range.samplesPerPatch);
                }
                lines_.push_back({group_, (*slots)[i], 0, rate.rate, 0, vertices.value()});
            }
        }
        return success();
    }

    host::Device& device_;
    const host::GroupOutput& output_;
    uint64_t group_;
    std::vector<Line>& lines_;
    std::vector<Stream> streams_;
};

} // namespace

Result<std::string> hashView(host::Context& context, std::span<const SuppleGroup> groups) {
    std::vector<Line> lines;
    for (size_t group = 0; group < groups.size(); ++group) {
        uint32_t count = 1;
        for (uint32_t surface = 0; surface < count; ++surface) {
            host::GroupOutput output{};
            const SuppleResult result = host::getGroupOutput(context.handle(), groups[group], output, surface);
            Status status = context.check(result, "suppleGetGroupInfo");
            count = output.info.surfaceCount;
            if (status) {
                status = ViewReader(context.device(), output, group, lines).read();
            }
            if (!status) {
                return status.error();
            }
        }
    }
    std::sort(lines.begin(), lines.end());
    std::string text;
    for (const Line& line : lines) {
        char row[160];
        std::snprintf(row, sizeof row,
                      "group %llu slot %llu patch %llu segments %llu levels %016llx vertices %016llx\n",
                      static_cast<unsigned long long>(line[0]), static_cast<unsigned long long>(line[1]),
                      static_cast<unsigned long long>(line[2]), static_cast<unsigned long long>(line[3]),
                      static_cast<unsigned long long>(line[4]), static_cast<unsigned long long>(line[5]));
        text += row;
    }
    return text;
}

} // namespace supple::tools
