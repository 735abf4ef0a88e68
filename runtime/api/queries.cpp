// supple_queries.h.
#include "runtime/api/entry.h"
#include "supple/supple_queries.h"

#include <tuple>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

constexpr const char* kCreateQueryPool = "suppleCreateQueryPool";
constexpr const char* kRecordQueries = "suppleRecordQueries";

/// What is wrong with a description, but for what its groups are.
std::optional<Error> faultOf(const Context& context, const SuppleQueryPoolDesc& desc) {
    if ((desc.flags & ~uint32_t{SUPPLE_QUERY_POOL_NEAREST}) != 0) {
        return Error{ErrorCode::range, "flags must be SuppleQueryPoolFlags"};
    }
    if (desc.groups == nullptr || desc.groupCount == 0) {
        return Error{ErrorCode::nullPointer, "groups is null or groupCount is 0"};
    }
    if (desc.rayCount == 0 || desc.rayCount > SUPPLE_MAX_QUERY_RAYS) {
        return Error{ErrorCode::range, "rayCount is " + std::to_string(desc.rayCount) + ", not 1 to " +
                                           std::to_string(SUPPLE_MAX_QUERY_RAYS)};
    }
    for (uint32_t g = 0; g < desc.groupCount; ++g) {
        const std::string name = "group " + std::to_string(g);
        if (context.groups.at(desc.groups[g].id) == nullptr) {
            return Error{ErrorCode::staleHandle, name + ": stale or foreign handle"};
        }
        for (uint32_t before = 0; before < g; ++before) {
            if (desc.groups[before].id == desc.groups[g].id) {
                return Error{ErrorCode::argument, name + " is group " + std::to_string(before) + " too"};
            }
        }
    }
    return std::nullopt;
}

/// The same of what a batch asks with.
std::optional<Error> faultOfSources(const SuppleQueryDesc& desc, bool findsNearest) {
    const bool hasPlaces = desc.hostPlaces != nullptr || desc.places.buffer != VK_NULL_HANDLE;
    const int sources = (desc.hostRays != nullptr ? 1 : 0) + (desc.rays.buffer != VK_NULL_HANDLE ? 1 : 0) +
                        (desc.hostPlaces != nullptr ? 1 : 0) + (desc.places.buffer != VK_NULL_HANDLE ? 1 : 0);
    if (desc.rayCount > 0 && sources != 1) {
        return Error{ErrorCode::nullPointer,
                     "rays or places must come from hostRays, rays, hostPlaces or places, from one of them"};
    }
    const bool hasTriangles = desc.hostTriangles != nullptr || desc.triangles.buffer != VK_NULL_HANDLE;
    if (hasPlaces && !findsNearest) {
        return Error{ErrorCode::argument, "places: the pool was created without SUPPLE_QUERY_POOL_NEAREST"};
    }
    if (hasPlaces && hasTriangles) {
        return Error{ErrorCode::argument, "triangles go with rays, not with places"};
    }
    if (desc.hostTriangles != nullptr && desc.triangles.buffer != VK_NULL_HANDLE) {
        return Error{ErrorCode::nullPointer, "triangles must come from hostTriangles or from a buffer, not both"};
    }
    return std::nullopt;
}

/// The same of a batch of a pool.
std::optional<Error> faultOf(const SuppleQueryDesc& desc, const runtime::QueryPool& pool) {
    const uint32_t most = pool.rayCount();
    if ((desc.flags & ~uint32_t{SUPPLE_QUERY_READ_BACK}) != 0) {
        return Error{ErrorCode::range, "unknown flags"};
    }
    if ((desc.groups == nullptr) != (desc.groupCount == 0)) {
        return Error{ErrorCode::nullPointer, "groups and groupCount do not agree"};
    }
    if (desc.rayCount > most) {
        return Error{ErrorCode::range,
                     std::to_string(desc.rayCount) + " rays: the pool is for " + std::to_string(most)};
    }
    if (auto fault = faultOfSources(desc, pool.findsNearest())) {
        return fault;
    }
    for (const auto& [name, range, bytes] : {std::tuple("rays", desc.rays, sizeof(SuppleRay)),
                                             std::tuple("triangles", desc.triangles, sizeof(SuppleTriangleHit)),
                                             std::tuple("places", desc.places, sizeof(SupplePlace))}) {
        const bool fits = range.offset % 4 == 0 && range.size / bytes >= desc.rayCount;
        if (range.buffer != VK_NULL_HANDLE && !fits) {
            return Error{ErrorCode::range, std::string(name) + ": the range is too small for " +
                                               std::to_string(desc.rayCount) +
                                               " of them, or its offset is no multiple of 4"};
        }
    }
    return std::nullopt;
}

