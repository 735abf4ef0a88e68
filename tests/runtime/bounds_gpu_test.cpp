// Bounds, culling and the list of what is seen, on hand-made cages: what the device wrote against the same on the CPU.
#include "runtime/culling/bounds_kernels.h"
#include "runtime/culling/occlusion_kernels.h"

#include "gpu/bound_sets.h"
#include "gpu/memory.h"
#include "shaders/shared/lod.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/gpu_surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace supple::runtime {
namespace {

using namespace supple::shared;
using test::mappingName;
using test::testDevice;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kMargin = 0.125f;
constexpr float kLongest = 0.05f, kBend = 0.01f;
constexpr uint32_t kArgumentStride = 16, kWindowArguments = 128; ///< words
constexpr uint32_t kUnwritten = 0xABABABABu;

/// Fills a buffer of the host's with values and reads others back.
template <class T>
std::vector<T> valuesOf(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

/// Depths of a picture, and the levels above it: texels have the farthest of all that their rectangle touches.
struct Pyramid {
    uint32_t width = 0, height = 0;
    bool reversed = false;
    std::array<float, 16> columns{};
    std::vector<std::vector<float>> levels;

    [[nodiscard]] uint32_t widthOf(uint32_t level) const { return std::max(width >> level, 1u); }
    [[nodiscard]] uint32_t heightOf(uint32_t level) const { return std::max(height >> level, 1u); }
    [[nodiscard]] float farther(float a, float b) const { return reversed ? std::min(a, b) : std::max(a, b); }
    /// The farthest depth of the pixels first..last, and whether there are any.
    [[nodiscard]] float farthest(glm::ivec2 first, glm::ivec2 last) const {
        float depth = reversed ? 1.0f : 0.0f;
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                depth = farther(depth, levels[0][static_cast<size_t>(y) * width + static_cast<size_t>(x)]);
            }
        }
        return depth;
    }
    void build(const std::vector<float>& depths) {
        levels.assign(1, depths);
        while (widthOf(static_cast<uint32_t>(levels.size()) - 1) > 1 ||
               heightOf(static_cast<uint32_t>(levels.size()) - 1) > 1) {
            const auto level = static_cast<uint32_t>(levels.size());
            const uint32_t w = widthOf(level), h = heightOf(level);
            std::vector<float> texels;
            for (uint32_t y = 0; y < h; ++y) {
                for (uint32_t x = 0; x < w; ++x) {
                    texels.push_back(farthest({x * width / w, y * height / h},
                                              {((x + 1) * width + w - 1) / w - 1, ((y + 1) * height + h - 1) / h - 1}));
                }
            }
            levels.push_back(std::move(texels));
        }
    }
};

/// A group's slots and what a frame knows of them.
struct Scene {
    uint32_t vertexCount = 0, cageStride = 0, windowSize = 0, slots = 0;
    std::vector<glm::vec4> cages; ///< cageStride a slot
    std::vector<uint32_t> host;   ///< the host's list
    CullView view{};
    std::vector<ListArgument> arguments;
    Pyramid pyramid; ///< without levels: nothing is occluded
    uint32_t room = kRoomForAll, leastVertices = 0;

    Scene(uint32_t vertices, uint32_t count, uint32_t window)
        : vertexCount(vertices), cageStride(vertices + 3), windowSize(window), slots(count),
          cages(size_t{count} * cageStride, glm::vec4(kNaN)) { // padding is not to be read
        view.camera.nearest = 0.01f;
    }
    void addAll(uint32_t flags = kInstanceIsNew) {
        for (uint32_t slot = 0; slot < slots; ++slot) {
            host.push_back(slot | flags);
        }
    }
    glm::vec4& vertex(uint32_t slot, uint32_t v) { return cages[size_t{slot} * cageStride + v]; }
    void box(uint32_t slot, glm::vec3 middle, float size, std::mt19937& random) {
        std::uniform_real_distribution<float> place(-size, size);
        for (uint32_t v = 0; v < vertexCount; ++v) {
            vertex(slot, v) = {middle.x + place(random), middle.y + place(random), middle.z + place(random), 1.0f};
        }
    }
    [[nodiscard]] std::vector<ListWindow> windows() const {
        std::vector<ListWindow> result;
        uint32_t entry = 0;
        for (uint32_t first = 0; first < slots; first += windowSize) {
            const uint32_t begin = entry;
            while (entry < host.size() && (host[entry] & kInstanceSlotMask) < first + windowSize) {
                ++entry;
            }
            result.push_back({begin, entry - begin, first, slots + first});
        }
        return result;
    }
};

struct Culled {
    std::vector<glm::vec4> bounds;
    std::vector<uint32_t> states, list, arguments;
};

/// The passes on the test program's device.
class Rig {
public:
    static std::unique_ptr<Rig> create(host::Device& host, SuppleMapping mapping) {
        gpu::DeviceDesc desc;
        desc.instance = host.instance();
        desc.physicalDevice = host.physicalDevice();
        desc.device = host.handle();
        desc.queueFamily = desc.drawQueueFamily = host.queueFamily();
        desc.getInstanceProcAddr = host.getInstanceProcAddr();
        desc.debugUtils = host.hasDebugUtils();
        desc.mapping = mapping == SUPPLE_MAPPING_WIDE ? gpu::MappingChoice::wide : gpu::MappingChoice::narrow;
        Result<gpu::Device> device = gpu::Device::create(desc);
        if (!device) {
            ADD_FAILURE() << device.error().message;
            return nullptr;
        }
        auto rig = std::unique_ptr<Rig>(new Rig(host, std::move(*device)));
        if (!prepared(BoundsKernels::create(rig->device_, rig->pipelines_), rig->bounds_) ||
            !prepared(OcclusionKernels::create(rig->device_, rig->pipelines_), rig->occlusion_)) {
            return nullptr;
        }
        return rig;
    }

