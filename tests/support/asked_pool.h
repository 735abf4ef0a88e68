// A query pool, and frames that ask it: for tests of queries (supple_queries.h).
#pragma once

#include "tests/support/crowd.h"

#include <gtest/gtest.h>
#include <span>
#include <utility>
#include <vector>

namespace supple::test {

/// A group for a pool.
inline SuppleGroupDesc askedGroup(SuppleAsset asset, SuppleScheme scheme, uint32_t capacity = 3, uint32_t rate = 2) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.rate = rate;
    return desc;
}

class AskedPool {
public:
    /// `count`: of rays or places a frame, at most.
    AskedPool(CrowdContext& context, std::vector<SuppleGroup> groups, size_t count, uint32_t flags = 0)
        : context_(context), groups_(std::move(groups)) {
        SuppleQueryPoolDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = flags;
        desc.groups = groups_.data();
        desc.groupCount = static_cast<uint32_t>(groups_.size());
        desc.rayCount = static_cast<uint32_t>(count);
        EXPECT_EQ(suppleCreateQueryPool(context.handle(), &desc, &pool_), SUPPLE_OK);
    }
    ~AskedPool() { EXPECT_EQ(suppleDestroyQueryPool(context_.handle(), pool_), SUPPLE_OK); }
    AskedPool(const AskedPool&) = delete;
    AskedPool& operator=(const AskedPool&) = delete;

    [[nodiscard]] SuppleQueryPool handle() const { return pool_; }
    /// A batch that is read back, without its rays or places.
    [[nodiscard]] static SuppleQueryDesc batchOf(size_t count) {
        SuppleQueryDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = SUPPLE_QUERY_READ_BACK;
        desc.rayCount = static_cast<uint32_t>(count);
        desc.before = desc.after = kAnyUse;
        return desc;
    }
    [[nodiscard]] static SuppleQueryDesc descOf(std::span<const SuppleRay> rays) {
        SuppleQueryDesc desc = batchOf(rays.size());
        desc.hostRays = rays.data();
        return desc;
    }
    /// A frame of these groups, or of all, that asks with this, and what it has found. It is complete when the next one
    /// begins.
    std::vector<SuppleHit> run(const SuppleQueryDesc& asked, std::vector<SuppleGroup> groups = {}) {
        groups = groups.empty() ? groups_ : std::move(groups);
        context_.beginFrame();
        const Status submitted = context_.device().submitAndWait([&](VkCommandBuffer commands) {
            EXPECT_EQ(context_.record(commands, groups), SUPPLE_OK);
            EXPECT_EQ(suppleRecordQueries(context_.handle(), commands, pool_, &asked), SUPPLE_OK);
        });
        EXPECT_TRUE(submitted.ok());
        const uint64_t own = context_.frame;
        context_.beginFrame();
        uint64_t frame = 0;
        std::vector<SuppleHit> hits = read(&frame);
        EXPECT_EQ(frame, own);
        EXPECT_EQ(hits.size(), asked.rayCount);
        return hits;
    }
    std::vector<SuppleHit> run(const std::vector<SuppleRay>& rays, std::vector<SuppleGroup> groups = {},
                               const std::vector<SuppleTriangleHit>& triangles = {}) {
        SuppleQueryDesc desc = descOf(rays);
        desc.hostTriangles = triangles.empty() ? nullptr : triangles.data();
        return run(desc, std::move(groups));
    }
    std::vector<SuppleHit> run(const std::vector<SupplePlace>& places) {
        SuppleQueryDesc desc = batchOf(places.size());
        desc.hostPlaces = places.data();
        return run(desc);
    }
    /// The hits of the newest complete frame, and which one that is.
    [[nodiscard]] std::vector<SuppleHit> read(uint64_t* frame = nullptr) const {
        uint32_t count = 0;
        EXPECT_EQ(suppleReadHits(context_.handle(), pool_, nullptr, &count, nullptr), SUPPLE_OK);
        std::vector<SuppleHit> hits(count);
        EXPECT_EQ(suppleReadHits(context_.handle(), pool_, hits.data(), &count, frame), SUPPLE_OK);
        return hits;
    }

private:
    CrowdContext& context_;
    std::vector<SuppleGroup> groups_;
    SuppleQueryPool pool_{};
};

} // namespace supple::test
