// Characters that are prepared: what is drawn has the same bits, and what a group builds itself is said.
#include "runtime/api/descriptions.h"
#include "surface/table_header.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/sample_assets.h"
#include "tests/support/test_view.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <span>

namespace supple::test {
namespace {

std::vector<std::byte> preparedBytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> chars((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::vector<std::byte> copy(chars.size());
    std::memcpy(copy.data(), chars.data(), chars.size());
    return copy;
}

/// Wren has ten parts, which AUTO draws by several schemes.
const std::vector<std::byte>& wrenFile() {
    static const std::vector<std::byte> bytes = preparedBytes(kWren);
    return bytes;
}

struct Plan {
    const char* name;
    SuppleGroupDesc desc;
    bool inView = false;
};
const std::vector<Plan>& plans() {
    static const SuppleBlendOptions kBlend = [] {
        SuppleBlendOptions options{};
        options.structSize = sizeof(options);
        options.creaseMode = SUPPLE_CREASES_CURVE;
        return options;
    }();
    static const SuppleFragmentsOptions kByLoop{sizeof(kByLoop), SUPPLE_RULES_LOOP};
    constexpr uint32_t kAll = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_MOTION;
    static const std::vector<Plan> kPlans = {
        {"auto", {.flags = kAll, .capacity = 2, .rate = 2}},
        {"mesh", {.flags = kAll | SUPPLE_GROUP_INDEXED_MESH, .capacity = 2, .scheme = SUPPLE_SCHEME_PM, .rate = 3}},
        {"fragments", {.capacity = 2, .scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4}},
        {"by Loop's rules", {.capacity = 2, .scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4, .fragments = &kByLoop}},
        {"blend", {.capacity = 2, .scheme = SUPPLE_SCHEME_BLEND, .rate = 4, .blend = &kBlend}},
        {"playing",
         {.capacity = 2, .scheme = SUPPLE_SCHEME_CATMULL_CLARK, .rate = 2, .poseSource = SUPPLE_POSES_PLAYBACK}},
        {"cage", {.capacity = 2, .scheme = SUPPLE_SCHEME_CAGE}},
        {"centers", {.capacity = 2, .scheme = SUPPLE_SCHEME_CAGE, .skinning = SUPPLE_SKINNING_CENTERS_OF_ROTATION}},
        {"mush", {.capacity = 2, .scheme = SUPPLE_SCHEME_CAGE, .skinning = SUPPLE_SKINNING_DELTA_MUSH}},
        {"levels", {.capacity = 2, .scheme = SUPPLE_SCHEME_CATMULL_CLARK}, true},
        {"rates", {.capacity = 2, .scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4}, true}};
    return kPlans;
}

SuppleGroupDesc withSize(SuppleGroupDesc desc) {
    desc.structSize = sizeof(desc);
    return desc;
}

/// A file, for some plans.
SupplePrepared prepareFile(std::span<const std::byte> file, SuppleMapping mapping, std::span<const Plan> planned) {
    std::vector<SuppleGroupDesc> descs;
    for (const Plan& plan : planned) {
        descs.push_back(withSize(plan.desc));
    }
    std::vector<SupplePlannedGroup> groups;
    for (size_t i = 0; i < descs.size(); ++i) {
        const bool inView = planned[i].inView;
        groups.push_back({&descs[i], inView ? 1u : 0u, inView ? uint32_t{SUPPLE_VIEW_ATTRIBUTES} : 0u});
    }
    SuppleAssetDesc asset{};
    asset.structSize = sizeof(asset);
    asset.name = "wren";
    asset.bytes = file.data();
    asset.byteCount = file.size();
    SupplePrepareDesc desc{};
    desc.structSize = sizeof(desc);
    desc.mapping = mapping;
    desc.asset = &asset;
    desc.groups = groups.data();
    desc.groupCount = static_cast<uint32_t>(groups.size());
    SupplePrepared prepared = nullptr;
    EXPECT_EQ(supplePrepare(&desc, &prepared), SUPPLE_OK);
    return prepared;
}

/// Wren, for all plans or for none.
SupplePrepared prepareWren(SuppleMapping mapping, bool planned) {
    return prepareFile(wrenFile(), mapping, planned ? std::span(plans()) : std::span<const Plan>());
}

SuppleAsset assetOf(CrowdContext& context, SupplePrepared prepared) {
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.prepared = prepared;
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(context.handle(), &desc, &asset), SUPPLE_OK);
    return asset;
}

/// The bytes of a cooked file.
std::vector<std::byte> saved(SupplePrepared prepared) {
    size_t size = 0;
    EXPECT_EQ(suppleSavePrepared(prepared, "supple cook wren.glb", nullptr, &size), SUPPLE_OK);
    std::vector<std::byte> bytes(size);
    size_t tooFew = size - 1;
    EXPECT_EQ(suppleSavePrepared(prepared, "supple cook wren.glb", bytes.data(), &tooFew), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSavePrepared(prepared, "supple cook wren.glb", bytes.data(), &size), SUPPLE_OK);
    EXPECT_EQ(size, bytes.size());
    return bytes;
}

size_t notPrepared(CrowdContext& context) {
    size_t count = 0;
    for (const LogLine& line : context.takeLines()) {
        EXPECT_NE(line.severity, SUPPLE_SEVERITY_ERROR) << line.text;
        count += line.message == SUPPLE_MESSAGE_NOT_PREPARED ? 1 : 0;
    }
    return count;
}

/// The bits of all surfaces of a group after two frames.
std::vector<std::byte> bitsOf(CrowdContext& context, SuppleAsset asset, const Plan& plan) {
    std::unique_ptr<TestView> view;
    SuppleGroupDesc desc = plan.desc;
    desc.asset = asset;
    if (plan.inView) {
        view = std::make_unique<TestView>(context, 400'000, SUPPLE_VIEW_ATTRIBUTES);
        desc.view = view->handle();
        view->look({0.0f, 1.0f, 4.0f});
    }
    Crowd crowd(context, desc);
    EXPECT_TRUE(crowd.valid());
    std::vector<std::byte> bits;
    if (!crowd.valid()) {
        return bits;
    }
    (void)crowd.spawn();
    (void)crowd.spawn();
    context.run(crowd.group());
    context.run(crowd.group());
    SuppleAssetInfo info{};
    info.structSize = sizeof(info);
    EXPECT_EQ(suppleGetAssetInfo(context.handle(), asset, &info), SUPPLE_OK);
    for (uint32_t slot = 0; slot < 2; ++slot) { // without the padding between instances
        const SuppleBufferRange cages = crowd.output().info.deformedCage;
        const std::vector<std::byte> cage = crowd.slotBytes(cages, slot);
        bits.insert(bits.end(), cage.begin(),
                    cage.begin() + static_cast<ptrdiff_t>(info.cageVertexCount * cages.stride));
    }
    const uint32_t surfaces = plan.desc.scheme == SUPPLE_SCHEME_CAGE ? 0 : crowd.output().info.surfaceCount;
    for (uint32_t s = 0; s < surfaces; ++s) {
        const host::GroupOutput output = crowd.output(s);
        if (output.hasLevels()) {
            continue; // places are taken by atomics: what is drawn is compared by its patches
        }
        for (const SuppleBufferRange& range : {output.grid.indices, output.streams.attributes}) {
            const std::vector<std::byte> own = crowd.read(range);
            bits.insert(bits.end(), own.begin(), own.end());
        }
        const std::vector<std::byte> vertices = crowd.read(output.streams.vertices);
        const size_t stride = output.streams.vertices.stride;
        for (uint32_t slot = 0; slot < 2 && output.grid.rateCount <= 1; ++slot) {
            const auto begin =
                vertices.begin() + static_cast<ptrdiff_t>(stride * slot * output.grid.verticesPerInstance);
            bits.insert(bits.end(), begin, begin + static_cast<ptrdiff_t>(stride * output.grid.vertexCount));
        }
    }
    return bits;
}

class PreparedCharacters : public CrowdContexts {};

TEST_F(PreparedCharacters, AreDrawnWithTheSameBitsAlsoFromAFile) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset read = own.createAsset(wrenFile(), "wren");
        const SupplePrepared prepared = prepareWren(mapping, true);
        ASSERT_NE(prepared, nullptr);
        CrowdContext other(*testDevice(), mapping);
        const SuppleAsset first = assetOf(own, prepared), second = assetOf(other, prepared);
        const std::vector<std::byte> file = saved(prepared);
        suppleDestroyPrepared(prepared);
        const SuppleAsset cooked = own.createAsset(file, "wren");
        for (const Plan& plan : plans()) {
            SCOPED_TRACE(plan.name);
            const std::vector<std::byte> expected = bitsOf(own, read, plan);
            EXPECT_FALSE(expected.empty());
            own.takeLines();
            EXPECT_TRUE(bitsOf(own, first, plan) == expected);
            EXPECT_TRUE(bitsOf(own, cooked, plan) == expected);
            if (&plan == plans().data()) { // the other context makes its pipelines anew
                EXPECT_TRUE(bitsOf(other, second, plan) == expected);
            }
            EXPECT_EQ(notPrepared(own), 0u);
            EXPECT_EQ(notPrepared(other), 0u);
        }
        // A reload takes it, too.
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.bytes = file.data();
        desc.byteCount = file.size();
        EXPECT_EQ(suppleReloadAsset(own.handle(), first, &desc), SUPPLE_OK);
        EXPECT_FALSE(bitsOf(own, first, plans()[0]).empty());
        EXPECT_EQ(notPrepared(own), 0u);
    }
}

/// Rate 8 was planned; groups ask for less.
TEST_F(PreparedCharacters, TablesOfAHigherRateServeWhereTheyMakeTheSame) {
    const ValidationGuard guard;
    constexpr uint32_t kMesh =
        SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_MOTION | SUPPLE_GROUP_INDEXED_MESH;
    const std::vector<std::byte> pip = preparedBytes(kPipQuads);
    std::vector<Plan> high;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
        for (const uint32_t flags : {uint32_t{0}, kMesh}) {
            high.push_back({"high", {.flags = flags, .capacity = 2, .scheme = scheme, .rate = 8}});
        }
    }
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset read = own.createAsset(pip, "pip");
        const SupplePrepared prepared = prepareFile(pip, mapping, high);
        ASSERT_NE(prepared, nullptr);
        const SuppleAsset asset = assetOf(own, prepared);
        suppleDestroyPrepared(prepared);
        for (const Plan& plan : high) {
            for (const uint32_t rate : {4u, 5u}) {
                SCOPED_TRACE(std::to_string(plan.desc.scheme) + ", rate " + std::to_string(rate));
                Plan low = plan;
                low.desc.rate = rate;
                const std::vector<std::byte> expected = bitsOf(own, read, low);
                EXPECT_FALSE(expected.empty());
                own.takeLines();
                EXPECT_TRUE(bitsOf(own, asset, low) == expected);
                const bool isServed = rate > 4;
                EXPECT_EQ(notPrepared(own), isServed ? 0u : 1u);
            }
        }
        Plan higher = high.front();
        higher.desc.rate = 9;
        EXPECT_FALSE(bitsOf(own, asset, higher).empty());
        EXPECT_EQ(notPrepared(own), 1u);
    }
}

