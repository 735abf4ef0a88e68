#include "tests/support/lod_surface.h"

#include "tests/support/lod_levels.h"

#include <algorithm>
#include <bit>
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

std::vector<glm::vec3> normalsOf(const std::vector<std::byte>& bytes, size_t stride) {
    std::vector<glm::vec3> normals(stride > 0 ? bytes.size() / stride : 0);
    for (size_t v = 0; v < normals.size(); ++v) {
        const std::byte* const at = bytes.data() + v * stride + sizeof(glm::vec3);
        if (stride == 24) {
            std::memcpy(&normals[v], at, sizeof(glm::vec3));
        } else {
            uint32_t packed = 0;
            std::memcpy(&packed, at, sizeof packed);
            normals[v] = decodeOctahedral(packed);
        }
    }
    return normals;
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

std::vector<std::array<uint32_t, 3>> trianglesOf(const host::GroupOutput& output, const std::vector<uint16_t>& indices,
                                                 const std::vector<VkDrawIndexedIndirectCommand>& commands) {
    EXPECT_EQ(commands.size(), output.levels.drawCount);
    std::vector<std::array<uint32_t, 3>> triangles;
    for (size_t d = 0; d < commands.size(); ++d) {
        const VkDrawIndexedIndirectCommand& command = commands[d];
        const SuppleLevelDraw& draw = output.levels.draws[d];
        for (uint32_t i = 0; i < command.instanceCount; ++i) {
            const uint32_t base = static_cast<uint32_t>(command.vertexOffset) + i * draw.verticesPerInstance;
            for (uint32_t k = 0; k < command.indexCount; k += 3) {
                const uint16_t* index = &indices[command.firstIndex + k];
                triangles.push_back({base + index[0], base + index[1], base + index[2]});
            }
        }
    }
    return triangles;
}

/// A number for each vertex that a triangle uses, in the order of vertices. Vertices whose positions have the same bits
/// get the same number. `count`: how many numbers there are.
std::vector<uint32_t> namePositions(const LodSurface& surface, uint32_t& count) {
    std::vector<bool> used(surface.positions.size());
    for (const auto& triangle : surface.triangles) {
        for (const uint32_t v : triangle) {
            used[v] = true;
        }
    }
    // An open hash table of vertices: names would take most of a test's time if positions were sorted.
    const size_t slots = std::bit_ceil(2 * used.size() + 1);
    std::vector<uint32_t> table(slots, cage::kNone);
    std::vector<uint32_t> names(used.size());
    count = 0;
    for (uint32_t v = 0; v < used.size(); ++v) {
        if (!used[v]) {
            continue;
        }
        const std::array<uint32_t, 3>& bits = surface.positions[v];
        uint64_t hash = 0;
        for (const uint32_t word : bits) {
            hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
            hash ^= hash >> 32;
        }
        size_t slot = hash & (slots - 1);
        while (table[slot] != cage::kNone && surface.positions[table[slot]] != bits) {
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == cage::kNone) {
            table[slot] = v;
            names[v] = count++;
        } else {
            names[v] = names[table[slot]];
        }
    }
    return names;
}

/// A side of triangles by the names of its ends, and how often it runs to the greater one, less how often back: not 0.
struct UnmatchedSide {
    uint32_t lesser, greater;
    int64_t count;
};

/// Triangles whose corners have different names, with their sides in runs by the lesser end.
class SidesByEnd {
public:
    /// Names are below `ids`.
    SidesByEnd(const LodSurface& surface, const std::vector<uint32_t>& names, uint32_t ids) : ends_(size_t{ids} + 1) {
        EXPECT_LT(ids, 1u << 31); // else a side does not fit its word
        struct Side {
            uint32_t lesser, other;
        };
        std::vector<Side> sides;
        sides.reserve(3 * surface.triangles.size());
        for (const auto& triangle : surface.triangles) {
            const uint32_t v[3] = {names[triangle[0]], names[triangle[1]], names[triangle[2]]};
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
                continue;
            }
            for (int i = 0; i < 3; ++i) {
                const uint32_t from = v[i], to = v[(i + 1) % 3];
                sides.push_back({std::min(from, to), std::max(from, to) << 1 | (from < to ? 1u : 0u)});
                ++ends_[sides.back().lesser + 1];
            }
        }
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        std::vector<size_t> next(ends_.begin(), ends_.end() - 1);
        others_.resize(sides.size());
        for (const Side& side : sides) {
            others_[next[side.lesser]++] = side.other;
        }
    }
    [[nodiscard]] size_t triangles() const { return others_.size() / 3; }
    /// Sorts the runs.
    [[nodiscard]] std::vector<UnmatchedSide> unmatched() {
        std::vector<UnmatchedSide> found;
        for (uint32_t vertex = 0; vertex + 1 < ends_.size(); ++vertex) {
            const auto begin = others_.begin() + static_cast<ptrdiff_t>(ends_[vertex]),
                       end = others_.begin() + static_cast<ptrdiff_t>(ends_[vertex + 1]);
            std::sort(begin, end);
            for (auto at = begin; at != end;) {
                const uint32_t greater = *at >> 1;
                int64_t count = 0;
                for (; at != end && *at >> 1 == greater; ++at) {
                    count += (*at & 1) != 0 ? 1 : -1;
                }
                if (count != 0) {
                    found.push_back({vertex, greater, count});
                }
            }
        }
        return found;
    }

private:
    std::vector<size_t> ends_;     ///< of the vertices' runs in others_; one more, which is 0
    std::vector<uint32_t> others_; ///< the greater end, and in the last bit whether the side runs to it
};

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
    surface.patches = readPatches(device, output);
    surface.triangles = trianglesOf(output, as<uint16_t>(read(output.indices())),
                                    as<VkDrawIndexedIndirectCommand>(read(output.indirect())));
    // A view's vertices can be many times as many as those that are used.
    uint32_t end = 0;
    for (const LodSurface::Patch& patch : surface.patches) {
        const auto form = static_cast<surface::lod::Form>(patch.grid);
        end = std::max(end, patch.firstVertex + surface::lod::sampleCount(form, patch.capacity));
    }
    for (const auto& triangle : surface.triangles) {
        end = std::max(end, *std::max_element(triangle.begin(), triangle.end()) + 1);
    }
    const auto readVertices = [&](SuppleBufferRange view) {
        EXPECT_TRUE(view.buffer == VK_NULL_HANDLE || VkDeviceSize{end} * view.stride <= view.size);
        view.size = std::min(view.size, VkDeviceSize{end} * view.stride);
        return view.size > 0 ? read(view) : std::vector<std::byte>();
    };
    const std::vector<std::byte> vertices = readVertices(output.streams.vertices);
    surface.positions = positionsOf(vertices, output.streams.vertices.stride);
    surface.normals = normalsOf(vertices, output.streams.vertices.stride);
    surface.tangents = as<uint32_t>(readVertices(output.streams.tangents));
    surface.previous =
        positionsOf(readVertices(output.streams.previousPositions), output.streams.previousPositions.stride);
    return surface;
}

