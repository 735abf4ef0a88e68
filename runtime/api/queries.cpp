// supple_queries.h.
#include "runtime/api/entry.h"
#include "supple/supple_queries.h"

#include <utility>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

constexpr const char* kCreateQueryPool = "suppleCreateQueryPool";
constexpr const char* kRecordQueries = "suppleRecordQueries";

/// What is wrong with a description, but for what its groups are.
std::optional<Error> faultOf(const Context& context, const SuppleQueryPoolDesc& desc) {
    if (desc.flags != 0) {
        return Error{ErrorCode::range, "flags must be 0"};
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

/// The same of a batch. `most`: rays that the pool is for.
std::optional<Error> faultOf(const SuppleQueryDesc& desc, uint32_t most) {
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
    const bool ofDevice = desc.rays.buffer != VK_NULL_HANDLE;
    if (desc.rayCount > 0 && (desc.hostRays != nullptr) == ofDevice) {
        return Error{ErrorCode::nullPointer, "rays must come from hostRays or from a buffer, not both"};
    }
    if (desc.hostTriangles != nullptr && desc.triangles.buffer != VK_NULL_HANDLE) {
        return Error{ErrorCode::nullPointer, "triangles must come from hostTriangles or from a buffer, not both"};
    }
    for (const auto& [name, range] : {std::pair("rays", desc.rays), std::pair("triangles", desc.triangles)}) {
        const bool fits = range.offset % 4 == 0 && range.size / sizeof(SuppleRay) >= desc.rayCount;
        if (range.buffer != VK_NULL_HANDLE && !fits) {
            return Error{ErrorCode::range, std::string(name) + ": the range is too small for " +
                                               std::to_string(desc.rayCount) +
                                               " rays, or its offset is no multiple of 4"};
        }
    }
    return std::nullopt;
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
        return SUPPLE_OK;
    });
}

SuppleResult suppleDestroyQueryPool(SuppleContext handle, SuppleQueryPool pool) {
    return withPool(handle, pool, "suppleDestroyQueryPool", [&](Context& context, runtime::QueryPool& /*found*/) {
        context.destroyQueryPool(pool.id);
        return SUPPLE_OK;
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
            if (const std::optional<Error> fault = faultOf(desc, found.rayCount())) {
                return refuse(context, fault->code, kRecordQueries, fault->message);
            }
            return reportStatus(context, context.recordQueries(commandBuffer, found, desc));
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