/// Each table of such a file is sound by itself.
TEST_F(PreparedCharacters, RatesOfDifferentMeshesAreRefused) {
    const Plan& plan = plans().back();
    const SupplePrepared sound = prepareFile(wrenFile(), SUPPLE_MAPPING_NARROW, {&plan, 1});
    auto spoilt = std::make_shared<runtime::Prepared>(*sound->prepared);
    suppleDestroyPrepared(sound);
    for (auto& own : spoilt->tables) {
        if (own->recipe.rate == 2) {
            auto other = std::make_shared<runtime::PreparedTables>(*own);
            other->tables.poolStride += 16;
            surface::writeHeader(other->tables);
            own = other;
        }
    }
    const SupplePrepared prepared = new SupplePrepared_T{spoilt};
    const std::vector<std::byte> file = saved(prepared);
    suppleDestroyPrepared(prepared);
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset asset = own.createAsset(file, "wren");
    TestView view(own, 400'000, SUPPLE_VIEW_ATTRIBUTES);
    SuppleGroupDesc desc = withSize(plan.desc);
    desc.asset = asset;
    desc.view = view.handle();
    own.takeLines();
    SuppleGroup group{};
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ASSET);
    const std::vector<LogLine> lines = own.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].text, "wren: the tables for rate 2 are of another mesh than those for rate 4");
}

