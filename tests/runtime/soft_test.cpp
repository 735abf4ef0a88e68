// What is soft, on the device: the words of the CPU's own steps, whatever the frame rate, and what hosts do to
// them.
#include "runtime/step_clock.h"
#include "tests/support/allocation_count.h"
#include "tests/support/limited_device.h"
#include "tests/support/played_soft.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sixths.h"
#include "tests/support/soft_groups.h"
#include "tests/support/swinging_jiggles.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace supple::test {
namespace {

class Soft : public CrowdContexts {};

/// The same on the CPU.
class SoftOfTheCpu {
public:
    explicit SoftOfTheCpu(const SoftGroup& of)
        : group_(of.group()), table_(deformTableOf(group_)), clock_(group_.instances().capacity(), true),
          places_(group_.instances().capacity(), glm::mat4(1.0f)), travels_(group_.instances().capacity(), false) {
        const skinning::PoseLayout& layout = group_.instances().poseLayout();
        for (uint32_t i = 0; i < group_.instances().capacity(); ++i) {
            twins_.emplace_back(group_.asset().character, *group_.asset().clipTable, table_, layout,
                                skinning::PlaybackState::elements(layout.morphCount, 0));
        }
    }
    void move(uint32_t i, const glm::mat4& place, double time) {
        places_[i] = place;
        clock_.place(i, time);
    }
    void blow(const glm::vec3& wind, double time) { clock_.setWind(glm::dvec3(wind), time); }
    void endFrame(uint64_t frame) { clock_.endFrame(frame); }
    void travel(uint32_t i) { travels_[i] = true; }
    void lighten() { light_ = true; }

    /// How many words of an instance's cage are others than the CPU's at a time.
    uint64_t off(uint32_t i, uint64_t frame, double time, const Floats& shown) {
        const runtime::StepPlace place{glm::dmat3(glm::mat3(places_[i])), glm::dvec3(places_[i][3])};
        const runtime::StepClock::Due due = clock_.take(i, frame, time, place, travels_[i]);
        const runtime::Playback& playback = *group_.poses().playback();
        const std::span<const uint32_t> state = playback.stateOf(i);
        std::vector<glm::vec4> cage(group_.asset().character.cage.vertexCount());
        twins_[i].run(state, playback.masks(), due, light_);
        twins_[i].show(state, playback.masks(), time, due.part, cage);
        uint64_t count = 0;
        for (size_t k = 0; k < shown.size(); ++k) {
            EXPECT_TRUE(std::isfinite(shown[k]));
            count += std::memcmp(&cage[k / 4][static_cast<int>(k % 4)], &shown[k], sizeof(float)) != 0 ? 1 : 0;
        }
        return count;
    }

private:
    runtime::Group& group_;
    skinning::DeformTable table_;
    runtime::StepClock clock_;
    std::vector<glm::mat4> places_;
    std::vector<bool> travels_;
    bool light_ = false; ///< cloths are
    std::vector<PlayedSoft> twins_;
};

/// Plays and moves instances, compares the words of the first group with the CPU's. How far its vertices get from those
/// of the second.
double playedBesideTheCpu(SoftGroup& soft, SoftGroup& stiff) {
    SoftOfTheCpu cpu(soft);
    const auto count = static_cast<uint32_t>(soft.instances.size());
    const auto clips = static_cast<uint32_t>(soft.character().clips.size());
    for (uint32_t i = 0; i < count; ++i) {
        const bool travels = i == 1 || i == 4;
        for (const SoftGroup* const group : {&soft, &stiff}) {
            group->play(i, (1 + i % 2) % clips, 0.1 * i,
                        travels ? SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW : 0,
                        travels ? SUPPLE_PLAYBACK_TRAVEL : 0);
        }
        if (travels) {
            cpu.travel(i);
        }
    }
    double moved = 0.0;
    for (uint32_t f = 0; f < 24; ++f) {
        const double time = 0.35 + 0.021 * f;
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0.1f * f, 0, 0)), 0.1f * f,
                                            glm::vec3(0.2f, 1.0f, 0.0f));
        for (const uint32_t i : {3u, 4u}) {
            soft.place(i, place);
            stiff.place(i, place);
            cpu.move(i, place, f == 0 ? 0.0 : 0.35 + 0.021 * (f - 1)); // before the time is set
        }
        if (f % 6 == 2) { // each wind blows for a while
            const glm::vec3 wind(0.3f * static_cast<float>(f), 0.5f, -4.0f);
            soft.setWind(wind);
            cpu.blow(wind, 0.35 + 0.021 * (f - 1));
        }
        soft.frame(time);
        stiff.frame(time);
        for (uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(cpu.off(i, f + 1, time, soft.shown(i)), 0u) << time << ", " << i;
            const double apart = farthestApart(soft.shown(i), stiff.shown(i));
            EXPECT_TRUE(f > 0 || apart == 0.0 || !soft.character().cloths.empty()) << "at rest in the pose";
            EXPECT_TRUE(f < 4 || apart > 0.0) << "in the second step goals have a speed to differ from";
            moved = std::max(moved, apart);
        }
        cpu.endFrame(f + 1);
    }
    return moved;
}

