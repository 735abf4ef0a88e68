// Groups with SUPPLE_GROUP_DIRECT beside groups that store their vertices, for tests of what hosts' shaders make of
// both.
#pragma once

#include "shaders/direct_vert.h"
#include "shaders/direct_vert_SUPPLE_PATCH_TEXELS.h"
#include "shaders/prop_frag.h"
#include "shaders/ranges_vert.h"
#include "shaders/supple_patch_layout.h"
#include "surface/schemes.h"
#include "tests/support/canvas.h"
#include "tests/support/crowd.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/shader_range.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

namespace supple::test {

inline SuppleDirectOutput directOutput(const Crowd& crowd) {
    SuppleDirectOutput out{};
    out.structSize = sizeof out;
    EXPECT_EQ(suppleGetDirectOutput(crowd.context().handle(), crowd.group(), 0, &out), SUPPLE_OK);
    EXPECT_EQ(out.layout, SUPPLE_PATCH_LAYOUT);
    return out;
}

/// The bindings of supple_patch.glsl and supple_patch_tiles.glsl, and one more of a storage buffer.
class DirectSet {
public:
    DirectSet(host::Device& device, VkShaderStageFlags stages, bool texels) : device_(device), texels_(texels) {
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        const VkDescriptorType patches = texels ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : kStorage;
        layout_ = *host::createSetLayout(device, {{0, kStorage, stages},
                                                  {4, kStorage, stages},
                                                  {6, patches, stages},
                                                  {7, patches, stages},
                                                  {9, kStorage, stages}});
        pool_ = std::move(*host::DescriptorPool::create(device, 1));
        set_ = *pool_.allocate(layout_);
    }
    void write(const SuppleGridOutput& grid, const SuppleDirectOutput& from, VkBuffer fourth) {
        pool_.write(set_,
                    {host::storageBuffer(0, grid.rates[0].instances), host::storageBuffer(4, fourth, 0, VK_WHOLE_SIZE),
                     patches(6, from.tables, VK_FORMAT_R32G32B32A32_UINT),
                     patches(7, from.coefficients, VK_FORMAT_R32G32B32A32_SFLOAT),
                     host::storageBuffer(9, grid.indirect.buffer, 0, VK_WHOLE_SIZE)});
    }
    [[nodiscard]] VkDescriptorSetLayout layout() const { return layout_; }
    [[nodiscard]] VkDescriptorSet set() const { return set_; }

private:
    [[nodiscard]] host::Write patches(uint32_t binding, const SuppleBufferRange& range, VkFormat format) const {
        return texels_ ? host::texels(binding, *host::createTexels(device_, range, format))
                       : host::storageBuffer(binding, range);
    }

    host::Device& device_;
    bool texels_ = false;
    VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
    host::DescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

/// Two instances: one where it is, one far from the origin and turned.
inline void place(Crowd& crowd, uint32_t clip) {
    const glm::mat4 turned =
        glm::rotate(glm::translate(glm::mat4(1.0f), {37.0f, 11.0f, -52.0f}), 0.7f, {0.3f, 1.0f, 0.2f});
    crowd.pose(crowd.spawn(), clip, 0.4, glm::mat4(1.0f));
    crowd.pose(crowd.spawn(), clip, 0.9, turned);
}

struct Compared {
    size_t vertices = 0, different = 0;
    float largestTurn = 0.0f; ///< of normals