/// Whether all that it asks with is the host's.
bool isOfHost(const SuppleQueryDesc& desc) {
    return desc.rays.buffer == VK_NULL_HANDLE && desc.triangles.buffer == VK_NULL_HANDLE &&
           desc.places.buffer == VK_NULL_HANDLE;
}

/// `body(context, pool)`.
template <class Body>
SuppleResult withPool(SuppleContext handle, SuppleQueryPool pool, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<runtime::QueryPool> found = context.queryPools.find(pool.id);
        return found == nullptr
                   ? refuse(context, ErrorCode::staleHandle, function, "stale or foreign query pool handle")
                   : body(context, *found);
    });
}

} // namespace

SuppleResult suppleCreateQueryPool(SuppleContext handle, const SuppleQueryPoolDesc* given, SuppleQueryPool* out) {
    return onDevice(handle, kCreateQueryPool, [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kCreateQueryPool, "out is null");
        }
        out->id = 0;
        SuppleQueryPoolDesc desc{};
        if (const auto fault = takeIn(context, kCreateQueryPool, "desc", given, desc)) {
            return *fault;
        }
        if (const std::optional<Error> fault = faultOf(context, desc)) {
            return refuse(context, fault->code, kCreateQueryPool, fault->message);
        }
        const Result<uint64_t> id = context.createQueryPool(desc);
        if (!id) {
            return report(context, id.error());
        }
        out->id = *id;
        return noted(context, calls::CreateQueryPool{*out, desc});
    });
}

SuppleResult suppleDestroyQueryPool(SuppleContext handle, SuppleQueryPool pool) {
    return withPool(handle, pool, "suppleDestroyQueryPool", [&](Context& context, runtime::QueryPool& /*found*/) {
        context.destroyQueryPool(pool.id);
        return noted(context, calls::DestroyQueryPool{pool});
    });
}

SuppleResult suppleGetQueryOutput(SuppleContext handle, SuppleQueryPool pool, SuppleQueryOutput* out) {
    constexpr const char* kHere = "suppleGetQueryOutput";
    return withPool(handle, pool, kHere, [&](Context& context, runtime::QueryPool& found) {
        return describe(context, kHere, out, [&](SuppleQueryOutput& output) { found.fill(output); });
    });
}

SuppleResult suppleRecordQueries(SuppleContext handle, VkCommandBuffer commandBuffer, SuppleQueryPool pool,
                                 const SuppleQueryDesc* given) {
    return onDevice(handle, kRecordQueries, [&](Context& /*context*/) {
        return withPool(handle, pool, kRecordQueries, [&](Context& context, runtime::QueryPool& found) {
            if (commandBuffer == VK_NULL_HANDLE) {
                return refuse(context, ErrorCode::nullPointer, kRecordQueries, "commandBuffer is null");
            }
            SuppleQueryDesc desc{};
            if (const auto fault = takeIn(context, kRecordQueries, "desc", given, desc)) {
                return *fault;
            }
            if (const std::optional<Error> fault = faultOf(desc, found)) {
                return refuse(context, fault->code, kRecordQueries, fault->message);
            }
            const Status recorded = context.recordQueries(commandBuffer, found, desc);
            return isOfHost(desc) ? notedIf(context, recorded, calls::RecordQueries{pool, desc})
                                  : reportStatus(context, recorded);
        });
    });
}

SuppleResult suppleReadHits(SuppleContext handle, SuppleQueryPool pool, SuppleHit* out, uint32_t* count,
                            uint64_t* frame) {
    constexpr const char* kHere = "suppleReadHits";
    return withPool(handle, pool, kHere, [&](Context& context, runtime::QueryPool& found) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "count is null");
        }
        const std::optional<runtime::QueryPool::Batch> batch = found.newest();
        if (!batch) {
            *count = 0;
            return SUPPLE_NOT_READY;
        }
        if (frame != nullptr) {
            *frame = batch->frame;
        }
        return fillArray(batch->hits.data(), batch->hits.size(), out, count);
    });
}
