// Cooked files: they keep all that was prepared, and whatever is done to one, it is read or refused with a message.
#include "cage/formats/reader.h"
#include "runtime/cooked/file.h"
#include "runtime/prepare.h"
#include "surface/schemes.h"
#include "tests/support/same_character.h"
#include "tests/support/sample_assets.h"
#include "tests/support/shared_assets.h"

#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace supple::runtime {
namespace {

constexpr size_t kHeaderBytes = 32, kVersionAt = 8, kOrderAt = 12, kHashAt = 24;

/// With tables of all schemes, for both mappings.
std::shared_ptr<Prepared> prepareAll(const std::string& path) {
    Result<cage::Character> character = cage::readGltfFile(path);
    EXPECT_TRUE(character.ok()) << path;
    std::shared_ptr<Prepared> prepared = Prepared::of(std::move(*character));
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_CATMULL_CLARK,
          SUPPLE_SCHEME_POLYGONS, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_FRAGMENTS}) {
        for (const uint32_t flags : {0u, uint32_t{SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS},
                                     uint32_t{SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_INDEXED_MESH}}) {
            SuppleGroupDesc desc{};
            desc.structSize = sizeof(desc);
            desc.scheme = scheme;
            desc.flags = flags;
            desc.rate = 4;
            desc.poseSource = SUPPLE_POSES_PLAYBACK;
            for (const bool wide : {false, true}) {
                // Not every scheme takes every character.
                (void)prepareFor(*prepared, {desc, std::nullopt}, wide);
                (void)prepareFor(*prepared, {desc, flags == 0 ? std::optional(0u) : std::nullopt}, wide);
            }
        }
    }
    // Parts by different schemes: tables of pieces.
    std::vector<SuppleScheme> schemes(prepared->character.parts.size(), SUPPLE_SCHEME_PM);
    for (size_t part = 0; part < schemes.size(); part += 2) {
        schemes[part] = SUPPLE_SCHEME_POLYGONS;
    }
    SuppleGroupDesc mixed{};
    mixed.structSize = sizeof(mixed);
    mixed.flags = SUPPLE_GROUP_ATTRIBUTES;
    mixed.partSchemes = schemes.data();
    mixed.partSchemeCount = static_cast<uint32_t>(schemes.size());
    EXPECT_TRUE(prepareFor(*prepared, {mixed, std::nullopt}, false).ok()) << path;
    EXPECT_EQ(prepared->pieces.size(), schemes.size() > 1 ? 2u : 0u);
    EXPECT_FALSE(prepared->tables.empty());
    return prepared;
}

/// Makes the header right for what follows.
void sign(std::vector<std::byte>& file) {
    const uint64_t size = file.size(), hash = XXH3_64bits(file.data() + kHeaderBytes, file.size() - kHeaderBytes);
    std::memcpy(file.data() + kHashAt - sizeof(size), &size, sizeof(size));
    std::memcpy(file.data() + kHashAt, &hash, sizeof(hash));
}

std::string refusalOf(std::span<const std::byte> file) {
    const auto read = readCooked(file, "hero.supple");
    return read ? "" : read.error().message;
}

/// Why the file of a character is refused when `spoil` has changed it.
std::string refusalOfSpoiled(const Prepared& prepared, const std::function<void(cage::Character&)>& spoil) {
    Prepared wrong = prepared;
    spoil(wrong.character);
    return refusalOf(writeCooked(wrong, ""));
}

TEST(Cooked, FilesKeepWhatWasPrepared) {
    for (const std::string& path : test::allCharacters()) {
        SCOPED_TRACE(path);
        const std::shared_ptr<Prepared> prepared = prepareAll(path);
        const std::vector<std::byte> file = writeCooked(*prepared, "supple cook");
        const Result<std::shared_ptr<Prepared>> read = readCooked(file, prepared->character.name);
        ASSERT_TRUE(read.ok()) << read.error().message;
        // All members that are written, to the bit.
        EXPECT_TRUE(writeCooked(**read, "supple cook") == file);
        // Those that follow from them.
        EXPECT_TRUE((*read)->deform.words == prepared->deform.words);
        EXPECT_EQ((*read)->deform.firstInfluences, prepared->deform.firstInfluences);
        EXPECT_TRUE((*read)->rig.maskJoints == prepared->rig.maskJoints);
        EXPECT_TRUE((*read)->jointFrames.bindIsSingular == prepared->jointFrames.bindIsSingular);
        EXPECT_EQ((*read)->parts.size(), prepared->parts.size());
        EXPECT_TRUE((*read)->clips->words == prepared->clips->words);
        EXPECT_EQ((*read)->madeBy, "supple cook");
        for (const auto& own : prepared->tables) {
            const auto isSame = [&](const std::shared_ptr<const PreparedTables>& other) {
                return other->recipe == own->recipe && (other->piece == nullptr) == (own->piece == nullptr) &&
                       (own->piece == nullptr || other->piece->parts == own->piece->parts) &&
                       other->tables.words == own->tables.words && other->tables.notes == own->tables.notes;
            };
            EXPECT_TRUE(std::ranges::any_of((*read)->tables, isSame)) << surface::schemeOf(own->recipe.scheme).name;
        }
    }
}