TEST_F(PreparedCharacters, AFileOfTheOtherMappingIsRefusedByName) {
    CrowdContext& narrow = context(SUPPLE_MAPPING_NARROW);
    const SupplePrepared prepared = prepareWren(SUPPLE_MAPPING_WIDE, true);
    const std::vector<std::byte> file = saved(prepared);
    suppleDestroyPrepared(prepared);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "wren.supple";
    desc.bytes = file.data();
    desc.byteCount = file.size();
    SuppleAsset asset{};
    narrow.takeLines();
    EXPECT_EQ(suppleCreateAsset(narrow.handle(), &desc, &asset), SUPPLE_ERROR_ASSET);
    std::vector<LogLine> lines = narrow.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].text,
              "wren.supple: cooked for the wide mapping alone, and this device has the narrow one: make it "
              "anew: supple cook wren.glb, with --mapping narrow or both");
    desc.flags = SUPPLE_ASSET_PAIR_QUADS;
    EXPECT_EQ(suppleCreateAsset(narrow.handle(), &desc, &asset), SUPPLE_ERROR_ARGUMENT);
    lines = narrow.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].text.starts_with("wren.supple: it is cooked, and flags other than")) << lines[0].text;
}

TEST_F(PreparedCharacters, WhatWasNotPlannedIsBuiltAndSaid) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    const SuppleAsset read = own.createAsset(wrenFile(), "wren");
    // Without plans, and with those of the other mapping.
    for (const SupplePrepared prepared :
         {prepareWren(SUPPLE_MAPPING_NARROW, false), prepareWren(SUPPLE_MAPPING_AUTO, true)}) {
        const SuppleAsset asset = assetOf(own, prepared);
        suppleDestroyPrepared(prepared);
        const Plan& plan = plans()[0];
        const std::vector<std::byte> expected = bitsOf(own, read, plan);
        own.takeLines();
        EXPECT_TRUE(bitsOf(own, asset, plan) == expected);
        EXPECT_GT(notPrepared(own), 0u);
        EXPECT_TRUE(bitsOf(own, asset, plan) == expected);
        EXPECT_EQ(notPrepared(own), 0u) << "it is there now";
    }
    // A reload takes what was prepared, too.
    const SupplePrepared again = prepareWren(SUPPLE_MAPPING_NARROW, true);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.prepared = again;
    own.takeLines();
    EXPECT_EQ(suppleReloadAsset(own.handle(), read, &desc), SUPPLE_OK);
    suppleDestroyPrepared(again);
    EXPECT_FALSE(bitsOf(own, read, plans()[1]).empty());
    EXPECT_EQ(notPrepared(own), 0u);
}

