// Feet that stand: where clips have them on the ground they stay in one place, on level ground and on slopes, with the
// bits that the CPU has.
#include "skinning/contacts.h"
#include "tests/support/boxes.h"
#include "tests/support/crowd.h"
#include "tests/support/played_group.h"
#include "tests/support/read_character.h"
#include "tests/support/sample_assets.h"
#include "tests/support/walkers.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

class Feet : public CrowdContexts {};

constexpr uint32_t kWalks = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;

/// The ground: a point of it and its normal.
struct Ground {
    glm::dvec3 point{0.0}, normal{0.0, 1.0, 0.0};
};

SuppleModifier planted(uint32_t joint, const Ground& ground, float weight = 1.0f) {
    SuppleModifier modifier{};
    modifier.kind = SUPPLE_MODIFIER_PLANT;
    modifier.joint = joint;
    modifier.weight = weight;
    modifier.soft = 0.999f;
    std::memcpy(modifier.target, &ground.point, sizeof modifier.target);
    const glm::dvec3& n = ground.normal;
    const glm::dvec4 turn = glm::normalize(glm::dvec4(n.z, 0.0, -n.x, 1.0 + n.y));
    for (int i = 0; i < 4; ++i) {
        modifier.rotation[i] = static_cast<float>(turn[i]);
    }
    return modifier;
}
SuppleModifier lowered(uint32_t joint) {
    SuppleModifier modifier{};
    modifier.kind = SUPPLE_MODIFIER_LOWER;
    modifier.joint = joint;
    modifier.weight = 1.0f;
    return modifier;
}

/// A walker, whose instances all have the same modifiers.
struct PlantedCrowd {
    PlantedCrowd(CrowdContext& context, const cage::Character& walker, uint32_t count,
                 SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR)
        : contacts(skinning::findContacts(walker)), walk(clipNumber(walker, "walk")),
          stage(context, playedGroup(context.createAsset(walker), count, SUPPLE_GROUP_MODIFIERS, skinning)) {
        feet[0] = stage.joint("foot.L");
        feet[1] = stage.joint("foot.R");
    }
    [[nodiscard]] uint32_t clip() const { return static_cast<uint32_t>(walk); }
    [[nodiscard]] std::vector<SuppleModifier> onGround(const Ground& ground) const {
        return {lowered(stage.joint("hips")), planted(feet[0], ground), planted(feet[1], ground)};
    }

    skinning::Contacts contacts;
    size_t walk;
    PlayedGroup stage;
    uint32_t feet[2];
};

glm::dvec2 onGround(const glm::dvec3& p) {
    return {p.x, p.z};
}

TEST_F(Feet, StayWhereTheClipHasThem) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const std::string& file : {kPip, kWren}) {
            for (const double yaw : {0.0, 0.5}) {
                const cage::Character walker = walking(readCharacter(file), yaw);
                PlantedCrowd crowd(own, walker, 3);
                PlayedGroup& stage = crowd.stage;
                ASSERT_TRUE(stage.crowd.valid());
                // As the clip has it; carried along by its root; and the same without modifiers.
                stage.play(0, crowd.clip(), 0.0);
                stage.play(1, crowd.clip(), 0.0, kWalks, SUPPLE_PLAYBACK_TRAVEL);
                stage.play(2, crowd.clip(), 0.0, kWalks, SUPPLE_PLAYBACK_TRAVEL);
                stage.modify(0, crowd.onGround({}));
                stage.modify(1, crowd.onGround({}));
                double held = 0.0, slid = 0.0;
                for (size_t f = 0; f < 2; ++f) {
                    const skinning::Contact& contact = crowd.contacts.of(crowd.walk, f).back();
                    const double leg = crowd.contacts.feet[f].leg;
                    for (int k = 0; k <= 6; ++k) {
                        const double time = contact.begin + 0.12 + (contact.end - contact.begin - 0.24) * k / 6.0;
                        if (time < 0.0 || time >= walker.clips[crowd.walk].duration) {
                            continue;
                        }
                        EXPECT_EQ(stage.run(time), 0u) << mappingName(mapping);
                        const glm::dvec2 wanted = contact.place + contact.drift * time;
                        for (uint32_t i = 0; i < 3; ++i) {
                            const double off = glm::length(onGround(stage.placeOf(i, crowd.feet[f])) - wanted) / leg;
                            (i < 2 ? held : slid) = std::max(i < 2 ? held : slid, off);
                        }
                    }
                }
                EXPECT_LT(held, 1e-5) << file << " " << yaw;
                EXPECT_GT(slid, 5e-4) << file << " " << yaw << ": else nothing was to be done";
            }
        }
    }
}