    /// A frame: states stay from one to the next as long as the count of slots does.
    Culled run(const Scene& scene) {
        constexpr VkBufferUsageFlags kUse = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                            VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
        const auto upload = [&](const void* bytes, size_t size) {
            const std::vector<std::byte> none(16);
            Result<host::Buffer> buffer =
                size > 0 ? host_.uploadBuffer(bytes, size, kUse) : host_.uploadBuffer(none.data(), none.size(), kUse);
            EXPECT_TRUE(buffer.ok());
            return std::move(*buffer);
        };
        const std::vector<ListWindow> windows = scene.windows();
        std::vector<std::byte> table(listTableBytes(windows.size(), scene.arguments.size(), 0, 0));
        writeListTable(windows, scene.arguments, {}, {}, table.data());
        const std::vector<uint32_t> blank(3 * size_t{scene.slots} + 4096, kUnwritten);
        if (states_.size() != size_t{scene.slots} * 8) {
            const std::vector<uint32_t> zero(2 * size_t{scene.slots}, 0);
            states_ = upload(zero.data(), zero.size() * 4);
        }
        const host::Buffer cages = upload(scene.cages.data(), scene.cages.size() * sizeof(glm::vec4));
        const std::vector<glm::vec4> noBounds(2 * size_t{scene.slots});
        const host::Buffer bounds = upload(noBounds.data(), noBounds.size() * sizeof(glm::vec4));
        const host::Buffer hostList = upload(scene.host.data(), scene.host.size() * 4);
        const host::Buffer list = upload(blank.data(), 3 * size_t{scene.slots} * 4);
        const host::Buffer arguments = upload(blank.data(), 4096 * 4);
        const host::Buffer tables = upload(table.data(), table.size());
        const host::Buffer view = upload(&scene.view, sizeof(scene.view));
        const std::vector<uint32_t> noSizes(2 * kSizeRanks), noWords(kLodSolution);
        const host::Buffer sizes = upload(noSizes.data(), noSizes.size() * 4);
        const host::Buffer words = upload(noWords.data(), noWords.size() * 4);

        std::vector<gpu::BufferViewHandle> views;
        const auto texels = [&](const host::Buffer& buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize range) {
            Result<gpu::BufferViewHandle> made =
                gpu::createTexelView(device_, buffer.handle(), format, offset, range, "test");
            EXPECT_TRUE(made.ok());
            views.push_back(std::move(*made));
            return views.back().get();
        };
        const auto count = static_cast<uint32_t>(windows.size());
        gpu::BoundSets sets, listSets;
        EXPECT_TRUE(sets.create(device_, bounds_.boundsLayout(), count, "test").ok());
        EXPECT_TRUE(listSets.create(device_, bounds_.listLayout(), 1, "test").ok());
        const VkBufferView stateTexels = texels(states_, VK_FORMAT_R32G32_UINT, 0, states_.size());
        const VkBufferView hostTexels = texels(hostList, VK_FORMAT_R32_UINT, 0, hostList.size());
        for (uint32_t w = 0; w < count; ++w) {
            const ListWindow& window = windows[w];
            const VkDeviceSize cageBytes = VkDeviceSize{scene.cageStride} * 16;
            const VkDeviceSize offset = window.firstSlot * cageBytes;
            const VkDeviceSize range = std::min(scene.windowSize, scene.slots - window.firstSlot) * cageBytes;
            const auto whole = [](const host::Buffer& buffer) {
                return VkDescriptorBufferInfo{buffer.handle(), 0, VK_WHOLE_SIZE};
            };
            const gpu::BoundResource resources[] = {
                {kBoundsCageBinding, {cages.handle(), offset, range}},
                {kBoundsCageTexelBinding, {}, texels(cages, VK_FORMAT_R32G32B32A32_SFLOAT, offset, range)},
                {kBoundsBinding, whole(bounds)},
                {kBoundsStateBinding, whole(states_)},
                {kBoundsStateTexelBinding, {}, stateTexels},
                {kHostListBinding, whole(hostList)},
                {kHostListTexelBinding, {}, hostTexels},
                {kListBinding, whole(list)},
                {kListArgumentBinding, whole(arguments)},
                {kListTableBinding, whole(tables)},
                {kCullViewBinding, whole(view)},
                {kSizeBinding, whole(sizes)},
                {kViewWordsBinding, whole(words)},
                {kWantedBinding, whole(states_)},
            };
            sets.write(device_, bounds_.boundsLayout(), w, resources);
            if (w == 0) {
                listSets.write(device_, bounds_.listLayout(), 0, resources);
            }
        }
        const Pyramid& pyramid = scene.pyramid;
        Result<gpu::DescriptorPoolHandle> occlusionPool =
            gpu::createDescriptorPool(device_, occlusion_.layout(), 1, "test");
        EXPECT_TRUE(occlusionPool.ok());
        VkDescriptorSet occlusionSet = VK_NULL_HANDLE;
        const host::Image image = imageOf(pyramid);
        if (!pyramid.levels.empty()) {
            Result<VkDescriptorSet> set = gpu::allocateSet(device_, occlusion_.layout(), occlusionPool->get(), "test");
            EXPECT_TRUE(set.ok());
            occlusionSet = *set;
            const gpu::BoundResource resources[] = {
                {kBoundsBinding, {bounds.handle(), 0, VK_WHOLE_SIZE}},
                {kBoundsStateBinding, {states_.handle(), 0, VK_WHOLE_SIZE}},
                {kHostListBinding, {hostList.handle(), 0, VK_WHOLE_SIZE}},
                {kHostListTexelBinding, {}, hostTexels},
            };
            gpu::writeSet(device_, occlusion_.layout(), occlusionSet, resources);
            occlusion_.writePyramid(occlusionSet, image.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        }
        EXPECT_TRUE(host_
                        .submitAndWait([&](VkCommandBuffer commands) {
                            gpu::SingleDispatches dispatches(device_, commands);
                            for (uint32_t w = 0; w < count; ++w) {
                                bounds_.recordBounds(dispatches, sets[w],
                                                     {scene.vertexCount, scene.cageStride, windows[w].firstEntry,
                                                      windows[w].entries, windows[w].firstSlot, kMargin, kLongest,
                                                      kBend});
                            }
                            gpu::computeBarrier(device_, commands);
                            if (occlusionSet != VK_NULL_HANDLE) {
                                OcclusionPush push{{},
                                                   0,
                                                   static_cast<uint32_t>(scene.host.size()),
                                                   pyramid.width,
                                                   pyramid.height,
                                                   static_cast<uint32_t>(pyramid.levels.size()),
                                                   pyramid.reversed ? 1u : 0u};
                                std::copy(pyramid.columns.begin(), pyramid.columns.end(), push.columns);
                                occlusion_.record(commands, occlusionSet, push);
                                gpu::computeBarrier(device_, commands);
                            }
                            if (scene.room != kRoomForAll) {
                                bounds_.recordSizes(dispatches, listSets[0],
                                                    {0, static_cast<uint32_t>(scene.host.size()), scene.leastVertices});
                                gpu::computeBarrier(device_, commands);
                            }
                            const ListPush push{count,       static_cast<uint32_t>(scene.arguments.size()),
                                                0,           kArgumentStride,
                                                scene.slots, scene.room};
                            bounds_.recordList(dispatches, listSets[0], push);
                            gpu::memoryBarrier(device_, commands,
                                               {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_WRITE_BIT},
                                               {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT});
                        })
                        .ok());
        const auto read = [&](const host::Buffer& buffer) {
            Result<std::vector<std::byte>> bytes = host_.readBuffer(buffer.handle(), 0, buffer.size());
            EXPECT_TRUE(bytes.ok());
            return std::move(*bytes);
        };
        return {valuesOf<glm::vec4>(read(bounds)), valuesOf<uint32_t>(read(states_)), valuesOf<uint32_t>(read(list)),
                valuesOf<uint32_t>(read(arguments))};
    }

private:
    /// Ready for compute shaders to read.
    host::Image imageOf(const Pyramid& pyramid) {
        if (pyramid.levels.empty()) {
            return {};
        }
        host::ImageDesc desc;
        desc.format = VK_FORMAT_R32_SFLOAT;
        desc.extent = {pyramid.width, pyramid.height};
        desc.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        desc.mipLevels = static_cast<uint32_t>(pyramid.levels.size());
        Result<host::Image> image = host_.createImage(desc);
        EXPECT_TRUE(image.ok());
        std::vector<float> texels;
        std::vector<VkBufferImageCopy> copies;
        for (uint32_t level = 0; level < desc.mipLevels; ++level) {
            VkBufferImageCopy copy{};
            copy.bufferOffset = texels.size() * sizeof(float);
            copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
            copy.imageExtent = {pyramid.widthOf(level), pyramid.heightOf(level), 1};
            copies.push_back(copy);
            texels.insert(texels.end(), pyramid.levels[level].begin(), pyramid.levels[level].end());
        }
        Result<host::Buffer> staging =
            host_.uploadBuffer(texels.data(), texels.size() * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        EXPECT_TRUE(staging.ok());
        EXPECT_TRUE(host_
                        .submitAndWait([&](VkCommandBuffer commands) {
                            const host::ImageUse copied{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                                        {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}};
                            host::imageBarrier(commands, *image, {VK_IMAGE_LAYOUT_UNDEFINED, {}}, copied);
                            vkCmdCopyBufferToImage(commands, staging->handle(), image->handle(), copied.layout,
                                                   desc.mipLevels, copies.data());
                            host::imageBarrier(commands, *image, copied,
                                               {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                                {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT}});
                        })
                        .ok());
        return std::move(*image);
    }

    /// Puts kernels whose pipelines are made into `target`.
    template <class Kernels>
    static bool prepared(Result<Kernels> made, Kernels& target) {
        const Status status = made ? made->prepare() : made.error();
        if (!status) {
            ADD_FAILURE() << status.error().message;
            return false;
        }
        target = std::move(*made);
        return true;
    }

    Rig(host::Device& host, gpu::Device device) : host_(host), device_(std::move(device)), pipelines_(device_) {}
    host::Device& host_;
    gpu::Device device_;
    gpu::Pipelines pipelines_;
    BoundsKernels bounds_;
    OcclusionKernels occlusion_;
    host::Buffer states_;
};

/// The same on the CPU. `closest`: how near a decision is to turning over, relative to the scene's unit.
class Expected {
public:
    std::vector<glm::vec4> bounds;
    std::vector<uint32_t> pastOf; ///< per slot: seen when it was listed last
    std::vector<uint32_t> all, byWindow;
    std::vector<std::array<uint32_t, 3>> windows; ///< seen, with a past, listed
    double closest = 1e30;

    explicit Expected(const Scene& scene) : bounds(2 * size_t{scene.slots}), pastOf(scene.slots, 0) {}

    void frame(const Scene& scene) {
        all.clear();
        windows.clear();
        byWindow.assign(scene.slots, kUnwritten);
        closest = 1e30;
        for (const ListWindow& window : scene.windows()) {
            std::vector<uint32_t> kinds[2];
            for (uint32_t i = window.firstEntry; i < window.firstEntry + window.entries; ++i) {
                const uint32_t entry = scene.host[i], slot = entry & kInstanceSlotMask;
                const bool seen = look(scene, slot);
                const bool fresh = (entry & kInstanceIsNew) != 0 || pastOf[slot] == 0;
                pastOf[slot] = seen ? 1 : 0;
                if (seen) {
                    all.push_back(slot);
                    kinds[fresh ? 1 : 0].push_back((slot - window.firstSlot) |
                                                   (entry & (3u << kInstancePriorityShift)) |
                                                   (fresh ? kInstanceIsNew : 0));
                }
            }
            uint32_t at = window.target - scene.slots;
            for (const auto& entries : kinds) {
                at = static_cast<uint32_t>(std::copy(entries.begin(), entries.end(), byWindow.begin() + at) -
                                           byWindow.begin());
            }
            windows.push_back({static_cast<uint32_t>(kinds[0].size() + kinds[1].size()),
                               static_cast<uint32_t>(kinds[0].size()), window.entries});
        }
    }

    void compare(const Scene& scene, const Culled& written) const {
        for (const uint32_t entry : scene.host) {
            const uint32_t slot = entry & kInstanceSlotMask;
            ASSERT_EQ(glm::vec3(written.bounds[2 * slot]), glm::vec3(bounds[2 * slot])) << "slot " << slot;
            ASSERT_EQ(written.bounds[2 * slot + 1], bounds[2 * slot + 1]) << "slot " << slot;
            ASSERT_EQ(written.states[2 * slot + 1] & kDrawn, pastOf[slot]) << "slot " << slot;
        }
        std::vector<uint32_t> wanted(scene.slots, kUnwritten);
        std::copy(all.begin(), all.end(), wanted.begin());
        EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), written.list.begin()));
        EXPECT_TRUE(std::equal(byWindow.begin(), byWindow.end(), written.list.begin() + scene.slots));
        std::array<uint32_t, 3> sum{};
        for (uint32_t w = 0; w < windows.size(); ++w) {
            for (uint32_t k = 0; k < 3; ++k) {
                EXPECT_EQ(written.arguments[kListHeaderWords * (w + 1) + k], windows[w][k]) << "window " << w;
                sum[k] += windows[w][k];
            }
        }
        for (uint32_t k = 0; k < 3; ++k) {
            EXPECT_EQ(written.arguments[k], sum[k]);
        }
        EXPECT_EQ(sum[0], all.size());
    }