std::array<glm::vec2, 2> parametersOf(const LodSurface::Patch& patch, uint32_t sample) {
    const uint32_t last = patch.capacity, i = sample % (last + 1), j = sample / (last + 1);
    const auto along = [&](uint32_t k, size_t pair) {
        if (k == 0 || k == last) {
            return k == 0 ? glm::vec2(0.0f, 1.0f) : glm::vec2(1.0f, 0.0f);
        }
        const surface::lod::LevelPair level{patch.levels[2 * pair], patch.levels[2 * pair + 1]};
        const surface::lod::Parameter p = surface::lod::parameter(last, k, level);
        return glm::vec2(p.t, p.s);
    };
    return {along(i, j == 0 ? 2 : j == last ? 4 : 0), along(j, i == last ? 3 : i == 0 ? 5 : 1)};
}

glm::dvec3 ringWeightsOf(const LodSurface::Patch& patch, uint32_t sample) {
    const uint32_t last = patch.capacity;
    uint32_t ring = 0, at = sample;
    for (; at >= 3 * (last - 2 * ring); ++ring) {
        at -= 3 * (last - 2 * ring);
    }
    const uint32_t each = last - 2 * ring, side = at / each, k = ring + at % each;
    const auto pair = [&](uint32_t i, size_t pattern) {
        const surface::lod::LevelPair level{patch.levels[2 * pattern], patch.levels[2 * pattern + 1]};
        const surface::lod::Parameter p = surface::lod::parameter(last, i, level);
        return glm::dvec2(p.t, p.s);
    };
    const glm::dvec2 along = pair(k, ring == 0 ? 1 + side : 0);
    const double across = ring == 0 ? 0.0 : pair(ring, 0).x, third = 2.0 * across / 3.0;
    glm::dvec3 weights(third);
    weights[static_cast<int>(side)] += along.y - across;
    weights[static_cast<int>((side + 1) % 3)] += along.x - across;
    return weights;
}

Sides matchSides(const LodSurface& surface) {
    uint32_t ids = 0;
    const std::vector<uint32_t> names = namePositions(surface, ids);
    SidesByEnd byEnd(surface, names, ids);
    Sides sides;
    sides.triangles = byEnd.triangles();
    std::vector<uint32_t> parent(ids);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t x) {
        while (parent[x] != x) {
            x = parent[x] = parent[parent[x]];
        }
        return x;
    };
    std::map<uint32_t, int64_t> balance;
    for (const UnmatchedSide& side : byEnd.unmatched()) {
        sides.unmatched += static_cast<size_t>(std::abs(side.count));
        balance[side.lesser] += side.count;
        balance[side.greater] -= side.count;
        parent[root(side.lesser)] = root(side.greater);
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

Sides expectClosed(const LodSurface& surface, const std::vector<surface::PatchInfo>& patches, Borders& all) {
    const Sides sides = matchSides(surface);
    const Borders borders = bordersOf(surface, patches);
    EXPECT_EQ(surface.patches.size(), patches.size());
    EXPECT_EQ(borders.different, 0u) << "of " << borders.samples;
    EXPECT_EQ(borders.lengths, 0u) << "of " << borders.edges;
    EXPECT_EQ(sides.looseEnds, 0u);
    EXPECT_LE(sides.unmatched, borders.open);
    all.samples += borders.samples;
    all.edges += borders.edges;
    return sides;
}

} // namespace supple::test