TEST_F(Feet, StandOnSlopes) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const cage::Character walker = walking(readCharacter(kWren), 0.0);
        PlantedCrowd crowd(own, walker, 3, SUPPLE_SKINNING_DUAL_QUATERNION);
        PlayedGroup& stage = crowd.stage;
        const skinning::Foot& foot = crowd.contacts.feet[0];
        const Ground grounds[] = {{{0.0, -0.06 * foot.leg, 0.0}, glm::normalize(glm::dvec3(0.2, 1.0, 0.1))},
                                  {{0.3, 0.05 * foot.leg, 0.1}, glm::normalize(glm::dvec3(-0.1, 1.0, 0.25))}};
        for (const Ground& ground : grounds) {
            for (uint32_t i = 0; i < 3; ++i) {
                stage.play(i, crowd.clip(), 0.0, kWalks);
            }
            stage.modify(0, std::span<const SuppleModifier>());
            stage.modify(1, crowd.onGround(ground));
            // The same in the world, where the instance stands elsewhere.
            const glm::mat4 place =
                glm::rotate(glm::translate(glm::mat4(1.0f), {4.0f, 2.0f, -1.0f}), 0.8f, {0.0f, 1.0f, 0.0f});
            const Ground there{glm::dvec3(glm::dmat4(place) * glm::dvec4(ground.point, 1.0)),
                               glm::dmat3(glm::dmat4(place)) * ground.normal};
            std::vector<SuppleModifier> inWorld = crowd.onGround(there);
            inWorld[1].flags = inWorld[2].flags = SUPPLE_MODIFIER_WORLD;
            stage.place(2, place);
            stage.modify(2, inWorld);
            for (const double time : {0.1, 0.25, 0.4, 0.8}) {
                EXPECT_EQ(stage.run(time), 0u) << mappingName(mapping);
                for (const uint32_t joint : crowd.feet) {
                    const glm::dmat4 before = stage.jointOf(0, joint), after = stage.jointOf(1, joint);
                    const double lift = before[3].y - foot.sole - foot.height;
                    const double over = glm::dot(glm::dvec3(after[3]) - ground.point, ground.normal);
                    EXPECT_NEAR(over, foot.height + lift * ground.normal.y, 2e-3 * foot.leg) << time;
                    // The foot's own up tilts to the normal.
                    const glm::dvec3 up =
                        glm::dmat3(after) * (glm::inverse(glm::dmat3(before)) * glm::dvec3(0.0, 1.0, 0.0));
                    EXPECT_LT(glm::length(glm::normalize(up) - ground.normal), 1e-4);
                    const glm::dmat4 other = glm::inverse(glm::dmat4(place)) * stage.jointOf(2, joint);
                    EXPECT_LT(glm::length(other[3] - after[3]), 2e-5 * foot.leg);
                }
            }
        }
        const uint32_t hips = stage.joint("hips");
        EXPECT_EQ(stage.run(0.25), 0u);
        const double level = stage.placeOf(0, hips).y;
        stage.modify(1, crowd.onGround(grounds[0]));
        const double lower = level - stage.placeOf(1, hips).y;
        EXPECT_GT(lower, 0.01 * foot.leg);
        EXPECT_LT(lower, 0.3 * foot.leg);
        stage.modify(1, crowd.onGround({{0.0, -10.0, 0.0}}));
        EXPECT_NEAR(level - stage.placeOf(1, hips).y, 0.3 * foot.leg, 1e-5) << "no farther";
        stage.modify(1, crowd.onGround({{0.0, 0.1 * foot.leg, 0.0}}));
        EXPECT_EQ(stage.placeOf(1, hips).y, level) << "never up";
    }
}