private:
    bool look(const Scene& scene, uint32_t slot) {
        constexpr float kMax = std::numeric_limits<float>::max();
        glm::vec3 low(kMax), high(-kMax);
        bool sound = true;
        for (uint32_t v = 0; v < scene.vertexCount; ++v) {
            const glm::vec3 p = scene.cages[size_t{slot} * scene.cageStride + v];
            if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            } else {
                sound = false;
            }
        }
        if (low.x <= high.x) {
            const glm::vec3 grown = kMargin * (high - low);
            low -= grown;
            high += grown;
        }
        bounds[2 * slot] = {low, 0.0f};
        bounds[2 * slot + 1] = {high, sound ? 0.0f : 1.0f};
        if (!sound) {
            return true;
        }
        bool seen = true;
        const auto ask = [&](double slack) { // positive: in
            closest = std::min(closest, std::abs(slack));
            seen = seen && slack >= 0.0;
        };
        const CullView& view = scene.view;
        const glm::dvec3 l = low, h = high, middle = 0.5 * (l + h), extent = 0.5 * (h - l);
        for (uint32_t k = 0; k < 6; ++k) {
            const float* p = &view.planes[4 * k];
            const glm::dvec3 normal(p[0], p[1], p[2]);
            if (normal != glm::dvec3(0.0) || p[3] != 0.0f) {
                ask(glm::dot(normal, middle) + p[3] + glm::dot(glm::abs(normal), extent));
            }
        }
        const glm::dvec3 camera(view.camera.position[0], view.camera.position[1], view.camera.position[2]);
        if (view.farthest > 0.0f) {
            ask(view.farthest - glm::length(glm::max(glm::max(l - camera, camera - h), glm::dvec3(0.0))));
        }
        if (view.smallest > 0.0f) {
            const double away = view.camera.orthographic != 0 ? 1.0 : glm::length(middle - camera);
            ask(glm::length(extent) * view.camera.focal / view.smallest - away);
        }
        return seen;
    }
};

