// Where every surface vertex was: SUPPLE_GROUP_MOTION against the frames before, by the bits; changes of rate; frames
// that are cancelled.
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_assets.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <optional>
#include <type_traits>

namespace supple::test {
namespace {

const std::string kHelmet = std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb";

/// A pose that no other frame and instance has.
struct MovingPose {
    uint32_t clip = 0;
    double time = 0.0;
    glm::mat4 transform{1.0f};
};
MovingPose poseOf(uint32_t frame, uint32_t instance) {
    MovingPose pose;
    pose.clip = 1 + (frame + instance) % 2;
    pose.time = 0.11 * frame + 0.23 * instance;
    const auto f = static_cast<float>(frame), i = static_cast<float>(instance);
    pose.transform = glm::rotate(glm::translate(glm::mat4(1.0f), {0.2f * f - i, 0.05f * f, 0.7f * i}),
                                 0.2f * f + 0.5f * i, {0.0f, 1.0f, 0.0f});
    return pose;
}
void apply(Crowd& crowd, SuppleInstance instance, const MovingPose& pose) {
    const uint32_t clip = pose.clip == SUPPLE_BIND_POSE ? pose.clip : pose.clip % crowd.clipCount();
    crowd.pose(instance, clip, pose.time, pose.transform);
}

/// What motion is due, kept as the frames go by.
class MotionModel {
public:
    explicit MotionModel(Crowd& crowd) : crowd_(crowd) {}

    /// An instance of a slot, posed anew every frame.
    void add(SuppleInstance instance) {
        members_[instance.slot] = {instance, true};
        past_[instance.slot].reset();
    }
    void remove(uint32_t slot) {
        members_.erase(slot);
        past_[slot].reset();
    }
    void setVisible(uint32_t slot, bool visible) {
        members_[slot].visible = visible;
        crowd_.setVisible(members_[slot].instance, visible);
    }
    void teleport(uint32_t slot) {
        crowd_.teleport(members_[slot].instance);
        past_[slot].reset();
    }
    void forgetAll() { past_.clear(); }
    [[nodiscard]] SuppleInstance instance(uint32_t slot) { return members_[slot].instance; }

    /// Everyone moves on; hidden ones too.
    void move(uint32_t frame) {
        for (const auto& [slot, member] : members_) {
            apply(crowd_, member.instance, poseOf(frame, slot));
        }
    }
    /// Runs a frame and compares what it says with what was seen before.
    void frame(uint32_t number, const char* what) {
        SCOPED_TRACE("frame " + std::to_string(number) + ": " + what);
        move(number);
        crowd_.run();
        check();
    }
    void check() {
        std::vector<uint32_t> slots;
        for (const auto& [slot, member] : members_) {
            if (!member.visible) {
                past_[slot].reset();
                continue;
            }
            slots.push_back(slot);
            const PositionBits now = crowd_.positions(slot), previous = crowd_.previous(slot);
            std::optional<PositionBits>& past = past_[slot];
            EXPECT_EQ(differences(previous, past ? *past : now), 0u)
                << "slot " << slot << (past ? ": not where it was" : ": is new, but moves");
            if (past) {
                EXPECT_GT(differences(now, *past), now.size() / 2) << "slot " << slot << " stands still";
            }
            past = now;
        }
        EXPECT_EQ(crowd_.listed(), slots);
    }

private:
    struct Member {
        SuppleInstance instance{};
        bool visible = true;
    };
    Crowd& crowd_;
    std::map<uint32_t, Member> members_;
    std::map<uint32_t, std::optional<PositionBits>> past_;
};

struct MotionCase {
    std::string name;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    uint32_t rate = 3;
    SuppleMapping mapping = SUPPLE_MAPPING_NARROW;
    SuppleVertexFormat format = SUPPLE_VERTEX_16;
    uint32_t flags = 0; ///< always

