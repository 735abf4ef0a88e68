// Arguments of calls as bytes. The same fields() writes and reads them (runtime/recording/calls.h), so that the two
// cannot differ.
#pragma once

#include "base/result.h"
#include "runtime/recording/call_memory.h"
#include "supple/supple.h"
#include "supple/supple_queries.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace supple::runtime {

/// What is written as it lies in memory.
template <class T>
concept RawNumber = std::is_arithmetic_v<std::remove_const_t<T>> || std::is_enum_v<std::remove_const_t<T>>;
template <class T>
concept CallHandle = std::same_as<T, SuppleAsset> || std::same_as<T, SuppleGroup> || std::same_as<T, SuppleView> ||
    std::same_as<T, SupplePointSet> || std::same_as<T, SuppleQueryPool>;

/// In the place of a list's length: its pointer is null.
inline constexpr uint32_t kNullList = 0xFFFFFFFFu;

/// Appends the arguments of a call.
class CallWriter {
public:
    explicit CallWriter(std::vector<std::byte>& out) : out_(&out) {}

    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    /// For a struct whose first member is structSize: readers fill that in.
    template <class T>
    void sized(const T&) {}
    /// What readers check of the arguments.
    void require(bool) {}
    /// The last arguments of a call, which older files lack.
    template <class T>
    void later(const T& value) {
        put(value);
    }
    /// `count` elements, which may be null.
    template <class T>
    void list(const T* elements, uint32_t count) {
        put(elements != nullptr ? count : kNullList);
        for (uint32_t i = 0; elements != nullptr && i < count && !RawNumber<T>; ++i) {
            put(elements[i]);
        }
        if constexpr (RawNumber<T>) {
            bytes(elements, elements != nullptr ? count * sizeof(T) : 0);
        }
    }
    void text(const char* text) { list(text, text != nullptr ? static_cast<uint32_t>(std::strlen(text)) : 0); }
    template <class T>
    void optional(const T* value) {
        list(value, 1);
    }

private:
    void bytes(const void* from, size_t count) {
        const auto* first = static_cast<const std::byte*>(from);
        out_->insert(out_->end(), first, first + count);
    }
    template <RawNumber T>
    void put(const T& value) {
        bytes(&value, sizeof(T));
    }
    template <RawNumber T, size_t Count>
    void put(const T (&values)[Count]) {
        bytes(values, sizeof(values));
    }
    template <CallHandle T>
    void put(const T& handle) {
        put(handle.id);
    }
    template <class T>
    requires(std::is_class_v<T> && !CallHandle<T>) void put(const T& value) {
        if constexpr (requires { T::fields(*this, value); }) {
            T::fields(*this, value);
        } else {
            fields(*this, value);
        }
    }

    std::vector<std::byte>* out_;
};

/// Takes the arguments of a call out of bytes that may be anybody's. Once something does not fit, it reads nothing
/// more, and says so. Lists and texts live in `memory`: little more than the bytes that are read.
class CallReader {
public:
    CallReader(std::span<const std::byte> bytes, CallMemory& memory) : left_(bytes), memory_(&memory) {}

    template <class... T>
    void operator()(T&... values) {
        (take(values), ...);
    }
    template <class T>
    void sized(T& value) {
        value.structSize = sizeof(T);
    }
    void require(bool holds) { ok_ = ok_ && holds; }
    /// Stays as it is if the file is older.
    template <class T>
    void later(T& value) {
        if (ok_ && !left_.empty()) {
            take(value);
        }
    }
    template <class T>
    void list(const T*& elements, uint32_t& count) {
        take(count);
        elements = nullptr;
        if (count == kNullList || !ok_) {
            count = 0;
            return;
        }
        const size_t least = leastBytes<T>();
        if (count > left_.size() / least) {
            fail(count);
            return;
        }
        static_assert(alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
        // Never null, as it was not: some structs tell an empty list from none.
        auto* own = static_cast<T*>(memory_->allocate((count + size_t{1}) * sizeof(T)));
        std::uninitialized_value_construct_n(own, count + size_t{1});
        elements = own;
        if constexpr (RawNumber<T>) {
            bytes(own, count * sizeof(T));
        } else {
            for (uint32_t i = 0; i < count && ok_; ++i) {
                take(own[i]);
            }
        }
        count = ok_ ? count : 0;
    }
    void text(const char*& text) {
        uint32_t length = 0;
        list(text, length); // a zero follows
    }
    template <class T>
    void optional(const T*& value) {
        uint32_t count = 0;
        list(value, count);
        ok_ = ok_ && count <= 1;
        value = count == 1 ? value : nullptr;
    }
    /// All arguments were there, and nothing behind them.
    [[nodiscard]] bool complete() const { return ok_ && left_.empty(); }

private:
    /// What an element takes in a file, at least: its lists may be empty.
    template <class T>
    static size_t leastBytes() {
        if constexpr (RawNumber<T>) {
            return sizeof(T);
        } else {
            std::vector<std::byte> bytes;
            CallWriter writer(bytes);
            writer(T{});
            return bytes.size();
        }
    }
    void fail(uint32_t& count) {
        ok_ = false;
        count = 0;
    }
    void bytes(void* to, size_t count) {
        if (!ok_ || count > left_.size()) {
            ok_ = false;
            return;
        }
        if (count > 0) {
            std::memcpy(to, left_.data(), count);
        }
        left_ = left_.subspan(count);
    }
    template <RawNumber T>
    void take(T& value) {
        bytes(&value, sizeof(T));
    }
    template <RawNumber T, size_t Count>
    void take(T (&values)[Count]) {
        bytes(values, sizeof(values));
    }
    template <CallHandle T>
    void take(T& handle) {
        take(handle.id);
    }
    template <class T>
    requires(std::is_class_v<T> && !CallHandle<T>) void take(T& value) {
        if constexpr (requires { T::fields(*this, value); }) {
            T::fields(*this, value);
        } else {
            fields(*this, value);
        }
    }

    std::span<const std::byte> left_;
    CallMemory* memory_;
    bool ok_ = true;
};

} // namespace supple::runtime