class Bounds : public testing::TestWithParam<SuppleMapping> {
protected:
    void SetUp() override {
        ASSERT_NE(testDevice(), nullptr);
        rig = Rig::create(*testDevice(), GetParam());
        ASSERT_NE(rig, nullptr);
    }
    /// A frame that must come out as on the CPU, and far enough from every decision's edge to say so.
    Culled check(const Scene& scene, Expected& expected) {
        Culled written = rig->run(scene);
        expected.frame(scene);
        EXPECT_GT(expected.closest, 1e-5) << "the scene does not decide";
        expected.compare(scene, written);
        return written;
    }
    test::ValidationGuard guard;
    std::unique_ptr<Rig> rig;
};
INSTANTIATE_TEST_SUITE_P(Mappings, Bounds, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

/// A camera at the origin that looks along -z, 90 degrees both ways, depths 1..100.
std::array<float, 24> openView() {
    return frustumPlanes({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -100.0f / 99.0f, -1, 0, 0, -100.0f / 99.0f, 0});
}

Scene randomScene(uint32_t vertices, uint32_t slots, uint32_t window, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-60.0f, 60.0f), size(0.1f, 6.0f);
    Scene scene(vertices, slots, window);
    for (uint32_t slot = 0; slot < slots; ++slot) {
        scene.box(slot, {place(random), place(random), place(random)}, size(random), random);
        if (random() % 3 != 0) {
            scene.host.push_back(slot | static_cast<uint32_t>(random() % 4) << kInstancePriorityShift |
                                 (random() % 2 == 0 ? kInstanceIsNew : 0u));
        }
    }
    return scene;
}

