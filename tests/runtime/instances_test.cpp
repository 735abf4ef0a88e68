// Instances that come and go: handles, slots, who is listed and drawn, what is written, and frames in flight.
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/sample_assets.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <set>

namespace supple::test {
namespace {

using Instances = CrowdContexts;

SuppleGroupDesc sphereDesc(CrowdContext& context, uint32_t capacity, uint32_t rate) {
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(cage::makeCubeSphere(2));
    desc.capacity = capacity;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = rate;
    return desc;
}

glm::mat4 placedAt(const glm::vec3& place) {
    return glm::translate(glm::mat4(1.0f), place);
}

TEST_F(Instances, HandlesDieWithTheirInstance) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    Crowd crowd(own, sphereDesc(own, 3, 1)), neighbour(own, sphereDesc(own, 3, 1));
    ASSERT_TRUE(crowd.valid() && neighbour.valid());
    SuppleContext handle = own.handle();
    const glm::mat4 identity(1.0f);
    const auto refused = [&](SuppleInstance instance, const char* why) {
        SCOPED_TRACE(why);
        SupplePoseDesc pose{};
        pose.structSize = sizeof(pose);
        const SuppleResult results[] = {suppleDestroyInstance(handle, instance),
                                        suppleSetVisible(handle, instance, 1),
                                        suppleTeleport(handle, instance),
                                        suppleSetClipPose(handle, instance, SUPPLE_BIND_POSE, 0.0),
                                        suppleSetPose(handle, instance, &pose),
                                        suppleSetMorphWeights(handle, instance, nullptr, 0),
                                        suppleSetMatrixPose(handle, instance, glm::value_ptr(identity), 1),
                                        suppleSetTransform(handle, instance, glm::value_ptr(identity))};
        for (const SuppleResult result : results) {
            EXPECT_EQ(result, SUPPLE_ERROR_ARGUMENT);
        }
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_STALE_HANDLE);
    };
    std::vector<SuppleInstance> all;
    for (uint32_t i = 0; i < 3; ++i) {
        all.push_back(crowd.spawn());
        EXPECT_EQ(all[i].slot, i);
        EXPECT_NE(all[i].generation, 0u);
        EXPECT_EQ(all[i].group.id, crowd.group().id);
    }
    SuppleInstance none = all[0];
    EXPECT_EQ(suppleCreateInstance(handle, crowd.group(), &none), SUPPLE_ERROR_LIMIT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_LIMIT);
    EXPECT_EQ(none.generation, 0u);
    refused(none, "what a refused creation leaves");
    EXPECT_EQ(suppleCreateInstance(handle, crowd.group(), nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetVisible(handle, all[0], 2), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);

    crowd.destroy(all[1]);
    refused(all[1], "destroyed");
    const SuppleInstance next = crowd.spawn();
    EXPECT_EQ(next.slot, 1u);
    EXPECT_NE(next.generation, all[1].generation);
    refused(all[1], "another lives in its slot");
    crowd.setVisible(next, true);
    refused({crowd.group(), 3, all[0].generation}, "slot beyond the capacity");
    refused({crowd.group(), 0xFFFFFFFFu, all[0].generation}, "slot far beyond the capacity");
    refused({crowd.group(), 0, 0}, "generation 0");
    static_cast<void>(neighbour.spawn());
    refused({neighbour.group(), all[0].slot, all[0].generation}, "another group's");
    refused({{0}, all[0].slot, all[0].generation}, "no group");

    crowd.destroy(all[0]);
    crowd.destroy(all[2]);
    EXPECT_EQ(crowd.spawn().slot, 0u) << "the lowest free slot";
    EXPECT_EQ(crowd.spawn().slot, 2u);

    std::set<uint32_t> generations;
    SuppleInstance last = next;
    for (int i = 0; i < 500; ++i) {
        crowd.destroy(last);
        last = crowd.spawn();
        EXPECT_EQ(last.slot, 1u);
        EXPECT_TRUE(generations.insert(last.generation).second);
    }
    crowd.end();
    refused(last, "its group is gone");
    Crowd successor(own, sphereDesc(own, 3, 1));
    for (int i = 0; i < 3; ++i) {
        static_cast<void>(successor.spawn());
    }
    refused(last, "another group may have its place");
    refused({successor.group(), last.slot, last.generation}, "a generation of the group before");
}

TEST_F(Instances, WhoIsVisibleIsListedDrawnAndWritten) {
    const ValidationGuard guard;
    constexpr uint32_t kCapacity = 7;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        SuppleGroupDesc desc = sphereDesc(own, kCapacity, 3);
        desc.asset = own.asset(kPip); // several draw ranges
        desc.flags = SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_MOTION;
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        const host::GroupOutput output = crowd.output();
        EXPECT_GT(output.grid.drawRangeCount, 1u);
        EXPECT_EQ(output.info.capacity, kCapacity);
        EXPECT_GE(output.info.instances.size, kCapacity * sizeof(uint32_t));
        const SuppleBufferRange views[] = {output.streams.vertices, output.streams.previousPositions,
                                           output.info.deformedCage, output.surface.patchCoefficients};
        std::map<uint32_t, SuppleInstance> members;
        const auto shown = [&](const std::set<uint32_t>& visible, float at) {
            for (const auto& [slot, instance] : members) {
                crowd.setVisible(instance, visible.count(slot) != 0);
                crowd.teleport(instance); // or else previous positions might be those that stand there already
                crowd.pose(instance, 0, at, placedAt({at, static_cast<float>(slot), 0.0f}));
            }
            std::vector<std::vector<std::byte>> before;
            for (const SuppleBufferRange& view : views) {
                before.push_back(crowd.read(view));
            }
            crowd.run();
            EXPECT_EQ(crowd.listed(), std::vector<uint32_t>(visible.begin(), visible.end()));
            const std::vector<VkDrawIndexedIndirectCommand> draws = crowd.draws();
            ASSERT_EQ(draws.size(), output.grid.drawRangeCount);
            for (uint32_t r = 0; r < output.grid.drawRangeCount; ++r) {
                EXPECT_EQ(draws[r].instanceCount, output.grid.drawRanges[r].patchCount * visible.size());
                EXPECT_EQ(draws[r].indexCount, output.grid.drawRanges[r].indexCount);
                EXPECT_EQ(draws[r].firstIndex, output.grid.drawRanges[r].firstIndex);
                EXPECT_EQ(draws[r].vertexOffset, 0);
                EXPECT_EQ(draws[r].firstInstance, 0u);
            }
            for (size_t v = 0; v < std::size(views); ++v) {
                const std::vector<std::byte> after = crowd.read(views[v]);
                const size_t bytes = after.size() / kCapacity;
                for (uint32_t slot = 0; slot < kCapacity; ++slot) {
                    const bool same =
                        std::memcmp(before[v].data() + slot * bytes, after.data() + slot * bytes, bytes) == 0;
                    EXPECT_EQ(same, visible.count(slot) == 0) << "buffer " << v << ", slot " << slot;
                }
            }
        };
        shown({}, 1.0f); // nobody there
        for (uint32_t i = 0; i < 5; ++i) {
            const SuppleInstance instance = crowd.spawn();
            members[instance.slot] = instance;
        }
        shown({}, 2.0f); // nobody visible
        shown({0, 1, 2, 3, 4}, 3.0f);
        shown({4}, 4.0f);
        shown({0, 2, 3}, 5.0f);
        crowd.destroy(members[0]);
        crowd.destroy(members[3]);
        members.erase(0);
        members.erase(3);
        shown({1, 2, 4}, 6.0f);
        shown({}, 7.0f);
        for (uint32_t i = 0; i < 4; ++i) { // 0, 3, 5, 6
            const SuppleInstance instance = crowd.spawn();
            members[instance.slot] = instance;
        }
        EXPECT_EQ(members.size(), kCapacity);
        shown({0, 1, 2, 3, 4, 5, 6}, 8.0f);
        shown({1, 3, 5}, 9.0f);
        for (const auto& [slot, instance] : members) {
            crowd.destroy(instance);
        }
        members.clear();
        shown({}, 10.0f);
    }
}