TEST(Cooked, FilesKeepCenters) {
    Result<cage::Character> character = cage::readGltfFile(test::kPip);
    ASSERT_TRUE(character.ok());
    character->parts[0].skinning = cage::SkinningMode::centersOfRotation;
    const std::shared_ptr<Prepared> prepared = Prepared::of(*character);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = SUPPLE_SCHEME_CAGE;
    ASSERT_TRUE(prepareFor(*prepared, {desc, std::nullopt}, false).ok());
    EXPECT_FALSE(prepared->extras.centers.has_value()) << "the group is linear";
    desc.skinning = SUPPLE_SKINNING_FROM_FILE;
    ASSERT_TRUE(prepareFor(*prepared, {desc, std::nullopt}, false).ok());
    ASSERT_TRUE(prepared->extras.centers.has_value());
    const std::vector<std::byte> file = writeCooked(*prepared, "supple cook");
    const Result<std::shared_ptr<Prepared>> read = readCooked(file, prepared->character.name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_TRUE((*read)->extras.centers.has_value());
    EXPECT_EQ((*read)->extras.centers->points, prepared->extras.centers->points);
    EXPECT_EQ((*read)->extras.centers->arms, prepared->extras.centers->arms);
    EXPECT_EQ((*read)->character.parts[0].skinning, cage::SkinningMode::centersOfRotation);

    for (const glm::vec4& wrong : {glm::vec4(0, 0, std::numeric_limits<float>::infinity(), 1), glm::vec4(0, 0, 0, 2)}) {
        Prepared spoiled = *prepared;
        spoiled.extras.centers->points[7] = wrong;
        EXPECT_NE(refusalOf(writeCooked(spoiled, "")).find("centers of rotation that are none"), std::string::npos);
    }
    Prepared few = *prepared;
    few.extras.centers->points.pop_back();
    EXPECT_NE(refusalOf(writeCooked(few, "")).find("centers of rotation that are none"), std::string::npos);
}

TEST(Cooked, FilesKeepSmoothedWeights) {
    Result<cage::Character> character = cage::readGltfFile(test::kPip);
    ASSERT_TRUE(character.ok());
    character->parts[0].smoothing = cage::Smoothing{0.5f, 6};
    character->weights.mushMask.assign(character->cage.vertexCount(), 0.75f);
    const std::shared_ptr<Prepared> prepared = Prepared::of(*character);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.skinning = SUPPLE_SKINNING_DELTA_MUSH_LIGHT;
    ASSERT_TRUE(prepareFor(*prepared, {desc, std::nullopt}, false).ok());
    ASSERT_TRUE(prepared->extras.mush.has_value());
    const std::vector<std::byte> file = writeCooked(*prepared, "supple cook");
    const Result<std::shared_ptr<Prepared>> read = readCooked(file, prepared->character.name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_TRUE((*read)->extras.mush.has_value());
    EXPECT_EQ((*read)->extras.mush->places, prepared->extras.mush->places);
    EXPECT_EQ((*read)->extras.mush->starts, prepared->extras.mush->starts);
    EXPECT_EQ((*read)->extras.mush->influences, prepared->extras.mush->influences);
    EXPECT_EQ((*read)->extras.mush->arms, prepared->extras.mush->arms);
    EXPECT_EQ((*read)->character.parts[0].smoothing, (cage::Smoothing{0.5f, 6}));
    EXPECT_EQ((*read)->character.weights.mushMask, character->weights.mushMask);

    const auto refused = [&](const std::function<void(skinning::DeltaMush&)>& spoil) {
        Prepared spoiled = *prepared;
        spoil(*spoiled.extras.mush);
        EXPECT_NE(refusalOf(writeCooked(spoiled, "")).find("smoothed weights that are none"), std::string::npos);
    };
    refused([](skinning::DeltaMush& mush) { mush.influences[3].joint = 100000; });
    refused([](skinning::DeltaMush& mush) { mush.influences[3].weight = -1.0f; });
    refused([](skinning::DeltaMush& mush) { mush.influences[3].spread[5] = std::numeric_limits<float>::infinity(); });
    refused([](skinning::DeltaMush& mush) { mush.places[3].w = 2.0f; });
    refused([](skinning::DeltaMush& mush) { mush.starts[3] = mush.starts[2]; });
    refused([](skinning::DeltaMush& mush) { mush.starts.back() += 1; });
    refused([](skinning::DeltaMush& mush) { mush.starts.clear(); });
}

TEST(Cooked, FilesKeepJiggles) {
    const Result<cage::Character> character =
        cage::readGltfFile(std::string(SUPPLE_TEST_DATA) + "/jiggle/belly.glb", {.strict = true});
    ASSERT_TRUE(character.ok());
    const std::shared_ptr<Prepared> prepared = Prepared::of(*character);
    const Result<std::shared_ptr<Prepared>> read = readCooked(writeCooked(*prepared, ""), character->name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(character->jiggles.size(), 1u);
    EXPECT_EQ(test::CharacterDifferences((*read)->character, *character).found(), std::vector<std::string>());

    using cage::Character;
    const auto spoiled = [&](const auto& spoil) { return refusalOfSpoiled(*prepared, spoil); };
    const std::string place = "hero.supple: ";
    EXPECT_EQ(spoiled([](Character& c) { c.jiggles[0].frequency = -1.0f; }),
              place + "jiggle 0: its numbers are out of range");
    EXPECT_EQ(spoiled([](Character& c) { c.jiggles[0].limit = std::numeric_limits<float>::quiet_NaN(); }),
              place + "jiggle 0: its numbers are out of range");
    EXPECT_EQ(spoiled([](Character& c) { c.weights.jiggles.pop_back(); }),
              place + "not one weight of jiggles a vertex");
    for (const cage::PaintedWeight wrong : {cage::PaintedWeight{1, 0.5f}, {0, 0.0f}, {0, 1.5f}, {0, -INFINITY}}) {
        EXPECT_EQ(spoiled([&](Character& c) { c.weights.jiggles[3] = wrong; }),
                  place + "a vertex names no jiggle, or has no weight above 0 to 1");
    }
}

TEST(Cooked, FilesKeepCloths) {
    const Result<cage::Character> character =
        cage::readGltfFile(std::string(SUPPLE_TEST_DATA) + "/cloth/caped.glb", {.strict = true});
    ASSERT_TRUE(character.ok()) << character.error().message;
    const std::shared_ptr<Prepared> prepared = Prepared::of(*character);
    const Result<std::shared_ptr<Prepared>> read = readCooked(writeCooked(*prepared, ""), character->name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(character->cloths.size(), 1u);
    EXPECT_EQ(test::CharacterDifferences((*read)->character, *character).found(), std::vector<std::string>());

    using cage::Character;
    const auto spoiled = [&](const auto& spoil) { return refusalOfSpoiled(*prepared, spoil); };
    const std::string place = "hero.supple: ";
    EXPECT_EQ(spoiled([](Character& c) { c.cloths[0].substeps = 0; }), place + "cloth 0: its numbers are out of range");
    EXPECT_EQ(spoiled([](Character& c) { c.cloths[0].bend = std::numeric_limits<float>::quiet_NaN(); }),
              place + "cloth 0: its numbers are out of range");
    EXPECT_EQ(spoiled([](Character& c) { c.cloths[0].colliders.push_back(7); }),
              place + "cloth 0: it names no collider of spring bones");
    EXPECT_EQ(spoiled([](Character& c) { c.weights.cloths.pop_back(); }), place + "not one weight of cloths a vertex");
    EXPECT_EQ(spoiled([](Character& c) {
                  c.weights.cloths[3] = {1, 0.5f};
              }),
              place + "a vertex names no cloth, or has no weight above 0 to 1");
}

TEST(Cooked, FilesKeepPoseDrivers) {
    Result<cage::Character> character = cage::readGltfFile(std::string(SUPPLE_TEST_DATA) + "/drivers/arm.glb");
    ASSERT_TRUE(character.ok());
    const std::shared_ptr<Prepared> prepared = Prepared::of(*character);
    const Result<std::shared_ptr<Prepared>> read = readCooked(writeCooked(*prepared, ""), character->name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ((*read)->character.drivers, character->drivers);
    ASSERT_EQ(character->drivers.size(), 2u);

    const auto spoiled = [&](const auto& spoil) {
        return refusalOfSpoiled(*prepared, [&](cage::Character& c) { spoil(c.drivers[1]); });
    };
    using cage::PoseDriver;
    const std::string place = "hero.supple: driver 1: ";
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.inputs.clear(); }), place + "inputs, targets, poses and values do not fit");
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.values.pop_back(); }),
              place + "inputs, targets, poses and values do not fit");
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.targets[1] = 99; }), place + "it names no morph targets of one part");
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.inputs[0].node = 99; }),
              place + "an input names no node that turns, or its axis has not unit length, or its weight is out of "
                      "range");
    for (const float length : {1e20f, 0.99f, 0.0f, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_NE(spoiled([&](PoseDriver& d) { d.inputs[0].axis *= length; }).find("its axis has not unit length"),
                  std::string::npos)
            << length;
    }
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.targets[1] = d.targets[0]; }), place + "a morph target is there twice");
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.poses[0] = glm::vec4(0.0f); }),
              place + "its poses are no rotations, or its numbers are not finite");
    EXPECT_EQ(spoiled([](PoseDriver& d) { d.poses[1] = d.poses[0]; }),
              place + "pose 1 and pose 0 are one pose, but for a degree, and have different values");
}

