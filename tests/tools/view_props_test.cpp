// What the viewer attaches, without its window: it moves with the figure, and covers what it should.
#include "tools/supple/view_props.h"

#include "tests/tools/validated_device.h"
#include "tools/supple/view_stage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

namespace supple::tools {
namespace {

constexpr VkExtent2D kPropsSize{320, 240};
constexpr float kPropsAspect = 320.0f / 240.0f;

/// A stage with a file, and where its pictures go.
class PropsStage {
public:
    bool open(const std::string& file) {
        Result<std::unique_ptr<host::Device>> device = host::createValidatedDevice();
        if (!device)
            return false;
        device_ = std::move(*device);
        validation_ = device_->validation();
        Result<std::unique_ptr<host::Context>> context = host::Context::create(*device_, {.framesInFlight = 2});
        if (!context)
            return false;
        context_ = std::move(*context);
        Result<std::unique_ptr<host::SurfaceRenderer>> renderer =
            host::SurfaceRenderer::create(*device_, {.quality = host::StudioQuality::fast(), .framesInFlight = 2});
        if (!renderer)
            return false;
        renderer_ = std::move(*renderer);
        Result<host::DrawTarget> target = host::DrawTarget::create(*device_, kPropsSize, renderer_->samples());
        DrawOptions options;
        options.rate = 4;
        options.scheme = "catmull-clark";
        Result<std::unique_ptr<ViewStage>> stage = ViewStage::create(*context_, *renderer_, options);
        if (!target || !stage)
            return false;
        target_ = std::move(*target);
        stage_ = std::move(*stage);
        return stage_->open(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + file, "walk", kPropsAspect).ok();
    }
    [[nodiscard]] ViewStage& stage() const { return *stage_; }
    [[nodiscard]] host::SurfaceRenderer& renderer() const { return *renderer_; }
    [[nodiscard]] host::Context& context() const { return *context_; }
    [[nodiscard]] uint32_t messages() const { return validation_->messageCount(); }

    /// With what the stage has attached, or these instead.
    host::Picture draw(const host::Attachments* attachments = nullptr) {
        const uint64_t frame = context_->nextFrame();
        const Status drawn = device_->submitAndWait([&](VkCommandBuffer commands) {
            Status recorded = stage_->evaluate(commands, frame, frame - 1, kPropsSize.height);
            host::Scene scene = stage_->scene(kPropsSize);
            scene.attachments = attachments != nullptr ? attachments : scene.attachments;
            if (recorded)
                recorded = renderer_->prepare(scene);
            if (recorded)
                renderer_->record(commands, 0, target_, scene);
            EXPECT_TRUE(recorded.ok()) << recorded.error().message;
        });
        EXPECT_TRUE(drawn.ok());
        Result<host::Picture> picture = host::readPicture(*device_, target_.color());
        EXPECT_TRUE(picture.ok());
        return picture ? std::move(*picture) : host::Picture{};
    }
    /// What the surface is at points, in the pose that was drawn last, or in the bind pose.
    std::vector<SuppleSurfaceJet> jetsAt(std::vector<SuppleSurfacePoint> points, bool posed = true) const {
        const Result<std::vector<glm::vec3>> cage = stage_->group().readCage();
        std::vector<SuppleSurfaceJet> jets(points.size());
        SupplePointQuery query{};
        query.structSize = sizeof query;
        query.kind = SUPPLE_FIND_GIVEN;
        query.count = static_cast<uint32_t>(points.size());
        query.cage = posed ? &cage->front().x : nullptr;
        query.cageVertexCount = posed ? static_cast<uint32_t>(cage->size()) : 0;
        query.jets = jets.data();
        EXPECT_EQ(suppleFindPoints(context_->handle(), stage_->group().handle(), &query, points.data()), SUPPLE_OK);
        return jets;
    }
    /// What a ray meets in the bind pose.
    SuppleSurfacePoint cast(const std::array<float, 6>& ray) const {
        SuppleSurfacePoint point{};
        SupplePointQuery query{};
        query.structSize = sizeof query;
        query.kind = SUPPLE_FIND_RAY;
        query.count = 1;
        query.values = ray.data();
        EXPECT_EQ(suppleFindPoints(context_->handle(), stage_->group().handle(), &query, &point), SUPPLE_OK);
        return point;
    }
    /// The chest of pip.
    SuppleSurfacePoint chest() const { return cast({0.0f, 0.40f, 5.0f, 0.0f, 0.0f, -1.0f}); }

private:
    std::unique_ptr<host::Device> device_;
    std::shared_ptr<const host::ValidationLog> validation_;
    std::unique_ptr<host::Context> context_;
    std::unique_ptr<host::SurfaceRenderer> renderer_;
    host::DrawTarget target_;
    std::unique_ptr<ViewStage> stage_;
};

glm::vec3 propVector(const float* v) {
    return {v[0], v[1], v[2]};
}
glm::vec3 propNormal(const SuppleSurfaceJet& jet) {
    return glm::normalize(glm::cross(propVector(jet.du), propVector(jet.dv)));
}

/// Where a place is in the picture; outside of it: behind its edges.
glm::vec2 pixelOf(const ViewStage& stage, const glm::vec3& place) {
    const glm::vec4 at = stage.camera().projection(kPropsAspect, 1.0f) * stage.camera().view() * glm::vec4(place, 1.0f);
    return {(0.5f + 0.5f * at.x / at.w) * static_cast<float>(kPropsSize.width),
            (0.5f - 0.5f * at.y / at.w) * static_cast<float>(kPropsSize.height)};
}
const uint8_t* pixelAt(const host::Picture& picture, const glm::vec2& at) {
    const float x = std::clamp(at.x, 0.0f, static_cast<float>(picture.width) - 1.0f);
    const float y = std::clamp(at.y, 0.0f, static_cast<float>(picture.height) - 1.0f);
    return picture.pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
}
double differenceOf(const uint8_t* a, const uint8_t* b) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
        sum += std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k]));
    return sum;
}

