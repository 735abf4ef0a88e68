// What every function of the C interface does alike: finds the context and the object, checks structs, turns errors
// into results and log lines, and lets nothing thrown escape.
#pragma once

#include "runtime/api/struct_size.h"
#include "runtime/context.h"
#include "runtime/sized.h"
#include "supple/supple.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <string>

struct SuppleContext_T {
    std::unique_ptr<supple::runtime::Context> context;
};

namespace supple::api {

using runtime::Asset;
using runtime::Context;
using runtime::Group;
using runtime::Tessellation;
using runtime::View;
namespace calls = runtime::calls;

/// Logs the error; a lost device is remembered.
SuppleResult report(Context& context, const Error& error);
SuppleResult refuse(Context& context, ErrorCode code, const char* function, const std::string& reason);
/// The same of a group: the reason begins with the name of its asset.
SuppleResult refuse(Context& context, const Group& group, ErrorCode code, const char* function,
                    const std::string& reason);
SuppleResult reportStatus(Context& context, const Status& status);
/// Notes a call that has succeeded, for a recording (runtime/recording/calls.h).
template <class C>
SuppleResult noted(Context& context, const C& call) {
    context.note(call);
    return SUPPLE_OK;
}
/// The same, or reports the error.
template <class C>
SuppleResult notedIf(Context& context, const Status& status, const C& call) {
    return status ? noted(context, call) : report(context, status.error());
}
/// What an error becomes.
struct Verdict {
    SuppleResult result;
    SuppleMessage message;
};
[[nodiscard]] Verdict verdictOf(ErrorCode code);

/// Runs an entry point's body. Out of memory is the one thing the standard library throws at us.
template <class F>
SuppleResult guarded(SuppleContext handle, const char* function, F&& body) noexcept {
    if (handle == nullptr || handle->context == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        return body(*handle->context);
    } catch (const std::bad_alloc&) {
        return SUPPLE_ERROR_HOST_MEMORY; // a log line would need memory
    } catch (const std::exception& e) {
        try {
            return refuse(*handle->context, ErrorCode::vulkan, function, e.what());
        } catch (...) {
            return SUPPLE_ERROR_VULKAN;
        }
    }
}

/// For what needs the device.
template <class Body>
SuppleResult onDevice(SuppleContext handle, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        return context.lost() ? refuse(context, ErrorCode::deviceLost, function, "the device is lost") : body(context);
    });
}

template <class Body>
SuppleResult withAsset(SuppleContext handle, SuppleAsset asset, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<Asset> found = context.assets.find(asset.id);
        if (found == nullptr) {
            return refuse(context, ErrorCode::staleHandle, function, "stale or foreign asset handle");
        }
        return body(context, *found);
    });
}

template <class Body>
SuppleResult withGroup(SuppleContext handle, SuppleGroup group, const char* function, Body&& body) noexcept {
    return guarded(handle, function, [&](Context& context) {
        const std::shared_ptr<Group> found = context.groups.find(group.id);
        if (found == nullptr) {
            return refuse(context, ErrorCode::staleHandle, function, "stale or foreign group handle");
        }
        return body(context, *found);
    });
}

/// `body(context, group, surface)`, with a surface that the group has.
template <class Body>
SuppleResult withSurface(SuppleContext handle, SuppleGroup group, uint32_t surface, const char* function,
                         Body&& body) noexcept {
    return withGroup(handle, group, function, [&](Context& context, Group& found) {
        if (surface >= found.surfaces().size()) {
            return refuse(context, found, ErrorCode::range, function,
                          "surface " + std::to_string(surface) + " of " + std::to_string(found.surfaces().size()));
        }
        return body(context, found, found.surfaces()[surface]);
    });
}

template <class Body>
SuppleResult withInstance(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withGroup(handle, instance.group, function, [&](Context& context, Group& found) {
        if (found.follows() || !found.slots().holds(instance.slot, instance.generation)) {
            return refuse(context, found, ErrorCode::staleHandle, function,
                          "stale or foreign instance handle (slot " + std::to_string(instance.slot) + ")");
        }
        return body(context, found);
    });
}

template <class Body>
SuppleResult withView(SuppleContext handle, SuppleView view, const char* function, Body&& body) noexcept {
    return onDevice(handle, function, [&](Context& context) {
        const std::shared_ptr<View> found = context.views.find(view.id);
        return found == nullptr ? refuse(context, ErrorCode::staleHandle, function, "stale or foreign view handle")
                                : body(context, *found);
    });
}

/// Takes a description in, of whatever version; null when it is fit to go on with.
template <class T>
std::optional<Error> takeIn(const char* name, const T* from, T& to) {
    if (from == nullptr) {
        return Error{ErrorCode::nullPointer, std::string(name) + " is null"};
    }
    if (!runtime::readSized(*from, to)) {
        return Error{ErrorCode::structSize, faultOfSize<T>(name, from->structSize)};
    }
    return std::nullopt;
}
/// The same, told to the context.
template <class T>
std::optional<SuppleResult> takeIn(Context& context, const char* function, const char* name, const T* from, T& to) {
    const std::optional<Error> fault = takeIn(name, from, to);
    return fault ? std::optional(refuse(context, fault->code, function, fault->message)) : std::nullopt;
}

/// Whether an out struct can be written.
template <class T>
std::optional<SuppleResult> checkOut(Context& context, const char* function, const T* out) {
    if (out == nullptr) {
        return refuse(context, ErrorCode::nullPointer, function, "out is null");
    }
    if (!runtime::isPossibleSize<T>(out->structSize)) {
        return refuse(context, ErrorCode::structSize, function, faultOfSize<T>("out", out->structSize));
    }
    return std::nullopt;
}

/// What a getter does: the check of out, then fill(T&).
template <class T, class Fill>
SuppleResult describe(Context& context, const char* function, T* out, Fill&& fill) {
    if (const auto fault = checkOut(context, function, out)) {
        return *fault;
    }
    T info{};
    fill(info);
    runtime::writeSized(info, *out);
    return SUPPLE_OK;
}

/// The same for one of `count` parts of an asset.
template <class T, class Fill>
SuppleResult describePart(Context& context, const char* function, const char* part, uint32_t index, size_t count,
                          T* out, Fill&& fill) {
    if (const auto fault = checkOut(context, function, out)) {
        return *fault;
    }
    if (index >= count) {
        return refuse(context, ErrorCode::range, function,
                      std::string(part) + " " + std::to_string(index) + " of " + std::to_string(count));
    }
    return describe(context, function, out, fill);
}

template <class E>
bool within(const E& value, E last) {
    return runtime::rawValue(value) <= static_cast<uint32_t>(last);
}

template <class Number>
bool finite(const Number* values, size_t count) {
    return std::all_of(values, values + count, [](Number x) { return std::isfinite(x); });
}

/// Copies as much of `source` as fits and reports the whole count.
template <class T>
SuppleResult fillArray(const T* source, size_t size, T* out, uint32_t* count) {
    const auto total = static_cast<uint32_t>(size);
    const uint32_t n = out == nullptr ? 0 : std::min(*count, total);
    std::copy_n(source, n, out);
    *count = total;
    return out != nullptr && n < total ? SUPPLE_INCOMPLETE : SUPPLE_OK;
}

} // namespace supple::api