    void add(const Crowd& stored, const std::vector<glm::vec3>& made, uint32_t slot) {
        const SuppleGridOutput grid = stored.output().grid;
        const std::vector<glm::vec3> vertices = as<glm::vec3>(stored.read(stored.output().streams.vertices));
        for (size_t v = 0; v < grid.vertexCount; ++v) {
            const size_t at = 2 * (size_t{slot} * grid.verticesPerInstance + v);
            using Bits = std::array<uint32_t, 3>;
            different += std::bit_cast<Bits>(vertices[at]) != std::bit_cast<Bits>(made[at]) ? 1 : 0;
            largestTurn = std::max(largestTurn, glm::distance(vertices[at + 1], made[at + 1]));
            ++this->vertices;
        }
    }
    void join(const Compared& other) {
        vertices += other.vertices;
        different += other.different;
        largestTurn = std::max(largestTurn, other.largestTurn);
    }
    void expectSame(const char* what) const {
        std::printf("%s: %zu vertices, %zu differ, normals by %.2g\n", what, vertices, different,
                    static_cast<double>(largestTurn));
        EXPECT_GT(vertices, 0u);
        EXPECT_EQ(different, 0u);
        EXPECT_LT(largestTurn, 0.01f);
    }
};

struct Subject {
    std::string name;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    cage::Cage cage;
    SuppleCornerRule corners = SUPPLE_CORNERS_SHARP;
};

/// Corners of patches from a record on whose tangents are parallel: their normals are taken a step inside.
inline uint32_t singularCorners(const std::vector<uint32_t>& words, uint32_t firstRecord, uint32_t patchClass,
                                uint32_t patches) {
    uint32_t corners = 0;
    for (uint32_t p = 0; p < patches && patchClass >= SUPPLE_PATCH_P3 && patchClass <= SUPPLE_PATCH_P5; ++p) {
        const uint32_t record = firstRecord + p * SUPPLE_PM_RECORD_ELEMENTS(patchClass);
        corners +=
            static_cast<uint32_t>(std::popcount(SUPPLE_SINGULAR(words[4 * record + SUPPLE_PM_INNER_WORD(patchClass)])));
    }
    return corners;
}
inline bool isSingular(const cage::Cage& cage) {
    const Result<surface::Tables> tables = surface::buildTables({.scheme = surface::SchemeId::pm}, cage);
    return tables && std::ranges::any_of(tables->ranges, [&](const surface::PatchRange& range) {
               return singularCorners(tables->words, range.section.table, static_cast<uint32_t>(range.patchClass),
                                      range.section.count) > 0;
           });
}

inline std::vector<Subject> subjects() {
    std::vector<Subject> all{
        {"pentagons round a fan", SUPPLE_SCHEME_PM, perturbed(fanOverPentagons(5), 0.02f, 1)},
        {"triangles round a fan", SUPPLE_SCHEME_PM, perturbed(fanOverTriangles(4), 0.02f, 2)},
        {"capped cylinder", SUPPLE_SCHEME_PM, perturbed(cappedCylinder(8, 5), 0.02f, 3)},
        {"jack, p-rep", SUPPLE_SCHEME_PREP, perturbed(jack(), 0.02f, 4)},
        {"grid, p-rep", SUPPLE_SCHEME_PREP, perturbed(grid(4, 3), 0.02f, 5), SUPPLE_CORNERS_SMOOTH},
    };
    size_t creased = 0, singular = 0;
    for (const PmCage& from : pmZoo()) {
        if (from.variant != PmVariant::creased && from.variant != PmVariant::alphas) {
            continue;
        }
        const bool isOneOfTwelve = creased++ % 12 == 0;
        if (!isOneOfTwelve && singular >= 2) {
            continue;
        }
        const bool hasSingular = isSingular(from.cage);
        if (isOneOfTwelve || hasSingular) {
            singular += hasSingular ? 1 : 0;
            all.push_back({from.name, SUPPLE_SCHEME_PM, from.cage});
        }
    }
    return all;
}

/// A group with stored vertices, and one like it without.
struct Pair {
    Pair(CrowdContext& own, SuppleGroupDesc desc, uint32_t clip)
        : stored(own, withFormat(desc)), direct(own, withFlag(desc)) {
        place(stored, clip);
        place(direct, clip);
    }
    [[nodiscard]] bool valid() const { return stored.valid() && direct.valid(); }
    void setRate(uint32_t rate) {
        stored.setRate(rate);
        direct.setRate(rate);
    }
    void run() {
        stored.run();
        direct.context().run(direct.group());
    }
    static SuppleGroupDesc withFormat(SuppleGroupDesc desc) {
        desc.vertexFormat = SUPPLE_VERTEX_24;
        return desc;
    }
    static SuppleGroupDesc withFlag(SuppleGroupDesc desc) {
        desc.flags |= SUPPLE_GROUP_DIRECT;
        return desc;
    }