/// A decal that is green all over, which nothing of pip is.
host::DecalLook greenLook() {
    return {{1, 1, {0, 255, 0, 255}}, {}, 1.0f};
}
bool isGreen(const uint8_t* pixel) {
    return pixel[1] > 40 && pixel[1] > 2 * pixel[0] && pixel[1] > 2 * pixel[2];
}

/// How many points well inside a decal face the camera, and how many of them are green.
struct Green {
    uint32_t seen = 0, green = 0;
};
Green countGreen(PropsStage& world, const host::Decal& decal, const host::Picture& picture) {
    const std::vector<SuppleSurfaceJet> jets = world.jetsAt(decal.points);
    const glm::vec3 eye = world.stage().camera().eye();
    Green count;
    for (size_t k = 0; k < jets.size(); ++k) {
        const glm::vec3 at = propVector(jets[k].position), toEye = glm::normalize(eye - at);
        const host::Decal::Place& place = decal.places[k];
        const bool isInside = std::abs(place.u - 0.5f) < 0.45f && std::abs(place.v - 0.5f) < 0.45f;
        if (!isInside || place.opacity < 0.99f || glm::dot(propNormal(jets[k]), toEye) < 0.3f)
            continue;
        ++count.seen;
        count.green += isGreen(pixelAt(picture, pixelOf(world.stage(), at))) ? 1 : 0;
    }
    return count;
}