TEST_F(Instances, ANewInstanceKnowsNothingOfTheOneBefore) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc = sphereDesc(own, 1, 1);
    desc.asset = own.asset(kPip);
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    SuppleInstance instance = crowd.spawn();
    crowd.run();
    const PositionBits bind = crowd.positions(0);
    crowd.pose(instance, 1, 0.5, placedAt({1.0f, 2.0f, 3.0f}));
    crowd.setVisible(instance, false);
    crowd.destroy(instance);
    instance = crowd.spawn();
    crowd.run();
    EXPECT_EQ(crowd.listed(), std::vector<uint32_t>{0});
    EXPECT_EQ(differences(crowd.positions(0), bind), 0u);
}

/// A script of chance: instances come, go, hide and move before, between and after recording; frames are left out and
/// cancelled; submission lags behind recording. What every frame showed is copied by the frame itself and read when it
/// is known to be complete.
class Script {
public:
    static constexpr uint32_t kCapacity = 6, kMaxRate = 3;
    static constexpr float kTolerance = 2e-5f;

    Script(CrowdContext& context, uint32_t framesInFlight)
        : context_(context), inFlight_(framesInFlight), random_(framesInFlight), crowd_(context, [&] {
              SuppleGroupDesc desc = sphereDesc(context, kCapacity, kMaxRate);
              desc.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES;
              return desc;
          }()) {
        for (uint32_t rate = 1; rate <= kMaxRate; ++rate) {
            Crowd alone(context, sphereDesc(context, 1, rate));
            static_cast<void>(alone.spawn());
            alone.run();
            base_[rate] = asPositions(alone.positions(0));
        }
        output_ = crowd_.output();
        sizes_ = {output_.streams.vertices, output_.streams.previousPositions, output_.info.instances,
                  output_.indirect()};
        for (uint32_t i = 0; i < framesInFlight; ++i) {
            flights_.push_back(std::make_unique<Flight>(context.device()));
            VkDeviceSize bytes = 0;
            for (const SuppleBufferRange& view : sizes_) {
                bytes += view.size;
            }
            Result<host::Buffer> copy =
                context.device().createBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, host::MemoryKind::readback);
            EXPECT_TRUE(copy.ok());
            flights_.back()->copy = std::move(*copy);
        }
    }

    void run(uint32_t frames) {
        const uint64_t first = context_.frame;
        for (uint32_t i = 0; i < frames && !testing::Test::HasFailure(); ++i) {
            const uint64_t frame = ++context_.frame;
            SCOPED_TRACE("frame " + std::to_string(frame - first));
            Flight& flight = *flights_[frame % inFlight_];
            land(flight);
            change();
            const uint64_t completed = std::max(first, frame - std::min<uint64_t>(inFlight_, frame));
            ASSERT_EQ(suppleBeginFrame(context_.handle(), frame, completed), SUPPLE_OK);
            change();
            const bool without = chance(8), cancelled = chance(10);
            flight.commands.record([&](VkCommandBuffer commands) {
                if (!without) {
                    record(commands, flight);
                }
            });
            change();
            if (cancelled) {
                EXPECT_EQ(suppleCancelFrame(context_.handle()), SUPPLE_OK);
                flight.shown.reset();
                for (auto& [slot, member] : members_) {
                    member.past = member.past && without;
                }
                ++cancelled_;
            } else {
                unsubmitted_.push_back(&flight);
            }
            while (!unsubmitted_.empty() && chance(2)) {
                submitOne();
            }
            change();
        }
        for (uint64_t i = 1; i <= inFlight_; ++i) { // the oldest first
            land(*flights_[(context_.frame + i) % inFlight_]);
        }
        std::printf("%u frames in flight: %u frames compared, %u instances, %u of them with a past, %u cancelled\n",
                    inFlight_, compared_, instances_, withPast_, cancelled_);
        EXPECT_GT(withPast_, frames / 2);
        EXPECT_GT(instances_, withPast_ + frames / 4);
        EXPECT_GT(cancelled_, 0u);
    }

