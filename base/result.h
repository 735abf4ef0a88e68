// Errors as values. Nothing in Supple throws across a floor; a function that can fail returns Result<T> or Status.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace supple {

enum class ErrorCode {
    argument, ///< the caller broke a documented rule; the next six say which kind
    nullPointer,
    structSize, ///< of another version, which does not fit
    staleHandle,
    range, ///< an index, a count or an enumerator
    notFinite,
    order,        ///< a call before the one it needs, or once too often
    asset,        ///< a file or cage is malformed, or a scheme cannot take it
    unsupported,  ///< the device lacks something Supple needs
    disabled,     ///< the device has it, but was created without it
    limit,        ///< a documented or device limit is exceeded
    hostMemory,   ///< out of host memory
    deviceMemory, ///< out of device memory
    deviceLost,   ///< VK_ERROR_DEVICE_LOST
    vulkan,       ///< any other Vulkan failure
    io,           ///< a file cannot be read or written
};

/// What went wrong, in one line that names file, element and reason.
struct Error {
    ErrorCode code = ErrorCode::argument;
    std::string message;
};

/// Either a value or an Error. Check ok() before value().
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    const T& value() const {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    T& operator*() { return value(); }
    const T& operator*() const { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const {
        assert(!ok());
        return *std::get_if<1>(&state_);
    }

private:
    std::variant<T, Error> state_;
};

using Status = Result<std::monostate>;
inline Status success() {
    return std::monostate{};
}

} // namespace supple
