#include "tests/support/lod_surface.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace supple::test {

namespace {

template <class T>
std::vector<T> as(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) {
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    }
    return values;
}

PositionBits positionsOf(const std::vector<std::byte>& bytes, size_t stride) {
    PositionBits bits(stride > 0 ? bytes.size() / stride : 0);
    for (size_t v = 0; v < bits.size(); ++v) {
        std::memcpy(&bits[v], bytes.data() + v * stride, sizeof(bits[v]));
    }
    return bits;
}

} // namespace

LodSurface readLodSurface(const Crowd& crowd) {
    const SuppleGroupOutput output = crowd.output();
    LodSurface surface;
    surface.positions = positionsOf(crowd.read(output.surfaceVertices), output.surfaceVertices.stride);
    surface.previous = positionsOf(crowd.read(output.previousPositions), output.previousPositions.stride);
    const auto indices = as<uint16_t>(crowd.read(output.gridIndices));
    const auto commands = as<VkDrawIndexedIndirectCommand>(crowd.read(output.indirect));
    const auto buckets = as<std::array<uint32_t, 4>>(crowd.read(output.lodBuckets));
    const auto records = as<std::array<uint32_t, 16>>(crowd.read(output.lodPatches));
    EXPECT_EQ(commands.size(), output.lodDrawCount);
    for (size_t d = 0; d < commands.size(); ++d) {
        const VkDrawIndexedIndirectCommand& command = commands[d];
        const SuppleLodDraw& draw = output.lodDraws[d];
        for (uint32_t i = 0; i < command.instanceCount; ++i) {
            const uint32_t base = static_cast<uint32_t>(command.vertexOffset) + i * draw.verticesPerInstance;
            for (uint32_t k = 0; k < command.indexCount; k += 3) {
                const uint16_t* index = &indices[command.firstIndex + k];
                surface.triangles.push_back({base + index[0], base + index[1], base + index[2]});
            }
        }
        for (uint32_t p = 0; p < buckets[d][2]; ++p) {
            const std::array<uint32_t, 16>& record = records[buckets[d][0] + p];
            LodSurface::Patch& patch = surface.patches.emplace_back();
            patch.patch = record[0];
            patch.slot = record[1] & 0x0FFFFFFFu;
            patch.firstVertex = record[2];
            patch.capacity = draw.capacity;
            patch.grid = draw.grid;
            std::memcpy(patch.levels.data(), &record[4], sizeof(patch.levels));
            EXPECT_EQ(patch.firstVertex, buckets[d][1] + p * draw.samplesPerPatch);
        }
    }
    return surface;
}

Sides matchSides(const LodSurface& surface) {
    std::map<std::array<uint32_t, 3>, uint32_t> ids;
    std::vector<uint32_t> idOf(surface.positions.size());
    for (const auto& triangle : surface.triangles) {
        for (const uint32_t v : triangle) {
            idOf[v] = ids.try_emplace(surface.positions[v], static_cast<uint32_t>(ids.size())).first->second;
        }
    }
    Sides sides;
    std::map<std::pair<uint32_t, uint32_t>, int64_t> counts; // of a side less that of its opposite
    for (const auto& triangle : surface.triangles) {
        const uint32_t v[3] = {idOf[triangle[0]], idOf[triangle[1]], idOf[triangle[2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
            continue;
        }
        ++sides.triangles;
        for (int i = 0; i < 3; ++i) {
            const uint32_t a = v[i], b = v[(i + 1) % 3];
            counts[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    std::vector<uint32_t> parent(ids.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t x) {
        while (parent[x] != x) {
            x = parent[x] = parent[parent[x]];
        }
        return x;
    };
    std::map<uint32_t, int64_t> balance;
    for (const auto& [side, count] : counts) {
        if (count != 0) {
            sides.unmatched += static_cast<size_t>(std::abs(count));
            balance[side.first] += count;
            balance[side.second] -= count;
            parent[root(side.first)] = root(side.second);
        }
    }
    for (const auto& [vertex, sum] : balance) {
        sides.looseEnds += sum != 0 ? 1 : 0;
        sides.loops += root(vertex) == vertex ? 1 : 0;
    }
    return sides;
}

} // namespace supple::test