/// No point of a picture on the chest is on the back, on an arm or under an edge; patches hang together.
TEST(ViewProps, DecalsCoverWhatFacesThemAroundTheirMiddle) {
    PropsStage world;
    ASSERT_TRUE(world.open("pip_quads.glb"));
    host::DecalDesc desc;
    desc.at = world.chest();
    ASSERT_NE(desc.at.face, SUPPLE_NO_FACE);
    desc.size = {0.30f, 0.20f};
    glm::mat3 upright(1.0f); // the axes of the one that is not turned
    for (const float turn : {0.0f, 0.7f}) {
        desc.rotation = turn;
        const Result<host::Decal> made =
            host::projectDecal(world.context().handle(), world.stage().group().handle(), desc);
        ASSERT_TRUE(made.ok()) << made.error().message;
        const host::Decal& decal = *made;
        ASSERT_EQ(decal.places.size(), decal.points.size());
        ASSERT_EQ(decal.tangents.size(), decal.points.size());
        const std::vector<SuppleSurfaceJet> jets = world.jetsAt(decal.points, false);
        const SuppleSurfaceJet middle = world.jetsAt({desc.at}, false)[0];
        const glm::vec3 outwards = propNormal(middle), origin = propVector(middle.position);
        const glm::vec3 right = decal.tangents[0], up = glm::cross(outwards, right);
        EXPECT_NEAR(glm::dot(right, outwards), 0.0f, 1e-5f);
        if (turn == 0.0f) {
            upright = glm::mat3(right, up, outwards);
            EXPECT_NEAR(right.y, 0.0f, 1e-4f);
            EXPECT_GT(up.y, 0.5f);
        }
        EXPECT_LT(glm::distance(right, upright * glm::vec3(std::cos(turn), std::sin(turn), 0.0f)), 1e-4f);
        float least = 1.0f, highest = 0.0f, off = 0.0f;
        for (size_t k = 0; k < jets.size(); ++k) {
            const glm::vec3 away = propVector(jets[k].position) - origin;
            least = std::min(least, glm::dot(propNormal(jets[k]), outwards));
            highest = std::max(highest, std::abs(glm::dot(away, outwards)));
            off = std::max(off, std::abs(glm::dot(away, right) - (decal.places[k].u - 0.5f) * desc.size.x));
            off = std::max(off, std::abs(glm::dot(away, up) - (0.5f - decal.places[k].v) * desc.size.y));
            EXPECT_GE(decal.places[k].u, -1e-5f);
            EXPECT_LE(decal.places[k].v, 1.0f + 1e-5f);
        }
        EXPECT_GE(least, std::cos(glm::radians(desc.fadeEnd)) - 1e-3f);
        EXPECT_LE(highest, 0.5f * glm::length(desc.size) + 1e-4f);
        EXPECT_LE(off, 1e-4f) << "it is a projection";
        std::vector<uint32_t> roots(decal.points.size());
        std::iota(roots.begin(), roots.end(), 0u);
        const auto rootOf = [&](uint32_t k) {
            while (roots[k] != k)
                k = roots[k];
            return k;
        };
        for (const host::Decal::Patch& patch : decal.patches) {
            for (const uint32_t corner : patch)
                roots[rootOf(corner)] = rootOf(patch[0]);
        }
        for (uint32_t k = 0; k < roots.size(); ++k)
            EXPECT_EQ(rootOf(k), rootOf(0));
        std::printf("%zu points, %zu patches, bend %.1e\n", decal.points.size(), decal.patches.size(),
                    static_cast<double>(decal.bend));
    }
    EXPECT_EQ(world.messages(), 0u);
}

/// The same patches with the same texture coordinates whatever the pose, and in the picture where the surface is: in
/// two poses, with several schemes, at a low rate, and at levels of detail. No pixel of the surface comes through.
TEST(ViewProps, DecalsStayWhereTheyAreWhileTheFigureMoves) {
    PropsStage world;
    ASSERT_TRUE(world.open("pip_quads.glb"));
    ViewStage& stage = world.stage();
    stage.settings.playing = false;
    stage.settings.ground = false;
    stage.settings.simulate = false;
    host::DecalDesc desc;
    desc.at = world.chest();
    desc.size = glm::vec2(0.2f);
    const auto drawAll = [&](const char* what) {
        std::optional<host::Decal> first;
        for (const double time : {0.0, 0.35}) {
            stage.settings.time = time;
            world.draw();
            const auto attachments = world.renderer().createAttachments(stage.group());
            ASSERT_TRUE(attachments.ok());
            const Status added = (*attachments)->addDecal(desc, greenLook());
            ASSERT_TRUE(added.ok()) << added.error().message;
            const host::Decal& decal = (*attachments)->decals().front();
            if (first) {
                EXPECT_EQ(first->patches, decal.patches) << what;
                ASSERT_EQ(first->places.size(), decal.places.size()) << what;
                for (size_t k = 0; k < decal.places.size(); ++k)
                    EXPECT_EQ(first->places[k].u, decal.places[k].u) << what;
            }
            first = decal;
            const Green count = countGreen(world, decal, world.draw(attachments->get()));
            std::printf("%s at %.2f s: %u of %u points are green\n", what, time, count.green, count.seen);
            EXPECT_GT(count.seen, 100u) << what;
            EXPECT_GE(count.green, count.seen * 98 / 100) << what;
        }
    };
    drawAll("catmull-clark");
    for (const auto& [scheme, name] : {std::pair(SUPPLE_SCHEME_PM, "pm"), std::pair(SUPPLE_SCHEME_LOOP, "loop"),
                                       std::pair(SUPPLE_SCHEME_POLYGONS, "polygons")}) {
        ASSERT_TRUE(stage.setScheme(scheme, world.context().lastFrame()).ok());
        drawAll(name);
    }
    ASSERT_TRUE(stage.setScheme(SUPPLE_SCHEME_CATMULL_CLARK, world.context().lastFrame()).ok());
    ASSERT_TRUE(stage.setRate(2, world.context().lastFrame()).ok());
    drawAll("rate 2");
    stage.settings.levels = true;
    ASSERT_TRUE(stage.changeGroup(world.context().lastFrame()).ok());
    drawAll("levels");
    EXPECT_EQ(world.messages(), 0u);
}