void setPlanes(Scene& scene, const std::array<float, 24>& planes) {
    std::copy(planes.begin(), planes.end(), scene.view.planes);
}

TEST_P(Bounds, AreThoseOfTheCagesAndPlanesDecide) {
    for (const uint32_t vertices : {1u, 5u, 128u, 333u}) {
        for (const uint32_t window : {97u, 300u, 1000u}) {
            Scene scene = randomScene(vertices, 300, window, vertices + window);
            Expected expected(scene);
            setPlanes(scene, openView());
            (void)check(scene, expected);
            EXPECT_GT(expected.all.size(), 10u);
            EXPECT_LT(expected.all.size(), scene.host.size() / 2);
            rig = Rig::create(*testDevice(), GetParam());
        }
    }
}

TEST_P(Bounds, EveryPlaneCullsByItself) {
    for (uint32_t plane = 0; plane < 6; ++plane) {
        Scene scene = randomScene(9, 200, 200, 40 + plane);
        Expected expected(scene);
        const std::array<float, 24> all = openView();
        std::copy_n(&all[4 * plane], 4, &scene.view.planes[4 * plane]);
        scene.view.planes[4 * plane + 3] -= plane == 5 ? 80.0f / 99.0f : 0.0f; // the far plane, into the scene
        (void)check(scene, expected);
        EXPECT_GT(expected.all.size(), 0u);
        EXPECT_LT(expected.all.size(), scene.host.size()) << "plane " << plane;
        rig = Rig::create(*testDevice(), GetParam());
    }
}

TEST_P(Bounds, DistanceAndSizeDecideWhereTheyAreSet) {
    for (const uint32_t kind : {0u, 1u, 2u, 3u}) {
        Scene scene = randomScene(8, 200, 64, 70 + kind);
        Expected expected(scene);
        scene.view.camera.position[0] = 5.0f;
        scene.view.camera.position[2] = -7.0f;
        scene.view.farthest = kind == 1 ? 40.0f : 0.0f;
        scene.view.camera.focal = 300.0f;
        scene.view.smallest = kind >= 2 ? 30.0f : 0.0f;
        scene.view.camera.orthographic = kind == 3 ? 1 : 0;
        if (kind == 3) {
            scene.view.camera.focal = 7.0f;
        }
        (void)check(scene, expected);
        if (kind == 0) {
            EXPECT_EQ(expected.all.size(), scene.host.size()) << "a view of zeros sees everything";
        } else {
            EXPECT_GT(expected.all.size(), 0u);
            EXPECT_LT(expected.all.size(), scene.host.size());
        }
        rig = Rig::create(*testDevice(), GetParam());
    }
}

TEST_P(Bounds, LevelsComeFromTheBoxAndGoWithTheList) {
    Scene scene = randomScene(40, 200, 64, 80);
    scene.view.camera.focal = 700.0f;
    scene.view.camera.errorScale = 3.0f;
    scene.view.camera.lengthScale = 1.0f / 3.0f;
    setPlanes(scene, openView());
    const Culled written = rig->run(scene);
    uint32_t entries = 0;
    for (const ListWindow& window : scene.windows()) {
        const uint32_t seen = written.arguments[kListHeaderWords * (1 + window.firstSlot / scene.windowSize)];
        for (uint32_t i = window.target; i < window.target + seen; ++i) {
            const uint32_t slot = window.firstSlot + (written.list[i] & kInstanceSlotMask);
            const glm::dvec3 low = written.bounds[2 * slot], high = written.bounds[2 * slot + 1];
            const double diagonal = glm::length(high - low) / (1.0 + 2.0 * kMargin);
            const double pixels = 700.0 / std::max(glm::length(0.5 * (low + high)) - 0.5 * diagonal, 0.01);
            const double level =
                std::min({kLongest * diagonal * pixels / 3.0, std::sqrt(3.0 * kBend * diagonal * pixels), 256.0});
            ASSERT_NEAR(written.bounds[2 * slot].w, level, 1e-3 * level) << "slot " << slot;
            ASSERT_EQ(std::bit_cast<float>(written.list[scene.slots + i]), written.bounds[2 * slot].w);
            ++entries;
        }
    }
    EXPECT_GT(entries, 10u);
}