/// Of five instances, some of which the host moves, and some of which travel.
void compareWithTheCpu(CrowdContext& own, SuppleAsset asset, SuppleSkinning skinning, double most) {
    SoftGroup soft(own, playedGroup(asset, 5, kSoft, skinning));
    SoftGroup stiff(own, playedGroup(asset, 5, 0, skinning));
    ASSERT_TRUE(soft.crowd.valid() && stiff.crowd.valid());
    const double moved = playedBesideTheCpu(soft, stiff);
    EXPECT_GT(moved, 0.02);
    EXPECT_LT(moved, most);
}

TEST_F(Soft, JigglesHaveTheWordsOfTheCpu) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset wren = own.createAsset(jigglingWren());
        for (const SuppleSkinning skinning :
             {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION}) {
            compareWithTheCpu(own, wren, skinning, 0.07); // the limit, and a turn
        }
    }
}

TEST_F(Soft, ClothsHaveTheWordsOfTheCpu) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_CENTERS_OF_ROTATION}) {
            compareWithTheCpu(own, own.asset(kCapedFile), skinning, 0.9); // the cape's length
        }
    }
}

TEST_F(Soft, LightClothsHaveTheWordsOfTheCpu) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        TestView view(own, 1u << 18);
        SuppleGroupDesc desc = playedGroup(own.asset(kCapedFile), 2, kSoft);
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view.handle();
        SoftGroup soft(own, desc), stiff(own, playedGroup(desc.asset, 2, 0));
        ASSERT_TRUE(soft.crowd.valid() && stiff.crowd.valid());
        view.camera.pixelsPerUnit = 56.0f * 1000.0f / soft.longestSide();
        view.look({0.0f, 1.0f, 1000.0f});
        SoftOfTheCpu cpu(soft);
        cpu.lighten();
        double moved = 0.0;
        for (uint32_t f = 0; f < 20; ++f) {
            const double time = 0.021 * f;
            const glm::mat4 place = glm::translate(glm::mat4(1.0f), glm::vec3(0.05f * static_cast<float>(f), 0, 0));
            for (const SoftGroup* const group : {&soft, &stiff}) {
                for (uint32_t i = 0; i < 2 && f == 0; ++i) {
                    group->play(i, i, 0.1 * i);
                }
                group->place(1, place);
            }
            cpu.move(1, place, f == 0 ? 0.0 : 0.021 * (f - 1));
            soft.frame(time);
            stiff.frame(time);
            for (uint32_t i = 0; i < 2; ++i) {
                EXPECT_EQ(cpu.off(i, f + 1, time, soft.shown(i)), 0u) << time << ", " << i;
                raise(moved, farthestApart(soft.shown(i), stiff.shown(i)));
            }
            cpu.endFrame(f + 1);
        }
        EXPECT_GT(moved, 0.02);
    }
}

