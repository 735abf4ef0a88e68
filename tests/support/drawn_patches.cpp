#include "tests/support/drawn_patches.h"

#include <array>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {

namespace {

class Reader {
public:
    Reader(const Crowd& crowd, uint32_t surface)
        : crowd_(crowd), output_(crowd.output(surface)), commands_(crowd.draws(surface)),
          words_(as<uint32_t>(crowd.read(output_.streams.vertices))) {
        if (output_.streams.previousPositions.buffer != VK_NULL_HANDLE) {
            previous_ = as<uint32_t>(crowd.read(output_.streams.previousPositions));
        }
        const std::vector<std::byte> bytes = crowd.read(output_.indices());
        if (output_.indices().stride == 4) {
            indices_ = as<uint32_t>(bytes);
        } else {
            const std::vector<uint16_t> halves = as<uint16_t>(bytes);
            indices_.assign(halves.begin(), halves.end());
        }
    }

    [[nodiscard]] DrawnPatches read() {
        if (output_.hasLevels()) {
            readLevels();
        }
        for (uint32_t r = 0; r < output_.grid.rateCount; ++r) {
            readRate(r);
        }
        return std::move(drawn_);
    }

private:
    void addVertex(DrawnCorners& corners, size_t vertex) const {
        const size_t stride = output_.streams.vertices.stride / 4;
        ASSERT_LE((vertex + 1) * stride, words_.size());
        for (size_t k = 0; k < stride; ++k) {
            corners.push_back(words_[vertex * stride + k]);
        }
        for (size_t k = 0; k < 3 && !previous_.empty(); ++k) {
            corners.push_back(previous_[3 * vertex + k]);
        }
    }

    void readRate(uint32_t r) {
        const SuppleGridOutput& grid = output_.grid;
        const SuppleRate& rate = grid.rates[r];
        const std::vector<uint32_t> list = as<uint32_t>(crowd_.read(rate.instances));
        for (uint32_t d = 0; d < rate.drawRangeCount; ++d) {
            for (uint32_t w = 0; size_t{w} * grid.drawRangeCount < commands_.size(); ++w) {
                readCommand(r, d, w, list);
            }
        }
    }

    /// The command of a draw range in a window.
    void readCommand(uint32_t r, uint32_t d, uint32_t window, const std::vector<uint32_t>& list) {
        const SuppleGridOutput& grid = output_.grid;
        const uint32_t index = grid.rates[r].firstDrawRange + d, firstSlot = window * output_.info.windowSize;
        const bool cut = commands_.size() > grid.drawRangeCount;
        const SuppleDrawRange& range = grid.drawRanges[index];
        const VkDrawIndexedIndirectCommand& command = commands_[size_t{window} * grid.drawRangeCount + index];
        ASSERT_EQ(command.indexCount, range.indexCount);
        ASSERT_EQ(command.firstIndex, range.firstIndex);
        ASSERT_EQ(command.vertexOffset, 0);
        for (uint32_t n = 0; n < command.instanceCount; ++n) {
            // As shaders/supple_surface.glsl does.
            const uint32_t i = command.firstInstance + n, entry = firstSlot + i / range.patchCount;
            ASSERT_LT(entry, list.size());
            const uint32_t slot = list[entry], own = i % range.patchCount;
            ASSERT_LT(slot, output_.info.capacity);
            ASSERT_GE(slot, firstSlot);
            ASSERT_TRUE(!cut || slot < firstSlot + output_.info.windowSize) << "not bound with this window";
            const bool mesh = range.domain == SUPPLE_DOMAIN_MESH;
            DrawnCorners& corners = drawn_[{slot, r, mesh ? d : range.firstPatch + own}];
            ASSERT_TRUE(corners.empty()) << "drawn twice: slot " << slot << ", range " << d << ", patch " << own;
            for (uint32_t k = 0; k < command.indexCount; ++k) {
                addVertex(corners, size_t{slot} * grid.verticesPerInstance + range.firstVertex +
                                       own * range.samplesPerPatch + indices_[command.firstIndex + k]);
            }
        }
    }

    void readLevels() {
        const auto buckets = as<std::array<uint32_t, 4>>(crowd_.read(output_.levels.buckets));
        const auto records = as<std::array<uint32_t, 16>>(crowd_.read(output_.levels.patches));
        std::vector<bool> seen(records.size());
        for (uint32_t d = 0; d < output_.levels.drawCount; ++d) {
            const SuppleLevelDraw& draw = output_.levels.draws[d];
            const VkDrawIndexedIndirectCommand& command = commands_[d];
            for (uint32_t n = 0; n < command.instanceCount; ++n) {
                for (uint32_t k = 0; k < command.indexCount; ++k) {
                    const uint32_t vertex = static_cast<uint32_t>(command.vertexOffset) + n * draw.verticesPerInstance +
                                            indices_[command.firstIndex + k];
                    const auto& record = records[buckets[d][0] + (vertex - buckets[d][1]) / draw.samplesPerPatch];
                    if (record[0] == 0xFFFFFFFFu) {
                        continue; // an empty record: its triangles are points
                    }
                    DrawnCorners& corners = drawn_[{record[1] & 0x0FFFFFFFu, 0, record[0]}];
                    addVertex(corners, vertex);
                    corners.push_back(draw.capacity);
                }
            }
        }
    }

    const Crowd& crowd_;
    host::GroupOutput output_;
    std::vector<VkDrawIndexedIndirectCommand> commands_;
    std::vector<uint32_t> words_, previous_, indices_;
    DrawnPatches drawn_;
};

} // namespace

DrawnPatches drawnPatches(const Crowd& crowd, uint32_t surface) {
    return Reader(crowd, surface).read();
}

std::vector<uint32_t> partsOfKeys(const Crowd& crowd, SuppleAsset asset, uint32_t surface) {
    const host::GroupOutput output = crowd.output(surface);
    std::vector<uint32_t> parts;
    if (!output.hasLevels() && output.grid.drawRanges[0].domain == SUPPLE_DOMAIN_MESH) {
        for (uint32_t d = 0; d < output.grid.drawRangeCount; ++d) {
            parts.push_back(output.grid.drawRanges[d].part);
        }
        return parts;
    }
    const SuppleContext context = crowd.context().handle();
    uint32_t count = output.surface.patchCount;
    std::vector<SupplePatchInfo> patches(count);
    EXPECT_EQ(suppleGetPatches(context, crowd.group(), surface, patches.data(), &count), SUPPLE_OK);
    SuppleAssetInfo info{};
    info.structSize = sizeof(info);
    EXPECT_EQ(suppleGetAssetInfo(context, asset, &info), SUPPLE_OK);
    for (const SupplePatchInfo& patch : patches) {
        uint32_t own = ~0u;
        for (uint32_t p = 0; p < info.partCount; ++p) {
            SupplePartInfo part{};
            part.structSize = sizeof(part);
            EXPECT_EQ(suppleGetPartInfo(context, asset, p, &part), SUPPLE_OK);
            own = patch.face >= part.firstFace && patch.face < part.firstFace + part.faceCount ? p : own;
        }
        parts.push_back(own);
    }
    return parts;
}

} // namespace supple::test
