// supple.h, timings.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

/// What there is of each entry of the newest frame that was timed.
template <class T>
SuppleResult fillTimings(Context& context, const char* call, const std::vector<T>& latest, T* out, uint32_t* count) {
    if (count == nullptr) {
        return refuse(context, ErrorCode::nullPointer, call, "count is null");
    }
    if (latest.empty()) {
        *count = 0;
        return SUPPLE_NOT_READY;
    }
    return fillArray(latest.data(), latest.size(), out, count);
}

} // namespace

SuppleResult suppleGetTimings(SuppleContext handle, SuppleTiming* out, uint32_t* count) {
    return guarded(handle, "suppleGetTimings", [&](Context& context) {
        return fillTimings(context, "suppleGetTimings", context.timings.latest(), out, count);
    });
}

SuppleResult suppleGetTimingSurfaces(SuppleContext handle, uint32_t* out, uint32_t* count) {
    return guarded(handle, "suppleGetTimingSurfaces", [&](Context& context) {
        return fillTimings(context, "suppleGetTimingSurfaces", context.timings.latestSurfaces(), out, count);
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

SuppleResult suppleSetBudget(SuppleContext handle, const char* pass, double nanoseconds) {
    return guarded(handle, "suppleSetBudget", [&](Context& context) {
        if (!std::isfinite(nanoseconds)) {
            return refuse(context, ErrorCode::notFinite, "suppleSetBudget", "nanoseconds is not finite");
        }
        if (nanoseconds < 0.0) {
            return refuse(context, ErrorCode::range, "suppleSetBudget", "nanoseconds is negative");
        }
        return context.timings.setBudget(pass, nanoseconds)
                   ? SUPPLE_OK
                   : refuse(context, ErrorCode::range, "suppleSetBudget", std::string("no pass ") + pass);
    });
}

SuppleResult suppleGetBudget(SuppleContext handle, const char* pass, SuppleBudget* out) {
    return guarded(handle, "suppleGetBudget", [&](Context& context) {
        if (const auto fault = checkOut(context, "suppleGetBudget", out)) {
            return *fault;
        }
        const SuppleBudget* budget = context.timings.budget(pass);
        if (budget == nullptr) {
            return refuse(context, ErrorCode::range, "suppleGetBudget", std::string("no pass ") + pass);
        }
        runtime::writeSized(*budget, *out);
        return budget->limit > 0.0 ? SUPPLE_OK : SUPPLE_NOT_READY;
    });
}