    [[nodiscard]] SuppleGroupDesc desc(CrowdContext& context, uint32_t capacity, uint32_t flags) const {
        SuppleGroupDesc desc{};
        // A small character where it subdivides: its wide mapping is slow without a GPU.
        const bool subdivides = scheme == SUPPLE_SCHEME_FRAGMENTS || scheme == SUPPLE_SCHEME_LOOP;
        desc.asset = context.asset(scheme == SUPPLE_SCHEME_PREP ? kPipQuads : subdivides ? kHelmet : kPip);
        desc.capacity = capacity;
        desc.scheme = scheme;
        desc.rate = rate;
        desc.vertexFormat = format;
        desc.flags = flags | this->flags;
        return desc;
    }
    friend std::ostream& operator<<(std::ostream& out, const MotionCase& c) { return out << c.name; }
};
/// Every scheme in both mappings and in both formats of vertices, one format a mapping, of every other scheme the other
/// way round.
std::vector<MotionCase> motionCases() {
    std::vector<MotionCase> cases;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleVertexFormat format : {SUPPLE_VERTEX_16, SUPPLE_VERTEX_24}) {
            const std::string suffix = format == SUPPLE_VERTEX_16 ? "16" : "24";
            bool taken = (mapping == SUPPLE_MAPPING_NARROW) == (format == SUPPLE_VERTEX_16);
            // At rate 8 the narrow mapping subdivides through scratch memory.
            const uint32_t subdivisionRate = mapping == SUPPLE_MAPPING_NARROW ? 8 : 4;
            const MotionCase own[] = {{"Prep", SUPPLE_SCHEME_PREP, 3},
                                      {"Pm", SUPPLE_SCHEME_PM, 3},
                                      {"Fragments", SUPPLE_SCHEME_FRAGMENTS, subdivisionRate},
                                      {"Loop", SUPPLE_SCHEME_LOOP, subdivisionRate},
                                      {"Blend", SUPPLE_SCHEME_BLEND, 4},
                                      {"Polygons", SUPPLE_SCHEME_POLYGONS, 1},
                                      {"Polygons", SUPPLE_SCHEME_POLYGONS, 1}, // in both formats
                                      {"PrepShared", SUPPLE_SCHEME_PREP, 3},
                                      {"PmShared", SUPPLE_SCHEME_PM, 3},
                                      {"CatmullClark", SUPPLE_SCHEME_CATMULL_CLARK, 5},
                                      {"CatmullClarkShared", SUPPLE_SCHEME_CATMULL_CLARK, 5},
                                      {"LoopShared", SUPPLE_SCHEME_LOOP, 4},
                                      {"LoopShared", SUPPLE_SCHEME_LOOP, 4}}; // in both formats
            for (MotionCase c : own) {
                c.flags = c.name.find("Shared") != std::string::npos ? SUPPLE_GROUP_INDEXED_MESH : 0;
                c.name = mappingName(mapping) + c.name + suffix;
                c.mapping = mapping;
                c.format = format;
                if (taken) {
                    cases.push_back(c);
                }
                taken = !taken;
            }
        }
    }
    return cases;
}

class Motion : public CrowdContexts, public testing::WithParamInterface<MotionCase> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Motion, testing::ValuesIn(motionCases()), [](const auto& c) { return c.param.name; });

TEST_P(Motion, PreviousPositionsAreThoseOfTheRecordBefore) {
    const ValidationGuard guard;
    CrowdContext& own = context(GetParam().mapping);
    ASSERT_TRUE(own.valid());
    Crowd crowd(own, GetParam().desc(own, 6, SUPPLE_GROUP_MOTION));
    Crowd other(own, GetParam().desc(own, 2, 0)); // evaluates single poses, and is recorded when the crowd is not
    ASSERT_TRUE(crowd.valid() && other.valid());
    const SuppleInstance alone = (static_cast<void>(other.spawn()), other.spawn());
    MotionModel model(crowd);
    for (uint32_t i = 0; i < 4; ++i) {
        model.add(crowd.spawn());
    }
    model.frame(0, "all are new");
    model.frame(1, "all move");
    model.teleport(1);
    model.frame(2, "one is teleported");
    model.setVisible(2, false);
    model.add(crowd.spawn());
    model.frame(3, "the teleported moves again, one is hidden, one spawned");
    model.setVisible(2, true);
    model.frame(4, "the hidden is shown");
    crowd.destroy(model.instance(0));
    model.remove(0);
    model.add(crowd.spawn());
    EXPECT_EQ(model.instance(0).slot, 0u);
    model.setVisible(3, false);
    model.setVisible(3, true);
    model.frame(5, "one is another in the same slot; hiding and showing between frames is nothing");

    // A frame without the group, in which all move on.
    model.move(6);
    own.run(other.group());
    crowd.destroy(model.instance(4));
    model.remove(4);
    model.frame(7, "back after a frame in which another group was recorded");

    model.teleport(1);
    model.teleport(2);
    crowd.setVisible(model.instance(2), false);
    own.run(other.group());
    crowd.setVisible(model.instance(2), true);
    model.frame(8, "teleported before a frame without the group");
    model.frame(9, "all move");

    // True displacements, from a group that only ever sees one pose.
    const std::vector<glm::vec3> now = asPositions(crowd.positions(3)), before = asPositions(crowd.previous(3));
    std::vector<glm::vec3> wanted[2];
    for (const uint32_t frame : {8u, 9u}) {
        apply(other, alone, poseOf(frame, 3));
        other.run();
        wanted[frame - 8] = asPositions(other.positions(alone.slot));
    }
    ASSERT_EQ(now.size(), wanted[1].size());
    size_t different = 0;
    float farthest = 0.0f;
    for (size_t v = 0; v < now.size(); ++v) {
        const glm::vec3 moved = now[v] - before[v], displacement = wanted[1][v] - wanted[0][v];
        different += std::memcmp(&moved, &displacement, sizeof(moved)) != 0 ? 1 : 0;
        farthest = std::max(farthest, glm::length(displacement));
    }
    EXPECT_EQ(different, 0u);
    EXPECT_GT(farthest, 0.1f);
}