TEST(ViewProps, DecalsSayWhatIsWrongWithThem) {
    PropsStage world;
    ASSERT_TRUE(world.open("pip_quads.glb"));
    host::DecalDesc sound;
    sound.at = world.chest();
    const auto refusal = [&](auto spoil) {
        host::DecalDesc desc = sound;
        spoil(desc);
        const Result<host::Decal> made =
            host::projectDecal(world.context().handle(), world.stage().group().handle(), desc);
        return made ? std::string("accepted") : made.error().message;
    };
    EXPECT_EQ(refusal([](host::DecalDesc&) {}), "accepted");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.size.y = 0.0f; }), "decal: its size must be above 0 and finite");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.size.x = NAN; }), "decal: its size must be above 0 and finite");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.depth = -1.0f; }), "decal: its depth must be finite, and 0 or more");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.fadeBegin = 80.0f; }),
              "decal: fadeBegin must be below fadeEnd, and that at most 80 degrees");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.segments = 1; }), "decal: segments must be 2 to 128");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.rotation = INFINITY; }), "decal: rotation and up must be finite");
    EXPECT_EQ(refusal([](host::DecalDesc& d) { d.at.face = 999999; }),
              "decal: suppleFindPoints refuses its points; the log says why");
}

/// A lantern and an arrow stand where they were put, in every pose and on the group that takes the group's place.
TEST(ViewProps, PropsMoveWithTheFigure) {
    PropsStage world;
    ASSERT_TRUE(world.open("pip_quads.glb"));
    ViewStage& stage = world.stage();
    stage.settings.playing = false;
    stage.settings.ground = false;
    stage.settings.simulate = false;
    const SuppleSurfacePoint at = world.chest();
    for (const Prop prop : {Prop::lantern, Prop::arrow, Prop::sticker}) {
        std::vector<uint8_t> before; // without a prop, at the time before
        for (const double time : {0.0, 0.35}) {
            stage.settings.time = time;
            const host::Picture without = world.draw();
            EXPECT_NE(without.rgba, before) << "the figure moves";
            before = without.rgba;
            ASSERT_TRUE(stage.attach({prop, at}).ok());
            const host::Picture with = world.draw();
            const SuppleSurfaceJet jet = world.jetsAt({at})[0];
            // The middle of a lantern, the shaft of an arrow.
            const float radius = stage.scene(kPropsSize).bounds.radius();
            const float out = prop == Prop::lantern ? 0.12f : prop == Prop::arrow ? 0.1f : 0.0f;
            const glm::vec2 place = pixelOf(stage, propVector(jet.position) + out * radius * propNormal(jet));
            EXPECT_GT(differenceOf(pixelAt(with, place), pixelAt(without, place)), 30.0)
                << static_cast<int>(prop) << " at " << time;
            ASSERT_TRUE(stage.setRate(time == 0.0 ? 2 : 4, world.context().lastFrame()).ok());
            EXPECT_EQ(stage.attached().size(), 1u);
            const host::Picture again = world.draw();
            EXPECT_LT(differenceOf(pixelAt(again, place), pixelAt(with, place)), 60.0);
            ASSERT_TRUE(stage.takeOff(world.context().lastFrame()).ok());
            const host::Picture gone = world.draw();
            EXPECT_LT(differenceOf(pixelAt(gone, place), pixelAt(without, place)), 30.0);
        }
    }
    EXPECT_FALSE(stage.attach({Prop::sticker, {999999, 0, 0.0f, 0.0f}}).ok());
    EXPECT_TRUE(stage.attached().empty());
    world.draw();
    EXPECT_EQ(world.messages(), 0u);
}

} // namespace
} // namespace supple::tools