TEST(Cooked, FilesKeepCreaseSetsAndTheirCurves) {
    Result<cage::Character> character = cage::readGltfFile(test::kPip);
    ASSERT_TRUE(character.ok());
    const std::vector<uint32_t> face(character->cage.faceVertices.begin(), character->cage.faceVertices.begin() + 3);
    character->cage.creaseSets = {"a", "b"};
    character->cage.creases = {{face[0], face[1], 0.0f, 1}};
    character->cage.creaseScalars = {{face[1], face[2], 0.0f}};
    cage::Channel keys;
    keys.path = cage::ChannelPath::weights;
    keys.times = {0.0f, 1.0f};
    keys.values = {0.5f, 3.0f};
    character->clips[0].sharpness = {{"b", keys}};
    const std::shared_ptr<Prepared> prepared = Prepared::of(std::move(*character));
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 4;
    ASSERT_TRUE(prepareFor(*prepared, {desc, std::nullopt}, false).ok());
    const std::vector<std::byte> file = writeCooked(*prepared, "");
    const Result<std::shared_ptr<Prepared>> read = readCooked(file, prepared->character.name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_TRUE(writeCooked(**read, "") == file);
    EXPECT_EQ((*read)->character.cage.creaseSets, prepared->character.cage.creaseSets);
    EXPECT_EQ((*read)->character.cage.creases[0].set, 1u);
    EXPECT_EQ((*read)->character.clips[0].sharpness.at(0).keys.values, keys.values);

    prepared->character.cage.creases[0].set = 2;
    EXPECT_NE(refusalOf(writeCooked(*prepared, "")).find("or no such set"), std::string::npos);
    prepared->character.cage.creases[0].set = 0;
    prepared->character.cage.creaseSets.resize(65, "c");
    EXPECT_NE(refusalOf(writeCooked(*prepared, "")).find("too many crease sets"), std::string::npos);
    prepared->character.cage.creaseSets.resize(2);
    prepared->character.clips[0].sharpness[0].keys.firstTarget = 1; // there is one number a time
    EXPECT_NE(refusalOf(writeCooked(*prepared, "")).find("sharpness of \"b\": not one value a key"), std::string::npos);
    prepared->character.clips[0].sharpness[0].keys.firstTarget = 0;
    prepared->character.clips[0].sharpness[0].keys.times = {1.0f, 0.0f};
    EXPECT_NE(refusalOf(writeCooked(*prepared, "")).find("sharpness of \"b\""), std::string::npos);
}

TEST(Cooked, WhatIsNoCookedFileOfThisVersionIsRefused) {
    const std::shared_ptr<Prepared> prepared = prepareAll(test::kPip);
    const std::vector<std::byte> file = writeCooked(*prepared, "supple cook pip.glb -o pip.supple");
    ASSERT_TRUE(isCooked(file));
    EXPECT_EQ(refusalOf(file), "");
    std::vector<std::byte> other = file;
    other[kVersionAt] = std::byte{16};
    EXPECT_EQ(refusalOf(other),
              "hero.supple: a cooked file of version 16, and this is version 15: make it anew: supple cook "
              "pip.glb -o pip.supple");
    other = file;
    std::reverse(other.begin() + kOrderAt, other.begin() + kOrderAt + 4);
    EXPECT_EQ(refusalOf(other), "hero.supple: cooked on a machine of the other byte order: cook it anew");
    other = file;
    other[file.size() / 2] ^= std::byte{1};
    EXPECT_EQ(refusalOf(other),
              "hero.supple: the cooked file is damaged: make it anew: supple cook pip.glb -o pip.supple");
    other = file;
    other.pop_back();
    EXPECT_EQ(refusalOf(other), "hero.supple: a cooked file of " + std::to_string(file.size()) + " bytes, of which " +
                                    std::to_string(file.size() - 1) + " are there");
    other = file;
    other.push_back(std::byte{0});
    sign(other);
    EXPECT_TRUE(refusalOf(other).ends_with("more than a character")) << refusalOf(other);
    for (size_t size = kHeaderBytes; size < file.size(); size += 1 + size / 16) {
        other.assign(file.begin(), file.begin() + static_cast<ptrdiff_t>(size));
        sign(other);
        EXPECT_TRUE(refusalOf(other).starts_with("hero.supple: ")) << size;
    }
}

/// Words of a file, at random: it is read, or refused with a message that names it. tests/fuzz/cooked.cpp uses what is
/// read.
TEST(Cooked, AnyWordMayBeAnything) {
    const std::shared_ptr<Prepared> prepared = prepareAll(test::kPip);
    const std::vector<std::byte> file = writeCooked(*prepared, "");
    std::minstd_rand random(1);
    size_t refused = 0;
    for (int i = 0; i < 100; ++i) {
        std::vector<std::byte> other = file;
        const size_t at = kHeaderBytes + random() % (file.size() - kHeaderBytes - 4);
        const uint32_t values[] = {0u, 1u, 0xFFFFFFFFu, 0x80000000u, static_cast<uint32_t>(random())};
        std::memcpy(other.data() + at, &values[random() % 5], 4);
        sign(other);
        const auto read = readCooked(other, "hero.supple");
        refused += read ? 0 : 1;
        if (!read) {
            EXPECT_TRUE(read.error().message.starts_with("hero.supple: ")) << read.error().message;
        }
    }
    EXPECT_GT(refused, 5u);
}

TEST(Cooked, ACharacterThatLeadsNowhereIsRefusedByName) {
    const auto refusal = [](const std::function<void(Prepared&)>& spoil) {
        Result<cage::Character> character = cage::readGltfFile(test::kPip);
        std::shared_ptr<Prepared> prepared = Prepared::of(std::move(*character));
        spoil(*prepared);
        return refusalOf(writeCooked(*prepared, ""));
    };
    EXPECT_EQ(refusal([](Prepared&) {}), "");
    const std::string name = "hero.supple: ";
    EXPECT_EQ(refusal([](Prepared& p) { p.character.cage.faceVertices[7] = p.character.cage.vertexCount(); }),
              name + "a corner names no vertex");
    EXPECT_EQ(refusal([](Prepared& p) { p.character.cage.faceStarts[1] = 2; }),
              name + "faces do not divide the corners");
    EXPECT_EQ(refusal([](Prepared& p) { p.character.weights.influences[3].joint = 1000; }),
              name + "an influence names no joint, or has no finite weight");
    EXPECT_EQ(refusal([](Prepared& p) { p.character.skeleton.nodes[0].parent = 0; }).substr(0, 20), name + "node 0:");
    EXPECT_EQ(refusal([](Prepared& p) { p.character.clips[0].channels[0].node = 10'000; }),
              name + "clip 0 channel 0: no such node");
    EXPECT_EQ(refusal([](Prepared& p) { p.character.clips[0].channels[0].values.pop_back(); }),
              name + "clip 0 channel 0: not as many values as keys");
    EXPECT_EQ(refusal([](Prepared& p) { p.character.materials[0].baseColorTexture.image = 99; }),
              name + "material 0: a texture names no image or no UV set");
    EXPECT_TRUE(refusal([](Prepared& p) {
                    p.character.parts[0].polygonSource = static_cast<cage::PolygonSource>(-1);
                }).ends_with("no such enumerator: 4294967295"));
    EXPECT_TRUE(refusal([](Prepared& p) {
                    p.choices[0].scheme = static_cast<surface::SchemeId>(0);
                }).ends_with("no such enumerator: 0"));
    EXPECT_EQ(refusal([](Prepared& p) { p.choices.clear(); }), name + "no scheme is chosen for some part");
    // All at once.
    EXPECT_EQ(refusal([](Prepared& p) {
                  p.character.parts[0].node = 10'000;
                  p.character.skin.joints[0] = 10'000;
              }),
              name + "part 0: no such node\n" + name + "joints are no nodes, or have no inverse bind matrices");
}

} // namespace
} // namespace supple::runtime
