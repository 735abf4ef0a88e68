#include "tests/support/lod_surface.h"

#include "tests/support/lod_levels.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace supple::test {

namespace {

PositionBits positionsOf(const std::vector<std::byte>& bytes, size_t stride) {
    PositionBits bits(stride > 0 ? bytes.size() / stride : 0);
    for (size_t v = 0; v < bits.size(); ++v) {
        std::memcpy(&bits[v], bytes.data() + v * stride, sizeof(bits[v]));
    }
    return bits;
}

/// Samples along a patch's side, without repeats.
std::vector<std::array<uint32_t, 3>> side(const LodSurface& surface, const LodSurface::Patch& patch, uint32_t index) {
    std::vector<std::array<uint32_t, 3>> samples;
    for (uint32_t k = 0; k <= patch.capacity; ++k) {
        const uint32_t at =
            surface::lod::edgeSample(static_cast<surface::lod::Form>(patch.grid), patch.capacity, index, k);
        const std::array<uint32_t, 3>& bits = surface.positions[patch.firstVertex + at];
        if (samples.empty() || samples.back() != bits) {
            samples.push_back(bits);
        }
    }
    return samples;
}

std::vector<std::byte> readView(host::Device& device, const SuppleBufferRange& view) {
    if (view.buffer == VK_NULL_HANDLE) {
        return {};
    }
    Result<std::vector<std::byte>> bytes = device.readBuffer(view);
    EXPECT_TRUE(bytes.ok());
    return bytes.ok() ? std::move(*bytes) : std::vector<std::byte>(view.size);
}

std::vector<LodSurface::Patch> readPatches(host::Device& device, const host::GroupOutput& output) {
    const auto buckets = as<std::array<uint32_t, 4>>(readView(device, output.levels.buckets));
    uint32_t end = 0; // what lies behind, of the buffer, is other groups' or no one's
    for (const std::array<uint32_t, 4>& bucket : buckets) {
        end = std::max(end, bucket[2] > 0 ? bucket[0] + bucket[2] : 0);
    }
    std::vector<LodSurface::Patch> patches;
    if (end == 0) {
        return patches;
    }
    SuppleBufferRange used = output.levels.patches;
    used.size = VkDeviceSize{end} * sizeof(std::array<uint32_t, 16>);
    EXPECT_LE(used.size, output.levels.patches.size);
    const auto records = as<std::array<uint32_t, 16>>(readView(device, used));
    for (uint32_t d = 0; d < output.levels.drawCount; ++d) {
        const SuppleLevelDraw& draw = output.levels.draws[d];
        for (uint32_t p = 0; p < buckets[d][2]; ++p) {
            const std::array<uint32_t, 16>& record = records[buckets[d][0] + p];
            LodSurface::Patch& patch = patches.emplace_back();
            patch.patch = record[0];
            patch.slot = record[1] & 0x0FFFFFFFu;
            patch.firstVertex = record[2];
            patch.capacity = draw.capacity;
            patch.grid = draw.grid;
            std::memcpy(patch.levels.data(), &record[4], sizeof(patch.levels));
            EXPECT_EQ(patch.firstVertex, buckets[d][1] + p * draw.samplesPerPatch);
        }
    }
    return patches;
}

} // namespace

std::vector<LodSurface::Patch> readLodPatches(const Crowd& crowd) {
    return readPatches(crowd.context().device(), crowd.output());
}

LodSurface readLodSurface(const Crowd& crowd) {
    return readLodSurface(crowd.context().device(), crowd.output());
}

LodSurface readLodSurface(host::Device& device, const host::GroupOutput& output) {
    const auto read = [&](const SuppleBufferRange& view) { return readView(device, view); };
    LodSurface surface;
    const std::vector<std::byte> vertices = read(output.streams.vertices);
    surface.positions = positionsOf(vertices, output.streams.vertices.stride);
    if (output.streams.vertices.stride == 24) {
        surface.normals.resize(surface.positions.size());
        for (size_t v = 0; v < surface.normals.size(); ++v) {
            std::memcpy(&surface.normals[v], vertices.data() + 24 * v + 12, sizeof(glm::vec3));
        }
    }
    surface.previous = positionsOf(read(output.streams.previousPositions), output.streams.previousPositions.stride);
    const auto indices = as<uint16_t>(read(output.indices()));
    const auto commands = as<VkDrawIndexedIndirectCommand>(read(output.indirect()));
    EXPECT_EQ(commands.size(), output.levels.drawCount);
    for (size_t d = 0; d < commands.size(); ++d) {
        const VkDrawIndexedIndirectCommand& command = commands[d];
        const SuppleLevelDraw& draw = output.levels.draws[d];
        for (uint32_t i = 0; i < command.instanceCount; ++i) {
            const uint32_t base = static_cast<uint32_t>(command.vertexOffset) + i * draw.verticesPerInstance;
            for (uint32_t k = 0; k < command.indexCount; k += 3) {
                const uint16_t* index = &indices[command.firstIndex + k];
                surface.triangles.push_back({base + index[0], base + index[1], base + index[2]});
            }
        }
    }
    surface.patches = readPatches(device, output);
    return surface;
}

