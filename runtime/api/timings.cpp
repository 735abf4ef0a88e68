// supple.h, timings.
#include "runtime/api/entry.h"

#include <cstring>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

SuppleResult refusePass(Context& context, const char* function, SupplePass pass) {
    return refuse(context, ErrorCode::range, function,
                  "pass " + std::to_string(runtime::rawValue(pass)) + " has no budget: it must be one of SupplePass");
}

} // namespace

const char* suppleGetPassName(SupplePass pass) {
    return runtime::passName(pass);
}

SuppleResult suppleGetTimings(SuppleContext handle, uint32_t timingSize, SuppleTiming* out, uint32_t* count) {
    constexpr const char* kHere = "suppleGetTimings";
    return guarded(handle, kHere, [&](Context& context) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, kHere, "count is null");
        }
        if (!runtime::isPossibleSize<SuppleTiming>(timingSize) || timingSize % alignof(SuppleTiming) != 0) {
            return refuse(context, ErrorCode::structSize, kHere,
                          "timingSize is " + std::to_string(timingSize) + ": set it to sizeof(SuppleTiming)");
        }
        const std::vector<SuppleTiming>& latest = context.timings.latest();
        const auto total = static_cast<uint32_t>(latest.size());
        const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
        for (uint32_t i = 0; i < n; ++i) {
            auto* const to = reinterpret_cast<std::byte*>(out) + size_t{i} * timingSize;
            std::memset(to, 0, timingSize);
            std::memcpy(to, &latest[i], std::min<size_t>(timingSize, sizeof(SuppleTiming)));
        }
        *count = total;
        if (total == 0) {
            return SUPPLE_NOT_READY;
        }
        return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
    });
}

SuppleResult suppleGetTimingOrigin(SuppleContext handle, uint64_t* ticks) {
    return guarded(handle, "suppleGetTimingOrigin", [&](Context& context) {
        if (ticks == nullptr) {
            return refuse(context, ErrorCode::nullPointer, "suppleGetTimingOrigin", "ticks is null");
        }
        *ticks = context.timings.origin().value_or(0);
        return context.timings.origin() ? SUPPLE_OK : SUPPLE_NOT_READY;
    });
}

SuppleResult suppleSetBudget(SuppleContext handle, SupplePass pass, double nanoseconds) {
    return guarded(handle, "suppleSetBudget", [&](Context& context) {
        if (!std::isfinite(nanoseconds)) {
            return refuse(context, ErrorCode::notFinite, "suppleSetBudget", "nanoseconds is not finite");
        }
        if (nanoseconds < 0.0) {
            return refuse(context, ErrorCode::range, "suppleSetBudget", "nanoseconds is negative");
        }
        return context.timings.setBudget(pass, nanoseconds) ? SUPPLE_OK : refusePass(context, "suppleSetBudget", pass);
    });
}

SuppleResult suppleGetBudget(SuppleContext handle, SupplePass pass, SuppleBudget* out) {
    return guarded(handle, "suppleGetBudget", [&](Context& context) {
        if (const auto fault = checkOut(context, "suppleGetBudget", out)) {
            return *fault;
        }
        const SuppleBudget* budget = context.timings.budget(pass);
        if (budget == nullptr) {
            return refusePass(context, "suppleGetBudget", pass);
        }
        runtime::writeSized(*budget, *out);
        return budget->limit > 0.0 ? SUPPLE_OK : SUPPLE_NOT_READY;
    });
}
