// Views: groups drawn at levels of detail, as the device wrote them.
#include "cage/procedural.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>
#include <set>

namespace supple::test {
namespace {

class LodViews : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodViews, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

/// A view, and its camera.
class TestView {
public:
    TestView(CrowdContext& context, uint32_t maxVertices, uint32_t flags = 0) : context_(context) {
        SuppleViewDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = flags;
        desc.maxVertices = maxVertices;
        desc.vertexFormat = SUPPLE_VERTEX_24;
        EXPECT_EQ(suppleCreateView(context.handle(), &desc, &view_), SUPPLE_OK);
        camera.structSize = sizeof(camera);
        camera.pixelsPerUnit = 869.0f; // 720 lines, 45 degrees
    }
    ~TestView() { EXPECT_EQ(suppleDestroyView(context_.handle(), view_), SUPPLE_OK); }
    TestView(const TestView&) = delete;
    TestView& operator=(const TestView&) = delete;

    SuppleCameraDesc camera{};
    void look(glm::vec3 from) {
        camera.position[0] = from.x;
        camera.position[1] = from.y;
        camera.position[2] = from.z;
        EXPECT_EQ(suppleSetCamera(context_.handle(), view_, &camera), SUPPLE_OK);
    }
    [[nodiscard]] SuppleView handle() const { return view_; }
    [[nodiscard]] SuppleViewStatistics statistics() const {
        SuppleViewStatistics statistics{};
        statistics.structSize = sizeof(statistics);
        EXPECT_EQ(suppleGetViewStatistics(context_.handle(), view_, &statistics), SUPPLE_OK);
        return statistics;
    }

private:
    CrowdContext& context_;
    SuppleView view_{};
};

TEST_P(LodViews, ClosedCagesHaveNoCracks) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const struct {
        const char* name;
        cage::Cage cage;
    } cages[] = {{"cube sphere", perturbed(cage::makeCubeSphere(4), 0.05f, 3)},
                 {"split torus", perturbed(cage::makeSplitTorus(8, 7), 0.02f, 11)}};
    for (const auto& [name, cage] : cages) {
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM}) {
            TestView view(context, 400000);
            SuppleGroupDesc desc{};
            desc.asset = context.createAsset(cage);
            desc.capacity = 2;
            desc.scheme = scheme;
            desc.view = view.handle();
            Crowd crowd(context, desc);
            ASSERT_TRUE(crowd.valid());
            (void)crowd.spawn();
            std::set<uint32_t> capacities;
            for (const float distance : {40.0f, 9.0f, 4.0f, 2.2f, 1.6f}) {
                view.look({0.3f * distance, 0.2f * distance, 0.93f * distance});
                context.run(crowd.group());
                const LodSurface surface = readLodSurface(crowd);
                const Sides sides = matchSides(surface);
                EXPECT_EQ(surface.patches.size(), crowd.output().patchCount);
                EXPECT_GE(sides.triangles, 2 * surface.patches.size());
                EXPECT_EQ(sides.unmatched, 0u) << name << " at " << distance;
                for (const LodSurface::Patch& patch : surface.patches) {
                    capacities.insert(patch.capacity);
                }
                std::printf("%s, scheme %d, distance %4.1f: %zu patches, %zu triangles, %zu unmatched\n", name, scheme,
                            static_cast<double>(distance), surface.patches.size(), sides.triangles, sides.unmatched);
            }
            EXPECT_GE(capacities.size(), 4u);
        }
    }
}

} // namespace
} // namespace supple::test