TEST_F(Feet, AreHeldByWhatIsBlendedAndNotByWhatIsMaskedOrAdded) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const cage::Character walker = walking(readCharacter(kWren), 0.0);
    PlantedCrowd crowd(own, walker, 4);
    PlayedGroup& stage = crowd.stage;
    const auto clip = [&](const char* name) { return static_cast<uint32_t>(clipNumber(walker, name)); };
    const std::vector<float> none(walker.skin.joints.size(), 0.0f);
    SuppleMaskDesc mask{};
    mask.structSize = sizeof mask;
    mask.mask = 1;
    mask.jointMask = none.data();
    mask.jointMaskCount = static_cast<uint32_t>(none.size());
    ASSERT_EQ(suppleSetMask(stage.handle(), stage.crowd.group(), &mask), SUPPLE_OK);
    SupplePlaybackLayer idle = PlayedGroup::loops(clip("idle"), 0.0), walk = PlayedGroup::loops(crowd.clip(), 0.25);
    const auto foot = [&](uint32_t i) { return onGround(stage.placeOf(i, crowd.feet[0])); };
    const glm::dvec2 stands = crowd.contacts.of(clip("idle"), 0).front().place;
    // Alone; with a walk behind a mask, and added; half and half.
    stage.play(0, {&idle, 1});
    SupplePlaybackLayer layers[2] = {idle, walk};
    layers[1].mask = 1;
    stage.play(1, layers);
    layers[1].mask = 0;
    layers[1].mode = SUPPLE_LAYER_ADDITIVE;
    stage.play(2, layers);
    layers[1].mode = SUPPLE_LAYER_BLEND;
    layers[1].weight = 0.5f;
    stage.play(3, layers);
    for (uint32_t i = 0; i < 4; ++i) {
        stage.modify(i, std::vector{planted(crowd.feet[0], {})});
    }
    EXPECT_EQ(stage.run(0.0), 0u);
    const skinning::Contact& contact = crowd.contacts.of(crowd.walk, 0).front();
    ASSERT_LT(contact.begin + 0.1, 0.25);
    ASSERT_GT(contact.end - 0.1, 0.25);
    const double leg = crowd.contacts.feet[0].leg;
    EXPECT_LT(glm::length(foot(0) - stands), 1e-5 * leg);
    EXPECT_LT(glm::length(foot(1) - stands), 1e-5 * leg);
    EXPECT_LT(glm::length(foot(2) - stands), 1e-5 * leg) << "what is added holds nothing";
    EXPECT_LT(glm::length(foot(3) - 0.5 * (stands + contact.place + contact.drift * 0.25)), 1e-5 * leg);
    // A part of the weight is a part of the way, and none keeps the bits.
    const glm::dvec2 whole = foot(3);
    stage.modify(3, std::span<const SuppleModifier>());
    const glm::dvec2 posed = foot(3);
    EXPECT_GT(glm::length(whole - posed), 1e-3 * leg);
    stage.modify(3, std::vector{planted(crowd.feet[0], {}, 0.5f)});
    EXPECT_LT(glm::length(foot(3) - 0.5 * (whole + posed)), 1e-4 * leg);
    stage.modify(3, std::span<const SuppleModifier>());
    EXPECT_EQ(stage.run(0.0), 0u);
    const std::vector<float> plain = stage.poses;
    stage.modify(3, std::vector{lowered(stage.joint("hips")), planted(crowd.feet[0], {}, 0.0f)});
    EXPECT_EQ(stage.run(0.0), 0u);
    EXPECT_EQ(stage.poses, plain);
}

