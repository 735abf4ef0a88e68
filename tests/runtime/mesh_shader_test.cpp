// Groups with SUPPLE_GROUP_DIRECT drawn by a mesh shader, over shaders/supple_patch_tiles.glsl: positions have the bits
// of stored vertices, and pictures are those of a vertex shader, for all classes of patches, whole and in tiles. The
// tiles that the shader counts are those of grids.
#include "shaders/direct_mesh.h"
#include "shaders/direct_mesh_SUPPLE_PATCH_TEXELS.h"
#include "shaders/supple_patch_tiles.h"
#include "tests/runtime/direct_groups.h"
#include "tests/support/sample_assets.h"

#include <cstdlib>
#include <set>

namespace supple::test {
namespace {

struct MeshPush {
    PictureWindow window;
    SupplePatchRange range{};
    uint32_t commandWord = 0;
    uint32_t verticesPerInstance = 0;
};

/// A device with mesh shaders; null where there is none. It is made once.
host::Device* meshDevice() {
    static const std::unique_ptr<host::Device> own = [] {
        host::DeviceOptions options;
        options.validation = std::getenv("SUPPLE_VALIDATION") != nullptr;
        options.meshShaders = true;
        Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
        if (!device) {
            std::printf("no mesh shaders: %s\n", device.error().message.c_str());
            return std::unique_ptr<host::Device>();
        }
        std::printf("mesh shaders on %s\n", (*device)->name().c_str());
        return std::move(*device);
    }();
    return own.get();
}

class MeshShaders : public testing::Test {
protected:
    void SetUp() override {
        if (meshDevice() != nullptr) {
            messages_ = meshDevice()->validation()->messageCount();
            return;
        }
        // Where a driver with mesh shaders is at hand, the build says so (tests/runtime/CMakeLists.txt).
        ASSERT_EQ(std::getenv("SUPPLE_TEST_MESH_SHADERS"), nullptr) << "the device has no mesh shaders";
        GTEST_SKIP() << "left out: the device has no mesh shaders. tools/lavapipe.sh fetches a driver that has";
    }
    void TearDown() override {
        if (meshDevice() != nullptr) {
            EXPECT_EQ(meshDevice()->validation()->messageCount(), messages_) << "the validation layer spoke";
        }
    }

private:
    uint32_t messages_ = 0;
};

struct Drawn {
    host::Picture picture;
    std::vector<glm::vec3> vertices; ///< a position and a normal each, as SUPPLE_VERTEX_24 has them
};

/// Draws groups by direct.mesh.
class MeshPictures {
public:
    MeshPictures(host::Device& device, bool texels)
        : device_(device), canvas_(device), set_(device, kMesh, texels),
          layout_(*host::createPipelineLayout(device, {set_.layout()}, sizeof(MeshPush), kMesh)) {
        host::GraphicsDesc desc = Canvas::pipelineDesc("test mesh shader");
        desc.layout = layout_;
        desc.meshShader = texels ? std::span<const uint32_t>(direct_mesh_SUPPLE_PATCH_TEXELS)
                                 : std::span<const uint32_t>(direct_mesh);
        desc.fragmentShader = prop_frag;
        pipeline_ = *host::createGraphicsPipeline(device, desc);
    }

    /// `instances`: how many workgroups are asked for, as if no more could be visible.
    Drawn draw(const Crowd& crowd, uint32_t instances) {
        const SuppleGridOutput grid = crowd.output().grid;
        const SuppleDirectOutput from = directOutput(crowd);
        const std::vector<glm::vec3> none(size_t{2} * instances * grid.verticesPerInstance);
        const host::Buffer made =
            std::move(*device_.uploadBuffer(none.data(), none.size() * sizeof(glm::vec3),
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT));
        set_.write(grid, from, made.handle());
        host::Picture picture = canvas_.draw([&](VkCommandBuffer commands) {
            const VkDescriptorSet set = set_.set();
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0, nullptr);
            for (uint32_t r = 0; r < from.rangeCount; ++r) {
                const SupplePatchRange& range = from.ranges[r];
                const VkDeviceSize command = grid.indirect.offset + VkDeviceSize{r} * grid.indirect.stride;
                const MeshPush push{{}, range, static_cast<uint32_t>(command / 4), grid.verticesPerInstance};
                vkCmdPushConstants(commands, layout_, kMesh, 0, sizeof(push), &push);
                device_.drawMeshTasks()(commands, SUPPLE_PATCH_TILES(range.patchClass, range.rate), range.patchCount,
                                        instances);
            }
        });
        return {std::move(picture),
                as<glm::vec3>(*device_.readBuffer(made.handle(), 0, none.size() * sizeof(glm::vec3)))};
    }

private:
    static constexpr VkShaderStageFlags kMesh = VK_SHADER_STAGE_MESH_BIT_EXT;

