// Legends of the views: each says what its colors stand for, or why there is nothing to see.
#include "tools/supple/legend.h"

#include "tests/tools/validated_device.h"
#include "tools/common/figure_file.h"
#include "tools/supple/views.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace supple::tools {
namespace {

uint32_t viewOf(const std::string& name) {
    for (const NamedView& known : kViews) {
        if (known.name == name)
            return known.view;
    }
    ADD_FAILURE() << name;
    return 0;
}

/// Of a figure that has all that views show.
ViewFacts everything() {
    ViewFacts facts;
    facts.uvs = facts.secondUvs = facts.vertexColors = true;
    facts.normalMaps = facts.occlusionMaps = facts.emission = facts.jointMoves = true;
    facts.patchClasses = 1u << SUPPLE_PATCH_REGULAR | 1u << SUPPLE_PATCH_P5;
    facts.joint = "head";
    return facts;
}

TEST(Legends, EveryViewButTheShadedOneHasOne) {
    for (const NamedView& known : kViews) {
        const std::optional<Legend> legend = legendOf(known.view, everything());
        ASSERT_EQ(legend.has_value(), known.view != host::shared::kViewShaded) << known.name;
        EXPECT_TRUE(!legend || !legend->title.empty() || legend->swatches.size() == 2) << known.name;
        EXPECT_TRUE(!legend || (legend->bar == Legend::Bar::none) == legend->marks.empty()) << known.name;
    }
    EXPECT_EQ(legendOf(viewOf("weights"), everything())->title, "weight of head");
    EXPECT_EQ(legendOf(viewOf("patches"), everything())->swatches[1].text, "P_5");
}

TEST(Legends, SayWhyThereIsNothingToSee) {
    const std::map<std::string, std::string> reasons = {{"uv", "the file has no texture coordinates"},
                                                        {"uv1", "the file has no second texture coordinates"},
                                                        {"vertex-color", "the file has no vertex colors"},
                                                        {"normal-map", "no material has a normal map"},
                                                        {"occlusion", "no material has an occlusion map"},
                                                        {"emissive", "no material emits light"},
                                                        {"weights", "joint  moves no vertex"},
                                                        {"patches", "there are no patches"}};
    for (const auto& [name, reason] : reasons) {
        const std::optional<Legend> legend = legendOf(viewOf(name), {});
        ASSERT_TRUE(legend.has_value()) << name;
        EXPECT_EQ(legend->title, reason);
        EXPECT_TRUE(legend->bar == Legend::Bar::none && legend->swatches.empty()) << name;
    }
}

TEST(Legends, StayWithinThePicture) {
    for (const NamedView& known : kViews) {
        const std::optional<Legend> legend = legendOf(known.view, everything());
        for (const uint32_t size : {1u, 16u, 90u, 200u, 480u, 1200u}) {
            host::Picture picture = host::Picture::blank(size, size);
            const std::vector<uint8_t> before = picture.rgba;
            if (legend)
                drawLegend(picture, *legend);
            if (size <= 16 || size >= 1200) { // it has room, or has none
                EXPECT_EQ(picture.rgba != before, legend && size >= 1200) << known.name << " " << size;
            }
        }
    }
}

/// Pip has one set of texture coordinates, vertex colors, and no maps but the base color.
TEST(Legends, KnowWhatAFigureHas) {
    Result<std::unique_ptr<host::Device>> device = host::createValidatedDevice();
    ASSERT_TRUE(device.ok()) << device.error().message;
    {
        Result<std::unique_ptr<host::Context>> context = host::Context::create(**device);
        ASSERT_TRUE(context.ok());
        const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
        Result<std::unique_ptr<host::Figure>> figure = host::openFigure(**context, path);
        ASSERT_TRUE(figure.ok()) << figure.error().message;
        host::GroupOptions options;
        options.rate = 2;
        options.scheme = SUPPLE_SCHEME_PM;
        Result<std::unique_ptr<host::FigureGroup>> group = host::FigureGroup::create(**figure, options);
        ASSERT_TRUE(group.ok()) << group.error().message;
        ASSERT_TRUE((*group)->showWeights(0).ok());
        const ViewFacts still = viewFactsOf(**group, 0);
        EXPECT_TRUE(still.uvs && !still.secondUvs && still.vertexColors);
        EXPECT_TRUE(!still.normalMaps && !still.occlusionMaps && !still.emission);
        EXPECT_FALSE(still.jointMoves) << "the root";
        EXPECT_NE(still.patchClasses & 1u << SUPPLE_PATCH_P4, 0u);
        EXPECT_EQ(still.patchClasses & 1u << SUPPLE_PATCH_IRREGULAR, 0u);
        const auto& names = (*figure)->jointNames();
        const auto chest = static_cast<uint32_t>(std::find(names.begin(), names.end(), "chest") - names.begin());
        ASSERT_LT(chest, names.size());
        ASSERT_TRUE((*group)->showWeights(chest).ok());
        const ViewFacts moved = viewFactsOf(**group, chest);
        EXPECT_TRUE(moved.jointMoves);
        EXPECT_EQ(moved.joint, "chest");
    }
    EXPECT_EQ((*device)->validation()->messageCount(), 0u);
}

} // namespace
} // namespace supple::tools
