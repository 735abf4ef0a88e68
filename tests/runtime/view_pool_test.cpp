// SuppleViewDesc.coefficientBytes: groups share a pool of coefficients, in which only what is drawn has room. Other
// suites can be run with one: SUPPLE_TEST_VIEW_COEFFICIENTS=33554432.
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace supple::test {
namespace {

constexpr uint32_t kInRow = 7;
constexpr uint32_t kPoolVertices = 400000;
constexpr uint32_t kPoolFlags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL;

/// PoolRows of instances, a group a row, before a camera that sees a few of them.
class PoolRows {
public:
    PoolRows(CrowdContext& context, SuppleScheme scheme, uint64_t coefficientBytes, uint32_t flags = kPoolFlags)
        : context_(context), scheme_(scheme), view_(context, kPoolVertices, flags, 0, coefficientBytes) {
        view_.camera.smallestEdge = 40.0f;
        look(0.0f);
    }
    /// Cages of different sizes, so that instances take different parts of the pool.
    void addRow() {
        const auto number = static_cast<uint32_t>(crowds_.size());
        SuppleGroupDesc desc{};
        desc.asset = context_.createAsset(perturbed(cage::makeCubeSphere(2 + number % 3), 0.05f, number));
        desc.capacity = kInRow;
        desc.scheme = scheme_;
        desc.view = view_.handle();
        crowds_.push_back(std::make_unique<Crowd>(context_, desc));
        groups_.push_back(crowds_.back()->group());
        for (uint32_t i = 0; i < kInRow; ++i) {
            instances_.push_back(crowds_.back()->spawn());
            place(number, i, 0.0f);
        }
    }
    void place(uint32_t row, uint32_t i, float shift) {
        crowds_[row]->pose(instances_[kInRow * row + i], SUPPLE_BIND_POSE, 0.0,
                           glm::translate(glm::mat4(1.0f), {2.6f * static_cast<float>(i) + shift,
                                                            2.6f * static_cast<float>(row), 0.0f}));
    }
    /// `x`: of the camera, which sees about three instances side by side.
    void look(float x) {
        const glm::vec3 from(x, 2.0f, 14.0f);
        const glm::mat4 both = glm::perspectiveRH_ZO(0.6f, 1.0f, 0.1f, 100.0f) *
                               glm::lookAt(from, glm::vec3(x, 2.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(view_.camera.viewProjection, &both, sizeof both);
        view_.look(from);
    }
    void run() { context_.run(groups_); }
    void cancel() { context_.cancel(groups_); }
    [[nodiscard]] std::vector<DrawnPatches> drawn() const {
        std::vector<DrawnPatches> all;
        for (const std::unique_ptr<Crowd>& crowd : crowds_) {
            all.push_back(drawnPatches(*crowd));
        }
        return all;
    }
    [[nodiscard]] SuppleViewStatistics statistics() {
        context_.beginFrame(); // what the last frame found out
        return view_.statistics();
    }
    [[nodiscard]] uint64_t coefficientsOfGroups() const {
        uint64_t bytes = 0;
        for (const SuppleGroup group : groups_) {
            SuppleMemoryUse memory{};
            memory.structSize = sizeof(memory);
            EXPECT_EQ(suppleGetGroupMemory(context_.handle(), group, &memory), SUPPLE_OK);
            bytes += memory.coefficients;
        }
        return bytes;
    }

private:
    CrowdContext& context_;
    SuppleScheme scheme_;
    TestView view_;
    std::vector<std::unique_ptr<Crowd>> crowds_;
    std::vector<SuppleGroup> groups_;
    std::vector<SuppleInstance> instances_;
};

class ViewPool : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, ViewPool, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(ViewPool, DrawsTheSameBitsWhileInstancesComeAndGo) {
    CrowdContext& own = context(GetParam());
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND}) {
        SCOPED_TRACE(scheme);
        const ValidationGuard guard;
        PoolRows expected(own, scheme, 0), rows(own, scheme, 16u << 20);
        size_t patches = 0;
        for (uint32_t frame = 0; frame < 8; ++frame) {
            for (PoolRows* scene : {&expected, &rows}) {
                if (frame == 0 || frame == 2 || frame == 5) {
                    scene->addRow();
                }
                scene->look(2.0f * static_cast<float>(frame));
                scene->place(0, frame % kInRow, 0.3f); // one that moves
                if (frame == 4) {
                    scene->cancel();
                }
                scene->run();
            }
            const std::vector<DrawnPatches> drawn = rows.drawn();
            EXPECT_TRUE(drawn == expected.drawn()) << "frame " << frame;
            patches += drawn.front().size();
        }
        EXPECT_GT(patches, 100u);
        const SuppleViewStatistics statistics = rows.statistics();
        EXPECT_EQ(statistics.droppedInstanceCount, 0u);
        EXPECT_GT(statistics.drawnInstanceCount, 3u);
        EXPECT_LT(statistics.drawnInstanceCount, 15u);
        EXPECT_EQ(rows.coefficientsOfGroups(), 0u);
        EXPECT_LT(statistics.coefficientBytes * 21, expected.coefficientsOfGroups() * 15) << "motion has two pools";
    }
}

TEST_P(ViewPool, WithoutRoomTheSmallestAreMissing) {
    CrowdContext& own = context(GetParam());
    const ValidationGuard guard;
    PoolRows all(own, SUPPLE_SCHEME_PM, 1u << 20, SUPPLE_VIEW_MOTION); // nothing is culled
    for (uint32_t row = 0; row < 3; ++row) {
        all.addRow();
    }
    all.run();
    const SuppleViewStatistics roomy = all.statistics();
    EXPECT_EQ(roomy.drawnInstanceCount, 3 * kInRow);
    const uint64_t bytes = roomy.coefficientBytes;
    PoolRows few(own, SUPPLE_SCHEME_PM, bytes / 2, SUPPLE_VIEW_MOTION),
        enough(own, SUPPLE_SCHEME_PM, bytes, SUPPLE_VIEW_MOTION);
    for (uint32_t row = 0; row < 3; ++row) {
        few.addRow();
        enough.addRow();
    }
    for (uint32_t frame = 0; frame < 3; ++frame) {
        for (PoolRows* scene : {&all, &few, &enough}) {
            scene->run();
        }
        EXPECT_TRUE(enough.drawn() == all.drawn());
        const std::vector<DrawnPatches> expected = all.drawn(), drawn = few.drawn();
        for (size_t row = 0; row < drawn.size(); ++row) {
            for (const auto& [key, corners] : drawn[row]) {
                ASSERT_TRUE(expected[row].at(key) == corners) << "row " << row << ", slot " << key.slot;
            }
        }
    }
    const SuppleViewStatistics statistics = few.statistics();
    EXPECT_EQ(statistics.shortfall, 1u);
    EXPECT_GT(statistics.droppedInstanceCount, 0u);
    EXPECT_GT(statistics.drawnInstanceCount, 0u);
    EXPECT_EQ(statistics.droppedInstanceCount + statistics.drawnInstanceCount, 3 * kInRow);
    EXPECT_LE(statistics.coefficientBytes, bytes / 2);
    EXPECT_EQ(enough.statistics().droppedInstanceCount, 0u);
}

TEST_P(ViewPool, GroupsWhoseInstancesAreTooLargeAreRefused) {
    CrowdContext& own = context(GetParam());
    TestView view(own, kPoolVertices, 0, 0, 4096);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = own.createAsset(cage::makeCubeSphere(4));
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.view = view.handle();
    SuppleGroup group{};
    (void)own.takeLines();
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_LIMIT);
    const std::vector<LogLine> lines = own.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].text.find("bytes of coefficients, the view has room for 4096"), std::string::npos)
        << lines[0].text;
}

} // namespace
} // namespace supple::test