TEST_F(Soft, TheirGoalsHaveWhatDriversSet) {
    const ValidationGuard guard;
    Result<cage::Character> arm = cage::readGltfFile(std::string(SUPPLE_TEST_DATA) + "/drivers/arm.glb");
    ASSERT_TRUE(arm.ok());
    arm->jiggles = {{3.0f, 0.1f, 0.05f}};
    arm->weights.jiggles.assign(arm->cage.vertexCount(), {0, 1.0f});
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        cage::Character undriven = *arm;
        undriven.drivers.clear();
        SoftGroup soft(own, playedGroup(own.createAsset(*arm), 2, kSoft));
        SoftGroup plain(own, playedGroup(own.createAsset(undriven), 2, kSoft));
        ASSERT_TRUE(soft.crowd.valid() && plain.crowd.valid());
        SoftOfTheCpu cpu(soft);
        double apart = 0.0;
        for (uint32_t i = 0; i < 2; ++i) {
            soft.play(i, 0, 0.2 * i);
            plain.play(i, 0, 0.2 * i);
        }
        for (uint32_t f = 0; f < 24; ++f) {
            const double time = 0.35 + 0.021 * f;
            soft.frame(time);
            plain.frame(time);
            for (uint32_t i = 0; i < 2; ++i) {
                EXPECT_EQ(cpu.off(i, f + 1, time, soft.shown(i)), 0u) << time << ", " << i;
                raise(apart, farthestApart(soft.shown(i), plain.shown(i)));
            }
        }
        EXPECT_GT(apart, 1e-3) << "drivers move something";
    }
}

/// What four instances show at each sixth of a second, in frames at these times.
ShownAtSixths shownInFrames(CrowdContext& own, SuppleAsset asset, uint32_t flags, std::span<const double> times) {
    SoftGroup stage(own, playedGroup(asset, 4, flags | SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS));
    if (!stage.crowd.valid()) {
        ADD_FAILURE() << "no group";
        return {};
    }
    playFour(stage);
    return shownAtSixths(
        stage, times,
        [&](uint32_t sixth, double time) {
            callAt(stage, 2, sixth, time);
            if (sixth == 3 && !stage.character().morphs.targets.empty()) {
                stage.setMorphWeights(3, 1.0f); // of targets that move what is painted
            }
        },
        [&](double time) { stage.frame(time); });
}

/// At the end each instance shows something else than it would without one of the group's flags.
void expectOthersWithout(uint32_t flag, CrowdContext& own, SuppleAsset asset, uint32_t flags,
                         const ShownAtSixths& shown) {
    const auto sixths = static_cast<uint32_t>(shown.size() - 1);
    const ShownAtSixths without = shownInFrames(own, asset, flags & ~flag, framesOf(30, sixths));
    ASSERT_EQ(without.size(), shown.size());
    for (size_t i = 0; i < shown.back().size(); ++i) {
        EXPECT_GT(farthestApart(shown.back()[i], without.back()[i]), 1e-3) << i;
    }
}

TEST_F(Soft, DoNotDependOnTheFrameRate) {
    const ValidationGuard guard;
    constexpr uint32_t kSixths = 6;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    // Beside springs, what hangs on joints that swing jiggles by how they swing.
    const SuppleAsset assets[] = {own.createAsset(jigglingWren()), swingingAndJigglingWren(own), own.asset(kCapedFile)};
    for (const SuppleAsset& asset : assets) {
        const bool swings = &asset == &assets[1];
        const uint32_t flags = kSoft | (swings ? SUPPLE_GROUP_SPRINGS : 0);
        const ShownAtSixths first = shownInFrames(own, asset, flags, framesOf(60, kSixths));
        ASSERT_EQ(first.size(), kSixths + 1);
        for (const uint32_t rate : {24u, 30u, 90u, 144u}) {
            EXPECT_EQ(shownInFrames(own, asset, flags, framesOf(rate, kSixths)), first) << rate;
        }
        EXPECT_EQ(shownInFrames(own, asset, flags, irregularFrames(30, kSixths)), first);
        expectOthersWithout(kSoft, own, asset, flags, first);
        if (swings) {
            expectOthersWithout(SUPPLE_GROUP_SPRINGS, own, asset, flags, first);
        }
    }
}

TEST_F(Soft, HaveTheSameWordsInBothMappingsAndSharedDispatches) {
    const ValidationGuard guard;
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    CrowdContext* const contexts[] = {&context(SUPPLE_MAPPING_NARROW), &context(SUPPLE_MAPPING_WIDE), &shared};
    const std::vector<double> times = framesOf(24, 5);
    ShownAtSixths firstWren, firstCaped;
    for (CrowdContext* const own : contexts) {
        const SuppleAsset wren = swingingAndJigglingWren(*own);
        const auto shown = shownInFrames(*own, wren, kSoft | SUPPLE_GROUP_SPRINGS, times);
        const auto caped = shownInFrames(*own, own->asset(kCapedFile), kSoft, times);
        firstWren = firstWren.empty() ? shown : firstWren;
        firstCaped = firstCaped.empty() ? caped : firstCaped;
        EXPECT_EQ(shown, firstWren);
        EXPECT_EQ(caped, firstCaped);
    }
}