    Crowd stored, direct;
};

/// The groups of a subject at the largest rate of the tests, in the bind pose.
inline Pair pairOf(CrowdContext& own, const Subject& subject) {
    SupplePrepOptions prep{};
    prep.structSize = sizeof prep;
    prep.cornerRule = subject.corners;
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(subject.cage);
    desc.capacity = 2;
    desc.scheme = subject.scheme;
    desc.rate = 16;
    desc.prep = &prep;
    return {own, desc, SUPPLE_BIND_POSE};
}

/// What the shaders of pictures are told: where they look, and what they draw.
struct PictureWindow {
    float x = 0.0f, y = 0.8f, halfHeight = 1.3f, unused = 0.0f;
};
struct DirectPicturePush {
    PictureWindow window;
    SupplePatchRange direct{};
};
struct StoredPicturePush {
    PictureWindow window;
    ShaderRange range;
};

/// Draws groups by vertex shaders.
class DirectPictures {
public:
    explicit DirectPictures(host::Device& device) : device_(device), canvas_(device) {}

    host::Picture stored(const Crowd& crowd) {
        const host::GroupOutput output = crowd.output();
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        const VkDescriptorSetLayout layout =
            *host::createSetLayout(device_, {{0, kStorage, kVertex}, {1, kStorage, kVertex}});
        host::DescriptorPool pool = std::move(*host::DescriptorPool::create(device_, 1));
        const VkDescriptorSet set = *pool.allocate(layout);
        pool.write(set, {host::storageBuffer(0, output.grid.rates[0].instances),
                         host::storageBuffer(1, output.streams.vertices)});
        return draw(output.grid, layout, set, ranges_vert,
                    [&](uint32_t r) { return StoredPicturePush{.range = shaderRange(output.grid, r)}; });
    }
    host::Picture direct(const Crowd& crowd, bool texels) {
        const host::GroupOutput output = crowd.output();
        const SuppleDirectOutput from = directOutput(crowd);
        DirectSet set(device_, kVertex, texels);
        set.write(output.grid, from, output.grid.rates[0].instances.buffer); // the fourth is not read
        return draw(output.grid, set.layout(), set.set(),
                    texels ? std::span<const uint32_t>(direct_vert_SUPPLE_PATCH_TEXELS)
                           : std::span<const uint32_t>(direct_vert),
                    [&](uint32_t r) { return DirectPicturePush{.direct = from.ranges[r]}; });
    }

private:
    static constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;

    template <class PushOf>
    host::Picture draw(const SuppleGridOutput& grid, VkDescriptorSetLayout setLayout, VkDescriptorSet set,
                       std::span<const uint32_t> shader, PushOf&& pushOf) {
        using Push = decltype(pushOf(0u));
        host::GraphicsDesc desc = Canvas::pipelineDesc("test direct");
        desc.layout = *host::createPipelineLayout(device_, {setLayout}, sizeof(Push), kVertex);
        desc.vertexShader = shader;
        desc.fragmentShader = prop_frag;
        const VkPipeline pipeline = *host::createGraphicsPipeline(device_, desc);
        return canvas_.draw([&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, desc.layout, 0, 1, &set, 0, nullptr);
            vkCmdBindIndexBuffer(commands, grid.indices.buffer, grid.indices.offset, VK_INDEX_TYPE_UINT16);
            for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
                const Push push = pushOf(r);
                vkCmdPushConstants(commands, desc.layout, kVertex, 0, sizeof(push), &push);
                vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer,
                                         grid.indirect.offset + VkDeviceSize{r} * grid.indirect.stride, 1, 0);
            }
        });
    }

    host::Device& device_;
    Canvas canvas_;
};

} // namespace supple::test