class MotionFrames : public CrowdContexts {
protected:
    /// One pose at one rate, evaluated by a group that sees nothing else.
    static PositionBits evaluated(const MotionCase& c, uint32_t frame, uint32_t instance) {
        CrowdContext& own = context(c.mapping);
        Crowd alone(own, c.desc(own, 1, 0));
        if (!alone.valid()) {
            return {};
        }
        apply(alone, alone.spawn(), poseOf(frame, instance));
        alone.run();
        return alone.positions(0);
    }
};

/// The draw ranges and the indices of a group are those of one created at that rate.
void expectSameDraws(const Crowd& crowd, const Crowd& fresh) {
    const host::GroupOutput a = crowd.output(), b = fresh.output();
    EXPECT_EQ(a.grid.rate, b.grid.rate);
    EXPECT_EQ(a.grid.vertexCount, b.grid.vertexCount);
    EXPECT_GE(a.grid.verticesPerInstance, a.grid.vertexCount);
    ASSERT_EQ(a.grid.drawRangeCount, b.grid.drawRangeCount);
    const auto indices = [](const Crowd& from, const SuppleDrawRange& range) {
        const SuppleBufferRange view = from.output().indices();
        EXPECT_LE(2u * (range.firstIndex + range.indexCount), view.size);
        return from.read({view.buffer, 2u * range.firstIndex, 2u * range.indexCount, 2});
    };
    const std::vector<VkDrawIndexedIndirectCommand> draws = crowd.draws();
    for (uint32_t r = 0; r < a.grid.drawRangeCount; ++r) {
        const SuppleDrawRange &x = a.grid.drawRanges[r], &y = b.grid.drawRanges[r];
        EXPECT_EQ(x.firstPatch, y.firstPatch);
        EXPECT_EQ(x.patchCount, y.patchCount);
        EXPECT_EQ(x.material, y.material);
        EXPECT_EQ(x.domain, y.domain);
        EXPECT_EQ(x.samplesPerPatch, y.samplesPerPatch);
        EXPECT_EQ(x.firstVertex, y.firstVertex);
        EXPECT_EQ(x.indexCount, y.indexCount);
        EXPECT_EQ(indices(crowd, x), indices(fresh, y));
        EXPECT_EQ(draws[r].indexCount, x.indexCount);
        EXPECT_EQ(draws[r].firstIndex, x.firstIndex);
        EXPECT_EQ(draws[r].vertexOffset, 0);
        EXPECT_EQ(draws[r].firstInstance, 0u);
        EXPECT_EQ(draws[r].instanceCount, x.patchCount * static_cast<uint32_t>(crowd.listed().size()));
    }
}