// Whole bins of sizes go, the smallest first, those of a priority before the next one's, and no more than must.
TEST_P(Bounds, TheSmallestGoWhereThereIsNoRoom) {
    constexpr uint32_t kVertices = 100;
    for (const uint32_t room : {0u, 99u, 5000u, 20000u, 90000u}) {
        Scene scene = randomScene(6, 1000, 300, 85);
        scene.view.camera.focal = 700.0f;
        scene.view.ranks = 2u | 0u << 8 | 1u << 16 | 2u << 24;
        scene.room = room;
        scene.leastVertices = kVertices;
        setPlanes(scene, openView());
        const Culled written = rig->run(scene);
        std::map<uint32_t, uint32_t> byRank; // of those that are seen
        uint32_t seen = 0, drawn = 0, smallestDrawn = ~0u, largestDropped = 0;
        for (const uint32_t entry : scene.host) {
            const uint32_t slot = entry & kInstanceSlotMask, rank = written.states[2 * slot];
            if (rank == 0) {
                EXPECT_EQ(written.states[2 * slot + 1], 0u);
                continue;
            }
            const uint32_t priority = (entry >> kInstancePriorityShift) & 3u;
            const glm::dvec3 low = written.bounds[2 * slot], high = written.bounds[2 * slot + 1];
            const double pixels = 0.5 * glm::length(high - low) * 700.0 / glm::length(0.5 * (low + high));
            const double bin = std::clamp((std::log2(pixels) + 4.0) * 64.0, 0.0, 1023.0);
            const uint32_t ofPriority = scene.view.ranks >> (8 * priority) & 255u;
            EXPECT_NEAR(rank - 1.0 - ofPriority * kSizeBins, bin, 1.01) << "slot " << slot;
            ++seen;
            ++byRank[rank];
            if (written.states[2 * slot + 1] != 0) {
                ++drawn;
                smallestDrawn = std::min(smallestDrawn, rank);
            } else {
                largestDropped = std::max(largestDropped, rank);
            }
        }
        EXPECT_EQ(written.arguments[0], drawn);
        EXPECT_EQ(written.arguments[2], scene.host.size());
        EXPECT_EQ(written.arguments[3], seen - drawn);
        EXPECT_LE(drawn * kVertices, room);
        EXPECT_LT(largestDropped, smallestDrawn);
        if (drawn < seen) {
            EXPECT_GT((drawn + byRank[largestDropped]) * kVertices, room) << "the next bin would have had room";
        }
        std::printf("room for %u vertices: %u of %u seen are drawn\n", room, drawn, seen);
    }
}

TEST_P(Bounds, APastIsWhatWasSeenTheFrameBefore) {
    Scene scene = randomScene(6, 400, 150, 90);
    Expected expected(scene);
    std::mt19937 random(91);
    uint32_t withPast = 0, withoutPast = 0;
    for (uint32_t frame = 0; frame < 6; ++frame) {
        setPlanes(scene, openView());
        scene.view.planes[3] = 25.0f * (frame % 3); // a wall that comes and goes
        if (frame > 0) {
            for (uint32_t& entry : scene.host) {
                entry = (entry & ~kInstanceIsNew) | (random() % 5 == 0 ? kInstanceIsNew : 0u);
            }
        }
        (void)check(scene, expected);
        for (const auto& window : expected.windows) {
            withPast += frame > 0 ? window[1] : 0;
            withoutPast += frame > 0 ? window[0] - window[1] : 0;
        }
    }
    EXPECT_GT(withPast, 50u);
    EXPECT_GT(withoutPast, 20u);
}

TEST_P(Bounds, VerticesThatAreNoNumbersDoNotHide) {
    std::mt19937 random(100);
    Scene scene(7, 6, 6);
    for (uint32_t slot = 0; slot < 6; ++slot) {
        scene.box(slot, {0.0f, 0.0f, 50.0f}, 1.0f, random); // behind the camera
    }
    scene.vertex(1, 3).y = kNaN;
    scene.vertex(2, 6).x = kInfinity;
    scene.vertex(3, 0).z = -kInfinity;
    for (uint32_t v = 0; v < 7; ++v) {
        scene.vertex(4, v) = glm::vec4(kNaN);
    }
    scene.addAll();
    setPlanes(scene, openView());
    Expected expected(scene);
    const Culled written = check(scene, expected);
    EXPECT_EQ(expected.all, (std::vector<uint32_t>{1, 2, 3, 4}));
    for (uint32_t slot = 0; slot < 6; ++slot) {
        EXPECT_EQ(written.bounds[2 * slot + 1].w, slot >= 1 && slot <= 4 ? 1.0f : 0.0f);
    }
    EXPECT_GT(written.bounds[8].x, written.bounds[9].x) << "a box of nothing";
}

TEST_P(Bounds, EmptyGroupsAndThoseOutOfSightHaveNothingToDo) {
    for (const bool listed : {false, true}) {
        std::mt19937 random(110);
        Scene scene(4, 50, 20);
        for (uint32_t slot = 0; slot < 50; ++slot) {
            scene.box(slot, {0.0f, 0.0f, 50.0f}, 1.0f, random);
        }
        if (listed) {
            scene.addAll();
        }
        setPlanes(scene, openView());
        scene.arguments = {{100, 32, kCountWindow, kWindowArguments}};
        Expected expected(scene);
        const Culled written = check(scene, expected);
        EXPECT_TRUE(expected.all.empty());
        for (uint32_t w = 0; w < 3; ++w) {
            const uint32_t* dispatch = &written.arguments[kWindowArguments + w * kArgumentStride];
            EXPECT_EQ(dispatch[0], 0u);
            EXPECT_EQ(dispatch[1], 1u);
            EXPECT_EQ(dispatch[2], 1u);
        }
        rig = Rig::create(*testDevice(), GetParam());
    }
}