TEST_F(Feet, StayWhereTheClipEnds) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    // It walks in place, so the ground moves; and it stands at the clip's beginning and at its end.
    for (const char* const clip : {"walk", "jump"}) {
        PlantedCrowd crowd(own, readCharacter(kWren), 1);
        PlayedGroup& stage = crowd.stage;
        const size_t number = clipNumber(stage.character(), clip);
        SupplePlaybackLayer once = PlayedGroup::loops(static_cast<uint32_t>(number), 0.0);
        once.flags = 0;
        stage.play(0, {&once, 1});
        stage.modify(0, crowd.onGround({}));
        const double duration = stage.character().clips[number].duration;
        for (const uint32_t foot : crowd.feet) {
            for (const double end : {0.0, duration}) {
                EXPECT_EQ(stage.run(end), 0u);
                const glm::dvec3 place = stage.placeOf(0, foot);
                for (const double beyond : {0.2, 0.9, 5.0}) {
                    EXPECT_EQ(stage.run(end > 0.0 ? end + beyond : -beyond), 0u);
                    EXPECT_EQ(stage.placeOf(0, foot), place) << clip << " " << end << " " << beyond;
                }
            }
        }
    }
}

TEST_F(Feet, StandInPosesThatAreSet) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const cage::Character walker = walking(readCharacter(kPip), 0.4);
    PlantedCrowd crowd(own, walker, 1);
    SuppleGroupDesc desc = playedGroup(own.createAsset(walker), 2, SUPPLE_GROUP_MODIFIERS);
    desc.poseSource = SUPPLE_POSES_SET;
    Crowd told(own, desc);
    const SuppleInstance instance = told.spawn();
    const std::vector<SuppleModifier> list =
        crowd.onGround({{0.0, -0.02, 0.0}, glm::normalize(glm::dvec3(0.1, 1.0, 0.0))});
    SuppleModifiersDesc modifiers{};
    modifiers.structSize = sizeof modifiers;
    modifiers.modifiers = list.data();
    modifiers.modifierCount = static_cast<uint32_t>(list.size());
    EXPECT_EQ(suppleSetModifiers(own.handle(), instance, &modifiers), SUPPLE_OK);
    crowd.stage.modify(0, list);
    const auto compare = [&](const char* how) {
        double worst = 0.0;
        for (uint32_t j = 0; j < walker.skin.joints.size(); ++j) {
            float m[16];
            EXPECT_EQ(suppleGetJointTransform(own.handle(), instance, j, m), SUPPLE_OK);
            worst = std::max(worst, glm::length(glm::dvec3(glm::make_vec3(m + 12)) - crowd.stage.placeOf(0, j)));
        }
        EXPECT_LT(worst, 3e-5 * crowd.stage.extent()) << how;
    };
    for (const double time : {0.3, 0.9}) {
        crowd.stage.play(0, crowd.clip(), 0.0);
        EXPECT_EQ(crowd.stage.run(time), 0u);
        EXPECT_EQ(suppleSetClipPose(own.handle(), instance, crowd.clip(), time), SUPPLE_OK);
        compare("a clip");
        crowd.stage.play(0, crowd.clip(), 0.0, kWalks);
        EXPECT_EQ(crowd.stage.run(time), 0u);
        SuppleClipLayer layer{};
        layer.clip = crowd.clip();
        layer.weight = 1.0f;
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.time = time;
        SupplePoseDesc pose{};
        pose.structSize = sizeof pose;
        pose.layers = &layer;
        pose.layerCount = 1;
        pose.rootMotion = kWalks;
        EXPECT_EQ(suppleSetPose(own.handle(), instance, &pose), SUPPLE_OK);
        compare("layers");
        ASSERT_EQ(suppleSetCapacity(own.handle(), told.group(), time < 0.5 ? 4 : 2), SUPPLE_OK);
        compare("another capacity");
        EXPECT_EQ(suppleSetModifiers(own.handle(), instance, &modifiers), SUPPLE_OK);
        compare("modifiers that come later");
    }
    // Another version of the file knows where the foot was held.
    const SuppleAsset asset = desc.asset;
    cage::Character other = walker;
    other.clips.erase(other.clips.begin());
    ASSERT_EQ(own.reloadAsset(asset, other), SUPPLE_OK);
    compare("another version");
}

