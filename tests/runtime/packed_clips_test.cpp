// Packed clips on the device: the bits that the CPU has, whatever they are mixed with, also from a cooked file.
#include "runtime/cooked/file.h"
#include "skinning/clip_packer.h"
#include "skinning/clip_table.h"
#include "tests/support/crowd.h"
#include "tests/support/played_group.h"
#include "tests/support/read_character.h"
#include "tests/support/same_character.h"
#include "tests/support/sample_assets.h"

#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <supple/supple_prepare.h>

namespace supple::test {
namespace {

class PackedOnGpu : public CrowdContexts {};

constexpr double kError = 1e-4;

/// A cooked file. Error 0: its clips are not packed.
std::vector<std::byte> cooked(const cage::Character& character, double error) {
    cage::Character packed = character;
    if (error > 0.0) {
        (void)skinning::packClips(packed, error);
    }
    return runtime::writeCooked(*runtime::Prepared::of(std::move(packed)), "");
}

void expectTheBitsOfTheCpu(CrowdContext& own) {
    const ValidationGuard guard;
    constexpr uint32_t kTravels = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_YAW;
    ASSERT_TRUE(own.valid());
    for (const std::string& file : {kPip, kWren}) {
        const cage::Character plain = readCharacter(file);
        const std::vector<std::byte> bytes = cooked(plain, kError);
        const uint32_t flags = SUPPLE_GROUP_TRANSITIONS;
        PlayedGroup stage(own, playedGroup(own.createAsset(bytes, "packed"), 5, flags));
        PlayedGroup before(own, playedGroup(own.asset(file), 5, flags));
        ASSERT_TRUE(stage.crowd.valid() && before.crowd.valid());
        const auto clips = static_cast<uint32_t>(plain.clips.size());
        for (PlayedGroup* const group : {&stage, &before}) {
            for (uint32_t i = 0; i < 3; ++i) {
                group->play(i, i % clips, 0.17 * i, i == 2 ? kTravels : 0u,
                            i == 2 ? uint32_t{SUPPLE_PLAYBACK_TRAVEL} : 0u);
            }
            SupplePlaybackLayer layers[3] = {PlayedGroup::loops(0, 0.1), PlayedGroup::loops(1, 0.3),
                                             PlayedGroup::loops(clips - 1, 0.2)};
            layers[1].weight = 0.4f;
            layers[2].mode = SUPPLE_LAYER_ADDITIVE;
            layers[2].weight = 0.5f;
            group->play(3, layers);
            group->play(4, 0, 0.0);
        }
        double apart = 0.0;
        for (const double time : {0.0, 0.35, 1.0, 1.2, 17.3}) {
            if (time == 1.0) {
                SupplePlaybackDesc over{};
                over.transition = 0.3;
                stage.play(4, 1, 0.0, over);
                before.play(4, 1, 0.0, over);
            }
            EXPECT_EQ(stage.run(time), 0u) << file << " at " << time;
            EXPECT_EQ(before.run(time), 0u);
            for (uint32_t i = 0; i < 2; ++i) {
                for (uint32_t j = 0; j < plain.skin.joints.size(); ++j) {
                    apart = std::max(apart, glm::length(stage.placeOf(i, j) - before.placeOf(i, j)));
                }
            }
        }
        EXPECT_LT(apart, 1.5 * kError * stage.extent());
        EXPECT_GT(apart, 0.0) << "they are others";
    }
}

TEST_F(PackedOnGpu, HaveTheBitsOfTheCpuNarrow) {
    expectTheBitsOfTheCpu(context(SUPPLE_MAPPING_NARROW));
}
TEST_F(PackedOnGpu, HaveTheBitsOfTheCpuWide) {
    expectTheBitsOfTheCpu(context(SUPPLE_MAPPING_WIDE));
}

/// The first clip packed, in part. The others have keys at uneven times, and of some nodes fewer channels.
cage::Character inManyWays(const std::string& file) {
    cage::Character character = readCharacter(file);
    const std::vector<cage::Clip> plain = character.clips;
    for (cage::Channel& channel : character.clips[0].channels) {
        if (channel.node % 7 == 0) {
            channel.interpolation = cage::Interpolation::step;
        }
    }
    (void)skinning::packClips(character, kError);
    for (size_t c = 1; c < plain.size(); ++c) {
        cage::Clip& clip = character.clips[c] = plain[c];
        std::erase_if(clip.channels, [&](const cage::Channel& channel) { return (channel.node + c) % 3 == 0; });
        for (cage::Channel& channel : clip.channels) {
            const auto duration = static_cast<float>(clip.duration);
            for (float& time : channel.times) {
                time = (channel.node + c) % 2 == 0 ? time : time * time / duration;
            }
        }
    }
    return character;
}

// Lanes side by side have other numbers of layers, of channels and of turns of a search.
TEST_F(PackedOnGpu, StandBesideOtherClipsInAGroup) {
    const cage::Character character = inManyWays(kWren);
    const skinning::ClipKinds kinds = skinning::clipKinds(character);
    ASSERT_TRUE(kinds.keyed && kinds.packed && !kinds.coarse);
    const std::vector<std::byte> bytes = cooked(character, 0.0);
    const auto clips = static_cast<uint32_t>(character.clips.size());
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const ValidationGuard guard;
        ASSERT_TRUE(own.valid());
        constexpr uint32_t kInstances = 19;
        PlayedGroup stage(own, playedGroup(own.createAsset(bytes, "mixed"), kInstances, 0));
        ASSERT_TRUE(stage.crowd.valid());
        for (uint32_t i = 0; i < kInstances; ++i) {
            std::vector<SupplePlaybackLayer> layers;
            for (uint32_t k = 0; k < i * i % 5; ++k) {
                layers.push_back(PlayedGroup::loops((i + k) % clips, 0.13 * i + 0.31 * k));
                layers.back().weight = k == 0 ? 1.0f : 0.3f;
                layers.back().flags = i % 4 == 0 ? 0 : uint32_t{SUPPLE_LAYER_LOOP};
            }
            stage.play(i, layers);
        }
        EXPECT_EQ(stage.run(0.4), 0u);
        SupplePlaybackLayer added = PlayedGroup::loops(1, 0.2);
        added.mode = SUPPLE_LAYER_ADDITIVE;
        const SupplePlaybackLayer two[] = {PlayedGroup::loops(0, 0.5), added};
        stage.play(4, two);
        EXPECT_EQ(stage.run(1.7), 0u);
    }
}

TEST(PackedFiles, AreReadAsTheyWereWritten) {
    const cage::Character plain = readCharacter(kWren);
    cage::Character packed = plain;
    (void)skinning::packClips(packed, kError, 100.0 * kError);
    const std::vector<std::byte> bytes = runtime::writeCooked(*runtime::Prepared::of(packed), "");
    EXPECT_LT(bytes.size() + 150'000, cooked(plain, 0.0).size()) << "the channels are not there twice";
    const Result<std::shared_ptr<runtime::Prepared>> read = runtime::readCooked(bytes, plain.name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    const CharacterDifferences differences(packed, (*read)->character);
    EXPECT_TRUE(differences.found().empty()) << differences.found().front();
    for (size_t c = 0; c < packed.clips.size(); ++c) {
        const cage::PackedChannels &a = packed.clips[c].packed, &b = (*read)->character.clips[c].packed;
        EXPECT_EQ(a.words, b.words);
        EXPECT_EQ(a.channelCount, b.channelCount);
        EXPECT_EQ(a.error, b.error);
        EXPECT_EQ(a.unpackedBytes, b.unpackedBytes);
        EXPECT_EQ(a.coarseWords, b.coarseWords);
        EXPECT_EQ(a.coarseError, b.coarseError);
    }
    // A twin of another clip is refused.
    cage::Character mixed = packed;
    mixed.clips[1].packed.coarseWords = packed.clips[0].packed.words;
    const Result<std::shared_ptr<runtime::Prepared>> unlike =
        runtime::readCooked(runtime::writeCooked(*runtime::Prepared::of(mixed), ""), "wren.supple");
    ASSERT_FALSE(unlike.ok());
    EXPECT_NE(unlike.error().message.find("clip walk: its coarse twin: "), std::string::npos) << unlike.error().message;
    // Words that say something else are refused, with the file's name.
    packed.clips[1].packed.words[1] += 1;
    const std::vector<std::byte> spoiled = runtime::writeCooked(*runtime::Prepared::of(packed), "");
    const Result<std::shared_ptr<runtime::Prepared>> refused = runtime::readCooked(spoiled, "wren.supple");
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("wren.supple: clip walk: "), std::string::npos) << refused.error().message;
}

TEST(PackedFiles, ArePreparedWithTheErrorThatIsAsked) {
    const cage::Character plain = readCharacter(kPip);
    const std::vector<std::byte> file = cooked(plain, 0.0);
    SuppleAssetDesc asset{};
    asset.structSize = sizeof asset;
    asset.name = "pip";
    asset.bytes = file.data();
    asset.byteCount = file.size();
    SupplePrepareDesc desc{};
    desc.structSize = sizeof desc;
    desc.asset = &asset;
    const auto sizeWith = [&](float error) {
        desc.clipError = error;
        SupplePrepared prepared = nullptr;
        EXPECT_EQ(supplePrepare(&desc, &prepared), SUPPLE_OK);
        size_t size = 0;
        EXPECT_EQ(suppleSavePrepared(prepared, nullptr, nullptr, &size), SUPPLE_OK);
        suppleDestroyPrepared(prepared);
        return size;
    };
    const size_t plainSize = sizeWith(0.0f), fine = sizeWith(1e-4f), coarse = sizeWith(1e-3f);
    EXPECT_LT(fine + 100'000, plainSize);
    EXPECT_LT(coarse, fine);
    for (const float wrong : {-1e-4f, 0.2f, std::numeric_limits<float>::quiet_NaN()}) {
        desc.clipError = wrong;
        SupplePrepared prepared = nullptr;
        EXPECT_EQ(supplePrepare(&desc, &prepared), SUPPLE_ERROR_ARGUMENT) << wrong;
        EXPECT_EQ(prepared, nullptr);
    }
}

} // namespace
} // namespace supple::test