    host::Device& device_;
    Canvas canvas_;
    DirectSet set_;
    VkPipelineLayout layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

/// A few cages that have all classes.
std::vector<Subject> someSubjects() {
    return {{"pentagons round a fan", SUPPLE_SCHEME_PM, perturbed(fanOverPentagons(5), 0.02f, 1)},
            {"triangles round a fan", SUPPLE_SCHEME_PM, perturbed(fanOverTriangles(4), 0.02f, 2)},
            {"quads round a fan", SUPPLE_SCHEME_PM, perturbed(fanOverQuads(5), 0.02f, 3)},
            {"capped cylinder", SUPPLE_SCHEME_PM, perturbed(cappedCylinder(6, 3), 0.02f, 4)},
            {"grid, p-rep", SUPPLE_SCHEME_PREP, perturbed(grid(3, 2), 0.02f, 5), SUPPLE_CORNERS_SMOOTH},
            {"jack, p-rep", SUPPLE_SCHEME_PREP, perturbed(jack(), 0.02f, 6)}};
}

/// Whole patches, the last rate that has them, tiles that fill patches, and tiles that do not.
TEST_F(MeshShaders, DrawWhatVertexShadersDraw) {
    CrowdContext own(*meshDevice());
    ASSERT_TRUE(own.valid());
    DirectPictures vertex(*meshDevice());
    MeshPictures pictures(*meshDevice(), true);
    std::set<uint32_t> classes;
    Compared compared;
    for (const Subject& subject : someSubjects()) {
        Pair pair = pairOf(own, subject);
        ASSERT_TRUE(pair.valid()) << subject.name;
        for (const uint32_t rate : {16u, 13u, 11u, 8u, 3u, 1u}) {
            pair.setRate(rate);
            pair.run();
            const Drawn drawn = pictures.draw(pair.direct, 2);
            const std::string what = subject.name + " at rate " + std::to_string(rate);
            EXPECT_EQ(drawn.picture.rgba, vertex.direct(pair.direct, true).rgba) << what;
            Compared here;
            here.add(pair.stored, drawn.vertices, 0);
            here.add(pair.stored, drawn.vertices, 1);
            EXPECT_EQ(here.different, 0u) << what;
            EXPECT_LT(here.largestTurn, 0.01f) << what;
            compared.join(here);
        }
        const SuppleDirectOutput output = directOutput(pair.direct);
        for (const SupplePatchRange& range : std::span(output.ranges, output.rangeCount)) {
            classes.insert(range.patchClass);
        }
    }
    compared.expectSame("all classes, by a mesh shader");
    EXPECT_EQ(classes, (std::set<uint32_t>{SUPPLE_PATCH_REGULAR, SUPPLE_PATCH_PERTURBED, SUPPLE_PATCH_POLAR,
                                           SUPPLE_PATCH_P3, SUPPLE_PATCH_P4, SUPPLE_PATCH_P5}));
}

/// From storage buffers. More workgroups are asked for than instances are visible, and one of those hides a part: the
/// commands say so.
TEST_F(MeshShaders, DrawWhoIsVisible) {
    CrowdContext own(*meshDevice());
    SuppleGroupDesc desc{};
    desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb"); // three materials
    desc.capacity = 4;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 5;
    Crowd direct(own, Pair::withFlag(desc));
    ASSERT_TRUE(direct.valid());
    for (uint32_t i = 0; i < 3; ++i) {
        const SuppleInstance instance = direct.spawn();
        direct.pose(instance, SUPPLE_BIND_POSE, 0.0,
                    glm::translate(glm::mat4(1.0f), {0.8f * static_cast<float>(i) - 0.8f, 0.0f, 0.0f}));
        EXPECT_EQ(suppleSetPartVisible(own.handle(), instance, 0, i == 1 ? 0 : 1), SUPPLE_OK);
        direct.setVisible(instance, i != 0);
    }
    own.run(direct.group());
    DirectPictures vertex(*meshDevice());
    const host::Picture wanted = vertex.direct(direct, true);
    EXPECT_NE(wanted.rgba, Canvas::blank().rgba);
    EXPECT_EQ(MeshPictures(*meshDevice(), false).draw(direct, desc.capacity).picture.rgba, wanted.rgba);
}

} // namespace
} // namespace supple::test