TEST_F(MotionFrames, AChangedRateHasThePastAtTheNewRate) {
    const ValidationGuard guard;
    constexpr uint32_t kMax = 5;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
            MotionCase c{"", scheme, kMax, mapping, scheme == SUPPLE_SCHEME_PM ? SUPPLE_VERTEX_16 : SUPPLE_VERTEX_24};
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            Crowd crowd(own, c.desc(own, 3, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES));
            ASSERT_TRUE(crowd.valid());
            const SuppleInstance instances[] = {crowd.spawn(), crowd.spawn()};
            uint32_t frame = 0;
            for (const uint32_t rate : {kMax, 2u, 1u, 4u, kMax, kMax}) {
                SCOPED_TRACE(mappingName(mapping) + " scheme " + std::to_string(scheme) + " at rate " +
                             std::to_string(rate) + ", frame " + std::to_string(frame));
                crowd.setRate(rate);
                for (const SuppleInstance& instance : instances) {
                    apply(crowd, instance, poseOf(frame, instance.slot));
                }
                crowd.run();
                c.rate = rate;
                EXPECT_EQ(differences(crowd.positions(1), evaluated(c, frame, 1)), 0u);
                if (frame > 0) {
                    EXPECT_EQ(differences(crowd.previous(1), evaluated(c, frame - 1, 1)), 0u);
                }
                Crowd fresh(own, c.desc(own, 1, SUPPLE_GROUP_ATTRIBUTES));
                ASSERT_TRUE(fresh.valid());
                static_cast<void>(fresh.spawn());
                fresh.run();
                expectSameDraws(crowd, fresh);
                const auto attributes = [&](const Crowd& from) {
                    std::vector<std::byte> bytes = from.read(from.output().streams.attributes);
                    bytes.resize(size_t{from.output().grid.vertexCount} * 16);
                    return bytes;
                };
                EXPECT_TRUE(attributes(crowd) == attributes(fresh));
                ++frame;
            }
        }
    }
}

TEST_F(MotionFrames, RefusedRatesLeaveEverythingAsItWas) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const auto refused = [&](const MotionCase& c, uint32_t rate) {
        SCOPED_TRACE(c.name + " at rate " + std::to_string(rate));
        Crowd crowd(own, c.desc(own, 1, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES));
        ASSERT_TRUE(crowd.valid());
        const SuppleInstance instance = crowd.spawn();
        apply(crowd, instance, poseOf(0, 0));
        crowd.run();
        const host::GroupOutput before = crowd.output();
        const std::vector<SuppleDrawRange> ranges(before.grid.drawRanges,
                                                  before.grid.drawRanges + before.grid.drawRangeCount);
        EXPECT_EQ(suppleSetRate(own.handle(), crowd.group(), rate), SUPPLE_ERROR_ARGUMENT);
        EXPECT_NE(own.takeError(), 0);
        const host::GroupOutput after = crowd.output();
        EXPECT_EQ(after.info.capacity, before.info.capacity);
        EXPECT_EQ(after.grid.rate, before.grid.rate);
        EXPECT_EQ(after.grid.vertexCount, before.grid.vertexCount);
        ASSERT_EQ(after.grid.drawRangeCount, before.grid.drawRangeCount);
        EXPECT_EQ(after.streams.vertices.buffer, before.streams.vertices.buffer);
        EXPECT_EQ(after.streams.vertices.offset, before.streams.vertices.offset);
        EXPECT_EQ(after.grid.indices.buffer, before.grid.indices.buffer);
        EXPECT_EQ(after.grid.indices.offset, before.grid.indices.offset);
        static_assert(std::has_unique_object_representations_v<SuppleDrawRange>);
        EXPECT_EQ(std::memcmp(ranges.data(), after.grid.drawRanges, ranges.size() * sizeof(ranges[0])), 0);
        // Asking for the rate it was created with is always right.
        EXPECT_EQ(suppleSetRate(own.handle(), crowd.group(), c.rate), SUPPLE_OK);
        const PositionBits past = crowd.positions(0);
        apply(crowd, instance, poseOf(1, 0));
        crowd.run();
        EXPECT_EQ(differences(crowd.previous(0), past), 0u);
        EXPECT_EQ(differences(crowd.positions(0), evaluated(c, 1, 0)), 0u);
    };
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
        const MotionCase c{"any rate", scheme, 3, SUPPLE_MAPPING_NARROW};
        refused(c, 0);
        refused(c, scheme == SUPPLE_SCHEME_CATMULL_CLARK ? 5 : 4); // it rounds 3 up to 4
        refused(c, 0xFFFFFFFFu);
    }
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_BLEND}) {
        for (const uint32_t rate : {0u, 3u, 64u, 65u}) {
            refused({"one rate", scheme, 4, SUPPLE_MAPPING_NARROW}, rate);
        }
    }
}