TEST_F(Feet, KeepWithinTheBoxesThatCullingKnows) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const cage::Character walker = walking(readCharacter(kPip), 0.3);
    PlantedCrowd crowd(own, walker, 1);
    PlayedGroup& stage = crowd.stage;
    stage.play(0, crowd.clip(), 0.0, kWalks, SUPPLE_PLAYBACK_TRAVEL);
    const skinning::Reach reach = skinning::reachOf(stage.character());
    size_t held = 0, all = 0;
    for (int k = 0; k < 10; ++k) {
        stage.modify(0, crowd.onGround({{0.0, -0.05 * k, 0.0}, glm::normalize(glm::dvec3(0.1 * k, 1.0, -0.1))}));
        EXPECT_EQ(stage.run(0.7 * k), 0u);
        const auto box = stage.group().poses().playback()->boundsOf(stage.instances[0].slot, reach);
        ASSERT_TRUE(box.has_value());
        const std::vector<glm::vec4> cage = as<glm::vec4>(stage.crowd.read(stage.crowd.output().info.deformedCage));
        for (uint32_t v = 0; v < stage.character().cage.vertexCount(); ++v, ++all) {
            const glm::dvec3 p(cage[v]);
            held += glm::all(glm::greaterThanEqual(p, box->low)) && glm::all(glm::lessThanEqual(p, box->high)) ? 1 : 0;
        }
    }
    EXPECT_EQ(held, all);
}

TEST_F(Feet, AreFeetAndStayWhenTheGroupIsMadeAnew) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const cage::Character walker = walking(readCharacter(kWren), 0.0);
    const SuppleAsset asset = own.createAsset(walker);
    PlayedGroup stage(own, playedGroup(asset, 1, SUPPLE_GROUP_MODIFIERS));
    const uint32_t foot = stage.joint("foot.L");
    SuppleModifier hand = planted(stage.joint("hand.L"), {});
    SuppleModifiersDesc desc{};
    desc.structSize = sizeof desc;
    desc.modifiers = &hand;
    desc.modifierCount = 1;
    EXPECT_EQ(suppleSetModifiers(stage.handle(), stage.instances[0], &desc), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    stage.play(0, static_cast<uint32_t>(clipNumber(walker, "walk")), 0.0);
    stage.modify(0, planted(foot, {}));
    EXPECT_EQ(stage.run(0.25), 0u);
    const glm::dvec3 before = stage.placeOf(0, foot);
    ASSERT_EQ(suppleSetCapacity(own.handle(), stage.crowd.group(), 3), SUPPLE_OK);
    EXPECT_EQ(stage.run(0.25), 0u);
    EXPECT_EQ(stage.placeOf(0, foot), before);
    // Level again, by a target without a rotation; then the same character once more, read anew.
    SuppleModifierTarget target{};
    target.structSize = sizeof target;
    target.weight = 1.0f;
    EXPECT_EQ(suppleSetModifierTarget(stage.handle(), stage.instances[0], 0, &target), SUPPLE_OK);
    EXPECT_EQ(stage.placeOf(0, foot), before);
    cage::Character other = walker;
    other.clips.erase(other.clips.begin()); // the walk has another number
    ASSERT_EQ(own.reloadAsset(asset, other), SUPPLE_OK);
    EXPECT_EQ(stage.run(0.25), 0u);
    EXPECT_LT(glm::length(stage.placeOf(0, stage.joint("foot.L")) - before), 1e-5);
}

} // namespace
} // namespace supple::test
