// Views in which nothing is drawn: in the first frame, in later ones, in turns with others; in memory that was used
// before.
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

namespace supple::test {
namespace {

constexpr SuppleScheme kSchemes[] = {SUPPLE_SCHEME_PREP,    SUPPLE_SCHEME_PM,    SUPPLE_SCHEME_CATMULL_CLARK,
                                     SUPPLE_SCHEME_LOOP,    SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_FRAGMENTS,
                                     SUPPLE_SCHEME_POLYGONS};
constexpr const char* kPatterns[] = {"ff", "3f", "01", "nan", "random"};
/// What happens before a frame: w a warm-up, c instances come, h all hide, v all are visible, a the camera looks away,
/// t towards them, x a frame is cancelled; and n a frame that draws nothing, s one that draws all.
constexpr const char* kScripts[] = {"tncs", "wacntshnvsantsat", "chtnnvs", "acnnhtnvsanntsshn", "ctsaxnntxanntxs"};

/// The layer of tests/poison, for devices that are made while it lives. The pattern can change from allocation to
/// allocation.
class Poison {
public:
    Poison() {
        keep("VK_ADD_LAYER_PATH", SUPPLE_POISON_DIR);
        keep("VK_INSTANCE_LAYERS", "VK_LAYER_SUPPLE_poison");
        keep("SUPPLE_POISON", "each");
    }
    ~Poison() {
        for (const auto& [name, value] : before_) {
            value ? setenv(name, value->c_str(), 1) : unsetenv(name);
        }
    }
    Poison(const Poison&) = delete;
    Poison& operator=(const Poison&) = delete;
    void use(const char* pattern) { setenv("SUPPLE_POISON", pattern, 1); }

private:
    void keep(const char* name, const char* value) {
        const char* const before = std::getenv(name);
        before_.emplace_back(name, before != nullptr ? std::optional<std::string>(before) : std::nullopt);
        setenv(name, value, 1);
    }
    std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

/// What draws of one of several rates show, as bits.
PositionBits drawnAtRates(const Crowd& crowd) {
    const host::GroupOutput output = crowd.output();
    const std::vector<std::byte> vertices = crowd.read(output.streams.vertices);
    const std::vector<VkDrawIndexedIndirectCommand> draws = crowd.draws();
    PositionBits positions;
    for (uint32_t r = 0; r < output.grid.rateCount; ++r) {
        const SuppleRate& rate = output.grid.rates[r];
        const auto slots = as<uint32_t>(crowd.read(rate.instances));
        for (uint32_t d = rate.firstDrawRange; d < rate.firstDrawRange + rate.drawRangeCount; ++d) {
            const SuppleDrawRange& range = output.grid.drawRanges[d];
            const uint32_t instances = draws[d].instanceCount / range.patchCount;
            for (uint32_t i = 0; i < instances && i < slots.size(); ++i) {
                const size_t first = size_t{slots[i]} * output.grid.verticesPerInstance + range.firstVertex;
                for (size_t v = first; v < first + size_t{range.patchCount} * range.samplesPerPatch; ++v) {
                    std::array<uint32_t, 3>& bits = positions.emplace_back();
                    std::memcpy(bits.data(), vertices.data() + v * output.streams.vertices.stride, sizeof bits);
                }
            }
        }
    }
    return positions;
}

/// The corners of all triangles, or all vertices, that are drawn; sorted, because atomics give places in any order.
PositionBits drawn(const Crowd& crowd) {
    PositionBits corners;
    if (crowd.output().hasLevels()) {
        const LodSurface surface = readLodSurface(crowd);
        for (const std::array<uint32_t, 3>& triangle : surface.triangles) {
            for (const uint32_t vertex : triangle) {
                corners.push_back(surface.positions[vertex]);
            }
        }
    } else {
        corners = drawnAtRates(crowd);
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// A group of a view of its own, and what a script does with it.
class Stage {
public:
    Stage(CrowdContext& context, SuppleAsset asset, SuppleScheme scheme, SupplePoseSource poses)
        : context_(context), view_(context, 300'000, SUPPLE_VIEW_CULL) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = kInstances;
        desc.scheme = scheme;
        desc.rate = 4;
        desc.view = view_.handle();
        desc.poseSource = poses;
        crowd_ = std::make_unique<Crowd>(context, desc);
        look(false);
    }
    [[nodiscard]] bool valid() const { return crowd_->valid(); }

    /// What the last frame that drew has drawn.
    PositionBits play(const char* script) {
        PositionBits last;
        for (const char* step = script; *step != '\0'; ++step) {
            SCOPED_TRACE(std::string(script).substr(0, static_cast<size_t>(step - script) + 1));
            if (*step == 'n' || *step == 's') {
                context_.run(crowd_->group());
                const PositionBits now = drawn(*crowd_);
                if (*step == 'n') {
                    EXPECT_EQ(now.size(), 0u);
                } else {
                    EXPECT_GT(now.size(), 0u);
                    EXPECT_TRUE(last.empty() || now == last) << "as it was before";
                    last = now;
                }
            } else {
                change(*step);
            }
        }
        return last;
    }

private:
    static constexpr uint32_t kInstances = 3;

    void change(char step) {
        switch (step) {
        case 'w':
            context_.beginFrame();
            ASSERT_TRUE(context_.device()
                            .submitAndWait([&](VkCommandBuffer commands) {
                                const SuppleGroup group = crowd_->group();
                                EXPECT_EQ(suppleRecordWarmUp(context_.handle(), commands, &group, 1), SUPPLE_OK);
                            })
                            .ok());
            break;
        case 'c':
            for (uint32_t i = 0; i < kInstances; ++i) {
                instances_.push_back(crowd_->spawn());
                const glm::mat4 place = glm::translate(glm::mat4(1.0f), {3.0f * static_cast<float>(i) - 3.0f, 0, 0});
                EXPECT_EQ(suppleSetTransform(context_.handle(), instances_.back(), &place[0][0]), SUPPLE_OK);
            }
            break;
        case 'x':
            context_.cancel(crowd_->group());
            break;
        case 'h':
        case 'v':
            for (const SuppleInstance instance : instances_) {
                crowd_->setVisible(instance, step == 'v');
            }
            break;
        default:
            look(step == 'a');
            break;
        }
    }
    void look(bool away) {
        const glm::vec3 eye(0, 0.5f, 8), target = eye + glm::vec3(0, 0, away ? 1 : -1);
        const glm::mat4 seen =
            glm::perspectiveRH_ZO(1.2f, 1.0f, 0.1f, 100.0f) * glm::lookAt(eye, target, glm::vec3(0, 1, 0));
        std::memcpy(view_.camera.viewProjection, &seen, sizeof seen);
        view_.camera.pixelsPerUnit = 200.0f;
        view_.look(eye);
    }

    CrowdContext& context_;
    TestView view_;
    std::unique_ptr<Crowd> crowd_;
    std::vector<SuppleInstance> instances_;
};

class Unseen : public testing::TestWithParam<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, Unseen, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(Unseen, NothingIsDrawnAndWhatComesAfterIsRight) {
    Poison poison;
    const std::unique_ptr<host::Device> device = deviceThrough(nullptr, std::getenv("SUPPLE_VALIDATION") != nullptr);
    ASSERT_NE(device, nullptr);
    CrowdContext context(*device, GetParam());
    ASSERT_TRUE(context.valid());
    const SuppleAsset quads = context.createAsset(perturbed(cage::makeCubeSphere(3), 0.05f, 3));
    const SuppleAsset tube = context.createAsset(tubeFile(), "tube");
    for (const SuppleScheme scheme : kSchemes) {
        for (const auto& [asset, poses] :
             {std::pair(quads, SUPPLE_POSES_SET), std::pair(tube, SUPPLE_POSES_PLAYBACK)}) {
            SCOPED_TRACE("scheme " + std::to_string(scheme) + ", poses " + std::to_string(poses));
            poison.use("zero");
            Stage plain(context, asset, scheme, poses);
            ASSERT_TRUE(plain.valid());
            const PositionBits expected = plain.play("cts");
            for (size_t p = 0; p < std::size(kPatterns); ++p) {
                SCOPED_TRACE(kPatterns[p]);
                poison.use(kPatterns[p]);
                // Each pattern with two of the scripts, in turn.
                for (const size_t s : {p % std::size(kScripts), (p + 1) % std::size(kScripts)}) {
                    Stage stage(context, asset, scheme, poses);
                    ASSERT_TRUE(stage.valid());
                    EXPECT_TRUE(stage.play(kScripts[s]) == expected) << kScripts[s];
                }
            }
        }
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
}

/// Where nothing was listed and nothing is to list, the list stands.
TEST(UnseenGroups, AreListedOnce) {
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext context(*device, mapping);
        const SuppleAsset cube = context.createAsset(perturbed(cage::makeCubeSphere(1), 0.05f, 3));
        Stage stage(context, cube, SUPPLE_SCHEME_PM, SUPPLE_POSES_SET);
        ASSERT_TRUE(stage.valid());
        const auto dispatchesIn = [&](const char* frame) {
            wrapped.dispatches = 0;
            (void)stage.play(frame);
            return wrapped.dispatches;
        };
        (void)stage.play("ctsa");
        const uint64_t listed = dispatchesIn("n"), stands = dispatchesIn("n");
        EXPECT_EQ(stands + 1, listed);
        EXPECT_EQ(dispatchesIn("n"), stands);
        (void)stage.play("tsax"); // the frame that listed nothing never ran
        EXPECT_EQ(dispatchesIn("n"), listed);
        EXPECT_EQ(dispatchesIn("n"), stands);
        (void)stage.play("ts");
    }
    (void)wrappedVulkan();
}

} // namespace
} // namespace supple::test