TEST_F(MotionFrames, ACancelledFrameLeavesNoMotion) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_LOOP}) {
            const MotionCase c{"", scheme, 2, mapping};
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            Crowd crowd(own, c.desc(own, 3, SUPPLE_GROUP_MOTION));
            Crowd bystander(own, c.desc(own, 1, SUPPLE_GROUP_MOTION)); // is not recorded in the cancelled frame
            ASSERT_TRUE(crowd.valid() && bystander.valid());
            MotionModel model(crowd), others(bystander);
            model.add(crowd.spawn());
            model.add(crowd.spawn());
            others.add(bystander.spawn());
            model.frame(0, "before");
            model.frame(1, "before");
            others.frame(0, "bystander");
            model.move(2);
            own.cancel(crowd.group());
            EXPECT_EQ(suppleCancelFrame(own.handle()), SUPPLE_ERROR_ARGUMENT);
            EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
            Commands dropped(own.device());
            dropped.record([&](VkCommandBuffer commands) {
                const SuppleGroup group = crowd.group();
                EXPECT_EQ(own.record(commands, {&group, 1}), SUPPLE_ERROR_ARGUMENT);
                EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
                EXPECT_EQ(suppleRecordUploads(own.handle(), commands), SUPPLE_ERROR_ARGUMENT);
                EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
            });
            model.forgetAll();
            model.add(crowd.spawn());
            model.frame(3, "after a cancelled frame all are new");
            EXPECT_EQ(differences(crowd.positions(1), evaluated(c, 3, 1)), 0u);
            model.frame(4, "and move again");
            EXPECT_EQ(differences(crowd.previous(1), evaluated(c, 3, 1)), 0u);
            others.frame(1, "the bystander has its motion");
        }
    }
}