/// What supplePrepare logs.
struct Told {
    SuppleResult result = SUPPLE_OK;
    std::vector<std::string> errors;
};
Told tryToPrepare(const std::function<void(SupplePrepareDesc&)>& spoil) {
    Told told;
    const SuppleAssetDesc asset = tubeDesc();
    SupplePrepareDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = &asset;
    desc.logUser = &told;
    desc.log = [](SuppleSeverity severity, SuppleMessage, const char* text, void* user) {
        if (severity == SUPPLE_SEVERITY_ERROR) {
            static_cast<Told*>(user)->errors.emplace_back(text);
        }
    };
    spoil(desc);
    SupplePrepared out = nullptr;
    told.result = supplePrepare(&desc, &out);
    EXPECT_EQ(out != nullptr, told.result == SUPPLE_OK);
    suppleDestroyPrepared(out);
    return told;
}

TEST(Preparing, FaultsAreNamed) {
    static SuppleGroupDesc group = withSize({.flags = SUPPLE_GROUP_TANGENTS});
    static SuppleGroupDesc twoHalves = withSize({.rate = 65});
    static SupplePlannedGroup planned{&group, 0, 0};
    const struct {
        std::function<void(SupplePrepareDesc&)> spoil;
        SuppleResult result;
        std::string text;
    } faults[] = {{[](auto&) {}, SUPPLE_OK, ""},
                  {[](auto& d) { d.asset = nullptr; }, SUPPLE_ERROR_ARGUMENT, "supplePrepare: desc.asset is null"},
                  {[](auto& d) { d.groupCount = 1; }, SUPPLE_ERROR_ARGUMENT, "supplePrepare: groups is null"},
                  {[](auto& d) { d.mapping = static_cast<SuppleMapping>(3); }, SUPPLE_ERROR_ARGUMENT,
                   "supplePrepare: no such mapping"},
                  {[](auto& d) {
                       d.groups = &planned;
                       d.groupCount = 1;
                   },
                   SUPPLE_ERROR_ARGUMENT, "supplePrepare: groups[0]: TANGENTS go with ATTRIBUTES"},
                  {[](auto& d) {
                       static const SupplePlannedGroup kGroups[] = {{&twoHalves, 0, 0}};
                       d.groups = kGroups;
                       d.groupCount = 1;
                   },
                   SUPPLE_ERROR_ARGUMENT, "supplePrepare: groups[0]: rate must be 1..64"},
                  {[](auto& d) {
                       static const SuppleGroupDesc kPlain = withSize({});
                       static const SupplePlannedGroup kGroups[] = {{&kPlain, 0, SUPPLE_VIEW_CULL}};
                       d.groups = kGroups;
                       d.groupCount = 1;
                   },
                   SUPPLE_ERROR_ARGUMENT, "supplePrepare: groups[0]: viewFlags without a view"},
                  {[](auto& d) {
                       static const SuppleScheme kSchemes[] = {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO};
                       static const SuppleGroupDesc kGroup = withSize({.partSchemes = kSchemes, .partSchemeCount = 2});
                       static const SupplePlannedGroup kGroups[] = {{&kGroup, 0, 0}};
                       d.groups = kGroups;
                       d.groupCount = 1;
                   },
                   SUPPLE_ERROR_ARGUMENT, "supplePrepare: groups[0]: tube: 2 schemes for 1 parts"},
                  {[](auto& d) {
                       static SuppleAssetDesc half = *d.asset;
                       half.byteCount /= 2;
                       d.asset = &half;
                   },
                   SUPPLE_ERROR_ASSET, "tube: "}};
    for (const auto& fault : faults) {
        const Told told = tryToPrepare(fault.spoil);
        EXPECT_EQ(told.result, fault.result) << fault.text;
        EXPECT_EQ(told.errors.size(), fault.text.empty() ? 0u : 1u) << fault.text;
        EXPECT_TRUE(told.errors.empty() || told.errors[0].starts_with(fault.text)) << told.errors[0];
    }
}

} // namespace
} // namespace supple::test