TEST_F(Soft, AreRefusedWhereTheyCannotBe) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(jigglingWren());
    const auto created = [&](SuppleGroupDesc desc) {
        desc.structSize = sizeof desc;
        SuppleGroup group{};
        const SuppleResult result = suppleCreateGroup(own.handle(), &desc, &group);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyGroup(own.handle(), group), SUPPLE_OK);
        }
        return result;
    };
    SuppleGroupDesc desc = playedGroup(asset, 1, kSoft);
    EXPECT_EQ(created(desc), SUPPLE_OK);
    desc.flags |= SUPPLE_GROUP_UPDATE_RATES;
    EXPECT_EQ(created(desc), SUPPLE_ERROR_ARGUMENT);
    for (const SupplePoseSource source : {SUPPLE_POSES_PALETTE_BUFFER, SUPPLE_POSES_CAGE_BUFFER}) {
        desc.flags = kSoft;
        desc.poseSource = source;
        EXPECT_EQ(created(desc), SUPPLE_ERROR_ARGUMENT) << source;
    }
    (void)own.takeError();
    EXPECT_EQ(created(playedGroup(own.asset(kWren), 1, kSoft)), SUPPLE_OK) << "nothing jiggles";
}

TEST_F(Soft, AllocateNothingInFrames) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    SoftGroup stage(own, playedGroup(own.createAsset(jigglingWren()), 4, kSoft | SUPPLE_GROUP_TRANSITIONS));
    ASSERT_TRUE(stage.crowd.valid());
    for (uint32_t i = 0; i < 4; ++i) {
        stage.play(i, 1, 0.1 * i);
    }
    runtime::Group& group = stage.group();
    runtime::Playback& playback = *group.poses().playback();
    double time = 0.0;
    uint64_t frame = 1000, steps = 0;
    stage.frame(time);
    const uint64_t before = allocationsCounted();
    for (uint32_t n = 0; n < 200; ++n) {
        time += 0.01 * (n % 13); // none are due, or some, or all eight
        const AllocationCount count;
        playback.setTime(time);
        playback.setTransform(n % 4, glm::translate(glm::mat4(1.0f), glm::vec3(0.01f * static_cast<float>(n))));
        playback.listPoses(++frame, group.windows(), 4, [](uint32_t) { return true; });
        for (const runtime::PoseList::Round& listed : playback.listedPoses(0).rounds) {
            steps += listed.poses.count - listed.shown;
        }
    }
    EXPECT_EQ(allocationsCounted(), before);
    EXPECT_GT(steps, 1000u);
}

TEST_F(Soft, TakeWindowsOfInstances) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        LimitedDevice limited(mapping, [](WrappedVulkan& says) { says.maxStorageBufferRange = 1u << 18; });
        ASSERT_NE(limited.context(), nullptr);
        constexpr uint32_t kCount = 40;
        CrowdContext &small = *limited.context(), &large = context(mapping);
        SoftGroup cut(small, playedGroup(small.asset(kCapedFile), kCount, kSoft | SUPPLE_GROUP_WINDOWS));
        SoftGroup whole(large, playedGroup(large.asset(kCapedFile), kCount, kSoft));
        ASSERT_TRUE(cut.crowd.valid() && whole.crowd.valid());
        EXPECT_GT(cut.group().windows().count(), 1u);
        for (uint32_t i = 0; i < kCount; ++i) {
            cut.play(i, i % 2, 0.1 * i);
            whole.play(i, i % 2, 0.1 * i);
        }
        for (uint32_t f = 0; f < 6; ++f) {
            cut.frame(f / 40.0);
            whole.frame(f / 40.0);
            for (uint32_t i = 0; i < kCount; ++i) {
                EXPECT_EQ(cut.shown(i), whole.shown(i)) << f << ", " << i;
            }
        }
    }
}

} // namespace
} // namespace supple::test