TEST_F(MotionFrames, UploadsOfACancelledFrameComeAgain) {
    const ValidationGuard guard;
    // A context that has recorded nothing yet: the parameter pairs are to be uploaded too.
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const MotionCase c{"", SUPPLE_SCHEME_PM, 3, SUPPLE_MAPPING_NARROW};
    Crowd crowd(own, c.desc(own, 1, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instance = crowd.spawn();
    apply(crowd, instance, poseOf(0, 0));
    {
        // One group's whole life lies in the cancelled frame, and what it shared was uploaded for it.
        MotionCase shortLived = c;
        shortLived.scheme = SUPPLE_SCHEME_BLEND;
        shortLived.rate = 2;
        Crowd gone(own, shortLived.desc(own, 1, 0));
        ASSERT_TRUE(gone.valid());
        static_cast<void>(gone.spawn());
        const uint64_t frame = ++own.frame;
        ASSERT_EQ(suppleBeginFrame(own.handle(), frame, frame - 1), SUPPLE_OK);
        Commands dropped(own.device());
        const SuppleGroup groups[] = {crowd.group(), gone.group()};
        dropped.record([&](VkCommandBuffer commands) { EXPECT_EQ(own.record(commands, groups), SUPPLE_OK); });
        gone.end();
        EXPECT_EQ(suppleCancelFrame(own.handle()), SUPPLE_OK);
        Crowd later(own, shortLived.desc(own, 1, 0));
        ASSERT_TRUE(later.valid());
        apply(later, later.spawn(), poseOf(0, 0));
        later.run();
        EXPECT_EQ(differences(later.positions(0), evaluated(shortLived, 0, 0)), 0u) << "tables of a destroyed group";
    }
    crowd.run();
    EXPECT_EQ(differences(crowd.positions(0), evaluated(c, 0, 0)), 0u);
    EXPECT_EQ(differences(crowd.previous(0), crowd.positions(0)), 0u);
    const auto compareAttributes = [&](uint32_t rate) {
        MotionCase at = c;
        at.rate = rate;
        CrowdContext& reference = context(c.mapping);
        Crowd fresh(reference, at.desc(reference, 1, SUPPLE_GROUP_ATTRIBUTES));
        static_cast<void>(fresh.spawn());
        fresh.run();
        expectSameDraws(crowd, fresh);
        const size_t bytes = size_t{fresh.output().grid.vertexCount} * 16;
        std::vector<std::byte> a = crowd.read(crowd.output().streams.attributes),
                               b = fresh.read(fresh.output().streams.attributes);
        a.resize(bytes);
        b.resize(bytes);
        EXPECT_TRUE(a == b) << "attributes at rate " << rate;
    };
    compareAttributes(3);
    // Attributes of another rate, and uploads in a call of their own.
    crowd.setRate(2);
    Crowd young(own, c.desc(own, 1, 0));
    apply(young, young.spawn(), poseOf(1, 1));
    const uint64_t frame = ++own.frame;
    ASSERT_EQ(suppleBeginFrame(own.handle(), frame, frame - 1), SUPPLE_OK);
    Commands dropped(own.device());
    dropped.record([&](VkCommandBuffer commands) {
        EXPECT_EQ(suppleRecordUploads(own.handle(), commands), SUPPLE_OK);
        const SuppleGroup group = crowd.group();
        EXPECT_EQ(own.record(commands, {&group, 1}), SUPPLE_OK);
    });
    EXPECT_EQ(suppleCancelFrame(own.handle()), SUPPLE_OK);
    crowd.run();
    compareAttributes(2);
    young.run();
    EXPECT_EQ(differences(young.positions(0), evaluated(c, 1, 1)), 0u);
}

TEST_F(MotionFrames, WindowsOfInstancesMoveAlike) {
    // A device whose storage buffers end after a few instances, against one window: bits with holes, hidden instances
    // and new ones.
    constexpr uint32_t kCapacity = 19, kRange = 1u << 17;
    for (const SuppleMapping mapping : kMappings) {
        WrappedVulkan& wrapped = wrappedVulkan();
        host::DeviceOptions options;
        options.validation = true;
        options.suppleGetInstanceProcAddr = &wrappedGetInstanceProcAddr;
        Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
        ASSERT_TRUE(device.ok()) << device.error().message;
        wrapped.maxStorageBufferRange = kRange;
        {
            const ValidationGuard guard;
            CrowdContext small(**device, mapping);
            CrowdContext& large = context(mapping);
            ASSERT_TRUE(small.valid() && large.valid());
            for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS}) {
                SCOPED_TRACE(mappingName(mapping) + " scheme " + std::to_string(scheme));
                const auto desc = [&](CrowdContext& own) {
                    SuppleGroupDesc desc{};
                    // At rate 8 the narrow mapping subdivides through scratch memory.
                    const bool subdivides = scheme == SUPPLE_SCHEME_FRAGMENTS;
                    desc.asset = own.createAsset(cage::makeCubeSphere(subdivides ? 2 : 4));
                    desc.capacity = kCapacity;
                    desc.scheme = scheme;
                    desc.rate = subdivides ? 8 : 4;
                    desc.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_WINDOWS;
                    return desc;
                };
                Crowd windows(small, desc(small)), one(large, desc(large));
                ASSERT_TRUE(windows.valid() && one.valid());
                EXPECT_GT(windows.output().streams.vertices.size, 4u * kRange) << "too small to need windows";
                Crowd* const both[] = {&windows, &one};
                std::vector<SuppleInstance> instances[2];
                for (uint32_t frame = 0; frame < 5; ++frame) {
                    SCOPED_TRACE("frame " + std::to_string(frame));
                    for (size_t k = 0; k < 2; ++k) {
                        Crowd& crowd = *both[k];
                        std::vector<SuppleInstance>& own = instances[k];
                        const uint32_t begun = frame == 0 ? 0 : static_cast<uint32_t>(own.size());
                        for (uint32_t i = begun; i < kCapacity - (frame == 0 ? 3 : 0); ++i) {
                            own.push_back(crowd.spawn());
                        }
                        for (const SuppleInstance& instance : own) {
                            crowd.setVisible(instance, (instance.slot * 7 + frame) % 5 != 0);
                            if ((instance.slot + frame) % 11 == 0) {
                                crowd.teleport(instance);
                            }
                        }
                        for (uint32_t slot = frame; slot < kCapacity - 3; slot += 9) { // respawned in place
                            crowd.destroy(own[slot]);
                            own[slot] = crowd.spawn();
                            EXPECT_EQ(own[slot].slot, slot);
                        }
                        if (frame == 3) { // a whole window, empty
                            for (uint32_t slot = 0; slot < 12; ++slot) {
                                crowd.setVisible(own[slot], false);
                            }
                        }
                        for (const SuppleInstance& instance : own) {
                            apply(crowd, instance, {SUPPLE_BIND_POSE, 0.0, poseOf(frame, instance.slot).transform});
                        }
                        crowd.run();
                    }
                    EXPECT_EQ(windows.listed(), one.listed());
                    size_t different = 0;
                    for (const uint32_t slot : one.listed()) {
                        different += differences(windows.positions(slot), one.positions(slot));
                        different += differences(windows.previous(slot), one.previous(slot));
                    }
                    EXPECT_EQ(different, 0u);
                }
            }
        }
        EXPECT_EQ((*device)->validation()->messageCount(), 0u);
        wrapped.maxStorageBufferRange = 0;
    }
}

} // namespace
} // namespace supple::test
