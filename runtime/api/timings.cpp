// supple.h, timings.
#include "runtime/api/entry.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

SuppleResult suppleGetTimings(SuppleContext handle, SuppleTiming* out, uint32_t* count) {
    return guarded(handle, "suppleGetTimings", [&](Context& context) {
        if (count == nullptr) {
            return refuse(context, ErrorCode::nullPointer, "suppleGetTimings", "count is null");
        }
        const std::vector<SuppleTiming>& latest = context.timings.latest();
        if (latest.empty()) {
            *count = 0;
            return SUPPLE_NOT_READY;
        }
        return fillArray(latest.data(), latest.size(), out, count);
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