private:
    struct Member {
        SuppleInstance instance{};
        glm::vec3 place{0.0f};
        bool visible = true;
        bool past = false; ///< was shown in the last record
        glm::vec3 pastPlace{0.0f};
    };
    struct Shown { ///< what a recorded frame must show
        uint32_t rate = 0;
        std::vector<SuppleDrawRange> ranges;
        std::map<uint32_t, Member> members;
    };
    struct Flight {
        explicit Flight(host::Device& device) : commands(device) {}
        host::Buffer copy; ///< outlives the commands
        Commands commands;
        std::optional<Shown> shown;
    };

    bool chance(uint32_t in) { return random_() % in == 0; }

    void change() {
        for (uint32_t n = random_() % 3; n > 0; --n) {
            const uint32_t slot = random_() % kCapacity;
            const auto found = members_.find(slot);
            switch (random_() % 7) {
            case 0:
            case 1:
                spawn();
                break;
            case 2:
                if (found != members_.end()) {
                    crowd_.destroy(found->second.instance);
                    members_.erase(found);
                }
                break;
            case 3:
                if (found != members_.end()) {
                    found->second.visible = !found->second.visible;
                    crowd_.setVisible(found->second.instance, found->second.visible);
                }
                break;
            case 4:
                if (found != members_.end()) {
                    crowd_.teleport(found->second.instance);
                    found->second.past = false;
                }
                break;
            case 5:
                rate_ = 1 + random_() % kMaxRate;
                crowd_.setRate(rate_);
                break;
            default:
                break;
            }
        }
        for (auto& [slot, member] : members_) {
            if (chance(2)) {
                move(member);
            }
        }
    }

    void spawn() {
        uint32_t lowest = 0;
        while (members_.count(lowest) != 0) {
            ++lowest;
        }
        SuppleInstance instance{};
        const SuppleResult result = suppleCreateInstance(context_.handle(), crowd_.group(), &instance);
        EXPECT_EQ(result, lowest < kCapacity ? SUPPLE_OK : SUPPLE_ERROR_LIMIT);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(instance.slot, lowest);
            members_[instance.slot] = {instance};
            move(members_[instance.slot]);
        }
    }

    void move(Member& member) {
        // Nowhere twice.
        ++moves_;
        const uint32_t row = moves_ / 64;
        member.place = {0.25f * static_cast<float>(moves_ % 64), 4.0f * static_cast<float>(row),
                        static_cast<float>(member.instance.slot)};
        EXPECT_EQ(suppleSetTransform(context_.handle(), member.instance, glm::value_ptr(placedAt(member.place))),
                  SUPPLE_OK);
    }

    void record(VkCommandBuffer commands, Flight& flight) {
        const SuppleGroup group = crowd_.group();
        EXPECT_EQ(context_.record(commands, {&group, 1}), SUPPLE_OK);
        VkDeviceSize at = 0;
        for (const SuppleBufferRange& view : sizes_) {
            const VkBufferCopy region{view.offset, at, view.size};
            vkCmdCopyBuffer(commands, view.buffer, flight.copy.handle(), 1, &region);
            at += view.size;
        }
        host::memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                            {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        const host::GroupOutput now = crowd_.output();
        Shown shown{now.grid.rate, {now.grid.drawRanges, now.grid.drawRanges + now.grid.drawRangeCount}, {}};
        for (auto& [slot, member] : members_) {
            if (member.visible) {
                shown.members[slot] = member;
            }
            member.past = member.visible;
            member.pastPlace = member.place;
        }
        flight.shown = std::move(shown);
    }

    void submitOne() {
        unsubmitted_.front()->commands.submit();
        unsubmitted_.pop_front();
    }

    /// Waits for a flight's frame and compares what it showed.
    void land(Flight& flight) {
        while (std::count(unsubmitted_.begin(), unsubmitted_.end(), &flight) != 0) {
            submitOne();
        }
        flight.commands.wait();
        if (!flight.shown) {
            return;
        }
        const Shown shown = *std::exchange(flight.shown, std::nullopt);
        const auto* surface = static_cast<const std::byte*>(flight.copy.mapped());
        const std::byte* previous = surface + sizes_[0].size;
        const std::byte* list = previous + sizes_[1].size;
        const std::byte* draws = list + sizes_[2].size;
        for (size_t r = 0; r < shown.ranges.size(); ++r) {
            VkDrawIndexedIndirectCommand draw{};
            std::memcpy(&draw, draws + r * sizeof(draw), sizeof(draw));
            EXPECT_EQ(draw.instanceCount, shown.ranges[r].patchCount * shown.members.size());
            EXPECT_EQ(draw.indexCount, shown.ranges[r].indexCount);
            EXPECT_EQ(draw.firstIndex, shown.ranges[r].firstIndex);
        }
        const std::vector<glm::vec3>& base = base_[shown.rate];
        size_t entry = 0;
        for (const auto& [slot, member] : shown.members) {
            uint32_t listed = 0;
            std::memcpy(&listed, list + sizeof(listed) * entry++, sizeof(listed));
            EXPECT_EQ(listed, slot);
            const size_t first = size_t{slot} * output_.grid.verticesPerInstance;
            float wrong = 0.0f, wrongPast = 0.0f;
            for (size_t v = 0; v < base.size(); ++v) {
                glm::vec3 now, before;
                std::memcpy(&now, surface + (first + v) * 16, sizeof(now));
                std::memcpy(&before, previous + (first + v) * 12, sizeof(before));
                wrong = std::max(wrong, glm::length(now - base[v] - member.place));
                wrongPast = std::max(wrongPast,
                                     glm::length(before - base[v] - (member.past ? member.pastPlace : member.place)));
            }
            EXPECT_LT(wrong, kTolerance) << "slot " << slot;
            EXPECT_LT(wrongPast, kTolerance) << "slot " << slot << (member.past ? " with a past" : ", new");
            ++instances_;
            withPast_ += member.past ? 1 : 0;
        }
        ++compared_;
    }

    CrowdContext& context_;
    uint32_t inFlight_;
    std::mt19937 random_;
    Crowd crowd_;
    host::GroupOutput output_{};
    std::vector<SuppleBufferRange> sizes_;
    std::map<uint32_t, std::vector<glm::vec3>> base_; ///< by rate: the sphere at its place
    std::map<uint32_t, Member> members_;
    uint32_t rate_ = kMaxRate, moves_ = 0;
    std::vector<std::unique_ptr<Flight>> flights_;
    std::deque<Flight*> unsubmitted_; ///< recorded, in that order
    uint32_t compared_ = 0, instances_ = 0, withPast_ = 0, cancelled_ = 0;
};

TEST_F(Instances, ComeAndGoWithFramesInFlight) {
    const ValidationGuard guard;
    for (const uint32_t framesInFlight : {1u, 2u, 3u, 4u}) {
        SCOPED_TRACE(std::to_string(framesInFlight) + " frames in flight");
        CrowdContext own(*testDevice(), framesInFlight % 2 == 1 ? SUPPLE_MAPPING_NARROW : SUPPLE_MAPPING_WIDE,
                         framesInFlight);
        ASSERT_TRUE(own.valid());
        Script(own, framesInFlight).run(120);
    }
}

} // namespace
} // namespace supple::test