Sides matchSides(const LodSurface& surface) {
    // Vertices of the same bits are one.
    std::vector<uint32_t> order;
    for (const auto& triangle : surface.triangles) {
        order.insert(order.end(), triangle.begin(), triangle.end());
    }
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return surface.positions[a] < surface.positions[b]; });
    std::vector<uint32_t> idOf(surface.positions.size());
    uint32_t ids = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        ids += i > 0 && surface.positions[order[i]] != surface.positions[order[i - 1]] ? 1 : 0;
        idOf[order[i]] = ids;
    }
    ++ids;
    Sides sides;
    std::vector<std::pair<uint64_t, int>> directed; // a side as (less, greater), and its direction
    for (const auto& triangle : surface.triangles) {
        const uint32_t v[3] = {idOf[triangle[0]], idOf[triangle[1]], idOf[triangle[2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
            continue;
        }
        ++sides.triangles;
        for (int i = 0; i < 3; ++i) {
            const uint32_t from = v[i], to = v[(i + 1) % 3];
            directed.emplace_back(uint64_t{std::min(from, to)} << 32 | std::max(from, to), from < to ? 1 : -1);
        }
    }
    std::sort(directed.begin(), directed.end());
    std::vector<std::pair<std::pair<uint32_t, uint32_t>, int64_t>> counts; // of a side less that of its opposite
    for (const auto& [side, direction] : directed) {
        const std::pair<uint32_t, uint32_t> ends{static_cast<uint32_t>(side >> 32), static_cast<uint32_t>(side)};
        if (counts.empty() || counts.back().first != ends) {
            counts.push_back({ends, 0});
        }
        counts.back().second += direction;
    }
    std::vector<uint32_t> parent(ids);
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

std::vector<surface::PatchInfo> patchesOf(const Crowd& crowd) {
    std::vector<SupplePatchInfo> infos(crowd.output().surface.patchCount);
    auto count = static_cast<uint32_t>(infos.size());
    EXPECT_EQ(suppleGetPatches(crowd.context().handle(), crowd.group(), 0, infos.data(), &count), SUPPLE_OK);
    EXPECT_EQ(count, infos.size());
    std::vector<surface::PatchInfo> patches;
    for (const SupplePatchInfo& info : infos) {
        surface::PatchInfo& patch = patches.emplace_back();
        patch.face = info.face;
        patch.patchClass = static_cast<surface::PatchClass>(info.patchClass);
        patch.cornerCount = info.cornerCount;
        std::copy_n(info.corners, info.cornerCount, patch.corners.begin());
    }
    return patches;
}

Borders bordersOf(const LodSurface& surface, const std::vector<surface::PatchInfo>& patches) {
    using Samples = std::vector<std::array<uint32_t, 3>>;
    std::map<std::pair<uint32_t, uint32_t>, std::vector<Samples>>
        sides; // by cage vertices, and unknown ones not at all
    Borders result;
    for (const LodSurface::Patch& patch : surface.patches) {
        const surface::PatchInfo& info = patches[patch.patch];
        for (uint32_t e = 0; e < info.cornerCount; ++e) {
            // A polar patch's third corner is the side at which its quad ends in a point.
            const uint32_t gridSide = info.patchClass == surface::PatchClass::polar && e == 2 ? 3 : e;
            const uint32_t from = info.corners[e], to = info.corners[(e + 1) % info.cornerCount];
            if (from != cage::kNone && to != cage::kNone) {
                sides[{from, to}].push_back(side(surface, patch, gridSide));
            }
        }
    }
    for (const auto& [ends, own] : sides) {
        const auto other = sides.find({ends.second, ends.first});
        if (other == sides.end()) {
            for (const Samples& samples : own) {
                result.open += samples.size() - 1;
            }
            continue;
        }
        if (ends.first > ends.second || own.size() != 1 || other->second.size() != 1) {
            continue;
        }
        Samples back = other->second.front();
        std::reverse(back.begin(), back.end());
        ++result.edges;
        result.samples += own.front().size();
        if (back.size() != own.front().size()) {
            ++result.lengths;
            continue;
        }
        for (size_t k = 0; k < back.size(); ++k) {
            result.different += back[k] != own.front()[k] ? 1 : 0;
        }
    }
    return result;
}

} // namespace supple::test