TEST_P(Bounds, SeventyThousandInstances) {
    const uint32_t slots = 70'000;
    for (const uint32_t window : {slots, 30'000u}) {
        if (window == slots && GetParam() == SUPPLE_MAPPING_WIDE) {
            continue; // a workgroup an instance takes CPU devices long
        }
        Scene scene(1, slots, window);
        for (uint32_t slot = 0; slot < slots; ++slot) { // on a lattice that no plane touches
            const uint32_t row = slot / 100;
            const auto x = static_cast<float>(slot % 100), y = static_cast<float>(row);
            scene.vertex(slot, 0) = {x - 50.0f + 0.25f, 0.0f, -0.1f * y - 1.013f, 1.0f};
        }
        scene.addAll(0);
        setPlanes(scene, openView());
        for (uint32_t k = 0; k < 2; ++k) { // sides only, moved off the lattice
            scene.view.planes[4 * k + 3] = 0.017f;
        }
        scene.arguments = {{500, 32, kCountWindow, kWindowArguments},
                           {33, 4, kCountWindow, kWindowArguments + 4},
                           {64, 1, kCountWindow, kWindowArguments + 8}};
        Expected expected(scene);
        const Culled first = check(scene, expected);
        EXPECT_GT(expected.all.size(), 10'000u);
        EXPECT_LT(expected.all.size(), 60'000u);
        const Culled second = check(scene, expected);
        if (GetParam() == SUPPLE_MAPPING_NARROW) {
            const Culled third = rig->run(scene);
            EXPECT_EQ(third.list, second.list);
            EXPECT_EQ(third.arguments, second.arguments);
        }
        bool split = false;
        for (const Culled* written : {&first, &second}) {
            for (uint32_t w = 0; w < expected.windows.size(); ++w) {
                const uint32_t seen = expected.windows[w][0];
                const uint64_t groups[3] = {(uint64_t{seen} * 500 + 31) / 32, (uint64_t{seen} * 33 + 3) / 4,
                                            uint64_t{seen} * 64};
                for (uint32_t k = 0; k < 3; ++k) {
                    const uint32_t* dispatch = &written->arguments[kWindowArguments + w * kArgumentStride + 4 * k];
                    const uint64_t made = uint64_t{dispatch[0]} * dispatch[1];
                    EXPECT_LE(dispatch[0], 65535u);
                    EXPECT_GE(made, groups[k]);
                    EXPECT_LT(made - groups[k], dispatch[1]);
                    EXPECT_EQ(dispatch[2], 1u);
                    split = split || dispatch[1] > 1;
                }
            }
        }
        EXPECT_TRUE(split);
        rig = Rig::create(*testDevice(), GetParam());
    }
}

TEST_P(Bounds, WhatAPyramidHidesIsHiddenAndNothingElse) {
    // Walls at different depths over parts of the picture, and boxes before, behind and across them, near the origin
    // and so far from it that the projection rounds depths by more than what boxes just before a wall lie before it.
    for (const glm::vec3 eye : {glm::vec3(0.0f), glm::vec3(7000.0f, -2000.0f, 10000.0f)}) {
        for (const auto& [reversed, size] :
             {std::pair(false, glm::uvec2(256, 128)), std::pair(false, glm::uvec2(201, 117)),
              std::pair(true, glm::uvec2(256, 128)), std::pair(true, glm::uvec2(201, 117))}) {
            std::mt19937 random(130);
            std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
            Scene scene(6, 1500, 700);
            Pyramid& pyramid = scene.pyramid;
            pyramid.width = size.x;
            pyramid.height = size.y;
            pyramid.reversed = reversed;
            pyramid.columns = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -100.0f / 99.0f, -1, 0, 0, -100.0f / 99.0f, 0};
            if (reversed) {
                pyramid.columns[10] = -1.0f - pyramid.columns[10];
                pyramid.columns[14] = -pyramid.columns[14];
            }
            // Turned, so that all terms are large far from the origin.
            const glm::dmat3 turn = eye == glm::vec3(0.0f)
                                        ? glm::dmat3(1.0)
                                        : glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.6, 0.7, 0.4)));
            glm::dmat4 matrix;
            for (int k = 0; k < 16; ++k) {
                matrix[k / 4][k % 4] = static_cast<double>(pyramid.columns[static_cast<size_t>(k)]);
            }
            matrix = matrix * glm::dmat4(turn) * glm::translate(glm::dmat4(1.0), -glm::dvec3(eye));
            for (int k = 0; k < 16; ++k) {
                pyramid.columns[static_cast<size_t>(k)] = static_cast<float>(matrix[k / 4][k % 4]);
            }
            const auto world = [&](glm::dvec3 p) { return glm::dvec3(eye) + glm::transpose(turn) * p; };
            const auto clip = [&](glm::dvec3 p) {
                glm::dvec4 q;
                for (int row = 0; row < 4; ++row) {
                    const float* c = &pyramid.columns[static_cast<size_t>(row)];
                    q[row] = static_cast<double>(c[0]) * p.x + static_cast<double>(c[4]) * p.y +
                             static_cast<double>(c[8]) * p.z + static_cast<double>(c[12]);
                }
                return q;
            };
            const auto depthAt = [&](float distance) {
                const glm::dvec4 q = clip(world({0.0, 0.0, -distance}));
                return static_cast<float>(q.z / q.w);
            };
            std::vector<float> depths(size_t{size.x} * size.y, depthAt(100.0f));
            for (uint32_t y = 0; y < size.y; ++y) {
                for (uint32_t x = 0; x < size.x; ++x) {
                    float& depth = depths[size_t{y} * size.x + x];
                    if (x < size.x / 2 && y > size.y / 5) {
                        depth = depthAt(12.0f);
                    } else if (x > size.x * 2 / 3) {
                        depth = depthAt(30.0f + 20.0f * static_cast<float>(y) / static_cast<float>(size.y));
                    }
                }
            }
            pyramid.build(depths);
            for (uint32_t slot = 0; slot < scene.slots; ++slot) {
                const float away = slot % 3 == 0 ? 12.0f : 3.0f + 57.0f * std::abs(unit(random));
                scene.box(slot, world({0.98f * away * unit(random), 0.98f * away * unit(random), -away}),
                          0.01f + 0.08f * away * std::abs(unit(random)), random);
                if (slot % 3 == 0) { // just before a wall
                    glm::vec3 low(1e30f), high(-1e30f);
                    for (uint32_t v = 0; v < scene.vertexCount; ++v) {
                        low = glm::min(low, glm::vec3(scene.vertex(slot, v)));
                        high = glm::max(high, glm::vec3(scene.vertex(slot, v)));
                    }
                    const glm::dvec3 extent = (0.5 + static_cast<double>(kMargin)) * glm::dvec3(high - low);
                    const glm::dvec3 back = glm::transpose(turn) * glm::dvec3(0.0, 0.0, 1.0);
                    const double nearest = glm::dot(0.5 * glm::dvec3(low + high) - glm::dvec3(eye), back) +
                                           glm::dot(extent, glm::abs(back));
                    const glm::vec3 shift =
                        back * (-12.0 + 0.02 * static_cast<double>(std::abs(unit(random))) - nearest);
                    for (uint32_t v = 0; v < scene.vertexCount; ++v) {
                        scene.vertex(slot, v) += glm::vec4(shift, 0.0f);
                    }
                }
            }
            scene.vertex(7, 2).x = kNaN;
            scene.addAll();
            const Culled written = rig->run(scene);
            uint32_t hidden = 0, couldBe = 0, seen = 0;
            for (uint32_t slot = 0; slot < scene.slots; ++slot) {
                // On the CPU from every pixel that the box touches.
                const glm::dvec3 low = written.bounds[2 * slot], high = written.bounds[2 * slot + 1];
                glm::dvec2 least(1e30), most(-1e30);
                double nearest = reversed ? 0.0 : 1.0;
                bool known = written.bounds[2 * slot + 1].w == 0.0f;
                for (uint32_t k = 0; k < 8; ++k) {
                    const glm::dvec3 p((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                                       (k & 4) != 0 ? high.z : low.z);
                    const glm::dvec4 q = clip(p);
                    const double depth = q.z / q.w;
                    known = known && q.w > 0.0;
                    const glm::dvec2 at = (0.5 * glm::dvec2(q) / q.w + 0.5) * glm::dvec2(size);
                    least = glm::min(least, at);
                    most = glm::max(most, at);
                    nearest = reversed ? std::max(nearest, depth) : std::min(nearest, depth);
                }
                known = known && least.x >= 0.0 && least.y >= 0.0 && most.x < size.x && most.y < size.y;
                const double wall =
                    known ? static_cast<double>(pyramid.farthest(glm::floor(least), glm::floor(most))) : 0.0;
                const bool behind = known && (reversed ? nearest < wall : nearest > wall);
                const bool gone = written.states[2 * slot] == 0; // the view sees everything
                EXPECT_TRUE(!gone || behind) << "slot " << slot << " is seen";
                couldBe += behind ? 1 : 0;
                hidden += gone ? 1 : 0;
                seen += gone ? 0 : 1;
            }
            EXPECT_EQ(written.arguments[0], seen);
            EXPECT_EQ(written.arguments[4], hidden);
            EXPECT_GT(couldBe, 200u);
            EXPECT_GT(hidden * 10, couldBe * 7) << "of " << couldBe;
            EXPECT_LT(couldBe, scene.slots * 3 / 4);
            std::printf("%ux%u%s: %u hidden of %u\n", size.x, size.y, reversed ? " reversed" : "", hidden, couldBe);
            rig = Rig::create(*testDevice(), GetParam());
        }
    }
}

TEST(BoundsPlanes, AreThoseOfTheMatrix) {
    const std::array<float, 24> planes = openView();
    const auto inside = [&](glm::vec3 p) {
        for (uint32_t k = 0; k < 6; ++k) {
            if (planes[4 * k] * p.x + planes[4 * k + 1] * p.y + planes[4 * k + 2] * p.z + planes[4 * k + 3] < 0.0f) {
                return false;
            }
        }
        return true;
    };
    EXPECT_TRUE(inside({0.0f, 0.0f, -2.0f}));
    EXPECT_TRUE(inside({9.0f, -9.0f, -10.0f}));
    EXPECT_FALSE(inside({11.0f, 0.0f, -10.0f}));
    EXPECT_FALSE(inside({-11.0f, 0.0f, -10.0f}));
    EXPECT_FALSE(inside({0.0f, 11.0f, -10.0f}));
    EXPECT_FALSE(inside({0.0f, -11.0f, -10.0f}));
    EXPECT_FALSE(inside({0.0f, 0.0f, -0.9f}));
    EXPECT_FALSE(inside({0.0f, 0.0f, -101.0f}));
    EXPECT_FALSE(inside({0.0f, 0.0f, 2.0f}));
}

} // namespace
} // namespace supple::runtime
