// Query pools: a batch of rays a frame, and what they meet.
#pragma once

#include "gpu/buffer_plan.h"
#include "gpu/frame_member.h"
#include "runtime/queries/query_group.h"
#include "supple/supple_queries.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

/// Recording and reading allocate nothing.
class QueryPool final : public gpu::FrameMember {
public:
    /// The device must outlive the pool. Groups come by add().
    /// `findsNearest`: SUPPLE_QUERY_POOL_NEAREST.
    [[nodiscard]] static Result<std::shared_ptr<QueryPool>> create(const gpu::Device& device, uint32_t rayCount,
                                                                   uint32_t framesInFlight, bool findsNearest);

    /// A group of the pool, by its number.
    struct Member {
        uint64_t id = 0;                   ///< of the group
        std::shared_ptr<QueryGroup> group; ///< null: it was destroyed
        bool isAsked = false;              ///< by the batch that is recorded
        bool isEmpty = false;              ///< the frame has left it out, or it waits for its uploads
        uint32_t rate = 1;                 ///< of its grids and meshes
    };
    [[nodiscard]] std::span<Member> members() { return members_; }
    [[nodiscard]] std::span<const Member> members() const { return members_; }
    /// The member, or null if the pool lacks the group.
    [[nodiscard]] Member* find(uint64_t id);
    void add(uint64_t id, std::shared_ptr<QueryGroup> group) { members_.push_back({id, std::move(group)}); }
    /// Another group is to take the member's place, or none; so that put() needs no memory.
    void makeRoom() { retired_.reserve(retired_.size() + 2 * members_.size()); }
    /// `group`: null, and the member is gone. Frames up to `lastFrame` may still use what it was.
    void put(Member& member, std::shared_ptr<QueryGroup> group, uint64_t lastFrame);
    /// What its groups are made with.
    [[nodiscard]] QueryBuffers buffers() const {
        return {device_.buffer(0), device_.buffer(1), device_.buffer(2), rayCount_};
    }

    void fill(SuppleQueryOutput& out) const;
    [[nodiscard]] uint32_t rayCount() const { return rayCount_; }
    [[nodiscard]] bool findsNearest() const { return findsNearest_; }
    [[nodiscard]] uint64_t lastRecordedFrame() const { return recordedFrame_; }
    /// Whether the frame has a batch of it.
    [[nodiscard]] bool hasBatch(uint64_t frame) const { return queriedFrame_ == frame; }

    /// What a batch reads: elements of the host's, or from a place of a buffer on.
    struct Source {
        const void* host = nullptr;
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;
        uint32_t elementBytes = sizeof(SuppleRay);

        [[nodiscard]] bool isThere() const { return host != nullptr || buffer != VK_NULL_HANDLE; }
    };
    struct Asked {
        Source rays, triangles; ///< triangles: what the rays have met, to be refined
        Source places;          ///< instead of both
        uint32_t count = 0;
        bool readsBack = false;
    };
    /// Asks the members that are asked, with the barriers in between. What it waits for is before it.
    void record(VkCommandBuffer commandBuffer, uint64_t frame, const Asked& asked);
    /// The hits of the newest completed batch that is read back.
    struct Batch {
        uint64_t frame = 0;
        std::span<const SuppleHit> hits;
    };
    [[nodiscard]] std::optional<Batch> newest() const;

    [[nodiscard]] bool staticsPending() const override;
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override;
    void countStatics(gpu::StaticCount& count) const override;
    [[nodiscard]] Status stageStatics() override;
    void beginFrame(uint64_t completedFrame) override;
    void cancelFrame(uint64_t frame) override;

private:
    struct Copy {
        uint64_t frame = 0; ///< 0: none
        uint32_t count = 0;
    };
    struct Retired {
        std::shared_ptr<QueryGroup> group;
        uint64_t lastFrame = 0;
    };
    template <class F>
    void forGroups(F&& visit) const; ///< visit(QueryGroup&), of those that are there
    template <class F>
    void forStatics(F&& visit) const; ///< visit(gpu::StaticBuffers&), of these
    /// Calls record(group, batch) for the members that are asked.
    template <class F>
    void forAsked(uint32_t rays, F&& record) const;
    /// Copies to the rays, from their element `first` on.
    void recordCopy(VkCommandBuffer commandBuffer, const Source& source, uint32_t first, uint32_t count) const;
    /// Calls record(group, batch) for those that are asked, with a barrier behind all.
    template <class F>
    void recordEach(gpu::Dispatches& dispatches, uint32_t rays, F&& record) const;
    void recordRays(gpu::Dispatches& dispatches, uint32_t rays) const;
    /// What few rays meet, and many.
    void recordPick(gpu::Dispatches& dispatches, uint32_t rays) const;
    void recordCast(gpu::Dispatches& dispatches, uint32_t rays) const;
    void recordRefine(gpu::Dispatches& dispatches, uint32_t rays) const;
    void recordNearest(gpu::Dispatches& dispatches, uint32_t places) const;
    void recordReadback(VkCommandBuffer commandBuffer, uint64_t frame, uint32_t count);

    const gpu::Device* owner_ = nullptr;
    uint32_t rayCount_ = 0;
    bool findsNearest_ = false;
    gpu::BufferSet device_, readback_;
    std::vector<Member> members_;
    std::vector<Retired> retired_;
    std::vector<Copy> copies_;   ///< one more than there are frames in flight, so that the newest complete one stays
    size_t next_ = 0;            ///< the oldest
    uint64_t recordedFrame_ = 0; ///< has anything of it
    uint64_t queriedFrame_ = 0;  ///< has a batch; 0: it was cancelled
    uint64_t completedFrame_ = 0;
};

} // namespace supple::runtime
