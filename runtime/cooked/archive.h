// Values as bytes: numbers, text, lists, and structs whose members fields() names in an order (character_fields.h,
// table_fields.h). The same fields() writes and reads, so that the two cannot differ.
#pragma once

#include "base/result.h"
#include "cage/shared_bytes.h"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace supple::runtime {

/// T or const T: fields() is one function for whoever writes and whoever reads.
template <class T, class Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

/// Numbers, and structs of numbers without padding: they lie in a list as they do in memory.
template <class T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

template <class T>
concept Plain = kIsPlain<std::remove_const_t<T>>;

/// The last enumerator of an enumeration that begins with 0 and leaves out none.
template <class Enum>
inline constexpr Enum kLast = std::enable_if_t<sizeof(Enum) == 0, Enum>{}; // specialize it

/// Whether a number, before it becomes one, is an enumerator.
template <class Enum>
[[nodiscard]] constexpr bool isEnumerator(uint32_t number) {
    return number <= static_cast<uint32_t>(kLast<Enum>);
}

/// Writes values one behind the other, as long as there is room, and counts their bytes. With no room it counts alone.
class Writer {
public:
    explicit Writer(std::span<std::byte> out) : out_(out) {}
    [[nodiscard]] size_t byteCount() const { return count_; }

    template <class... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    /// A list without its first members; reading gives the others.
    template <class T>
    void rest(const std::vector<T>& list, size_t first) {
        put(uint64_t{list.size() - first});
        for (size_t i = first; i < list.size(); ++i) {
            put(list[i]);
        }
    }
    void put(std::span<const std::byte> bytes) {
        if (!bytes.empty() && count_ <= out_.size() && bytes.size() <= out_.size() - count_) {
            std::memcpy(out_.data() + count_, bytes.data(), bytes.size());
        }
        count_ += bytes.size();
    }

private:
    template <Plain T>
    void put(const T& value) {
        put(std::as_bytes(std::span(&value, 1)));
    }
    void put(bool value) { put(static_cast<uint8_t>(value ? 1 : 0)); }
    template <class T>
    requires std::is_enum_v<T>
    void put(T value) { put(static_cast<uint32_t>(value)); }
    void put(const std::string& text) {
        put(uint64_t{text.size()});
        put(std::as_bytes(std::span(text)));
    }
    void put(const cage::SharedBytes& bytes) {
        put(uint64_t{bytes.size()});
        put(std::span<const std::byte>(bytes));
    }
    template <class T>
    void put(const std::vector<T>& list) {
        put(uint64_t{list.size()});
        if constexpr (Plain<T>) {
            put(std::as_bytes(std::span(list)));
        } else {
            for (const T& one : list) {
                put(one);
            }
        }
    }
    template <class T, size_t Count>
    void put(const std::array<T, Count>& list) {
        for (const T& one : list) {
            put(one);
        }
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value) {
            put(*value);
        }
    }
    template <class T>
    requires(std::is_class_v<T> && !Plain<T>) void put(const T& value) { fields(*this, value); }

    std::span<std::byte> out_;
    size_t count_ = 0;
};

/// Takes values out of bytes that may be anybody's. Once something does not fit, it reads nothing more: values stay as
/// they are, and fault() says what it was. A list takes no memory before its bytes are known to be there.
class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : all_(bytes), left_(bytes) {}

    template <class... T>
    void operator()(T&... values) {
        (take(values), ...);
    }
    template <class T>
    void rest(std::vector<T>& list, size_t /*first*/) {
        take(list);
    }
    /// Null as long as all is well.
    [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }
    [[nodiscard]] size_t bytesLeft() const { return left_.size(); }
    void refuse(const std::string& reason) {
        if (!fault_) {
            fault_ = "byte " + std::to_string(all_.size() - left_.size()) + ": " + reason;
        }
    }

private:
    /// The next bytes, or none.
    std::span<const std::byte> next(uint64_t count) {
        if (fault_ || count > left_.size()) {
            refuse("the file ends too early");
            return {};
        }
        const std::span<const std::byte> taken = left_.first(count);
        left_ = left_.subspan(count);
        return taken;
    }
    template <Plain T>
    void take(T& value) {
        if (const std::span<const std::byte> bytes = next(sizeof(T)); !bytes.empty()) {
            std::memcpy(&value, bytes.data(), sizeof(T));
        }
    }
    void take(bool& value) {
        uint8_t byte = 0;
        take(byte);
        if (byte > 1) {
            refuse("neither 0 nor 1");
        }
        value = byte == 1;
    }
    template <class T>
    requires std::is_enum_v<T>
    void take(T& value) {
        uint32_t number = 0;
        take(number);
        if (!isEnumerator<T>(number)) {
            refuse("no such enumerator: " + std::to_string(number));
            return;
        }
        value = static_cast<T>(number);
    }
    void take(std::string& text) {
        uint64_t count = 0;
        take(count);
        const std::span<const std::byte> bytes = next(count);
        text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size()); // NOLINT
    }
    void take(cage::SharedBytes& shared) {
        uint64_t count = 0;
        take(count);
        const std::span<const std::byte> bytes = next(count);
        shared = std::vector<std::byte>(bytes.begin(), bytes.end());
    }
    template <class T>
    void take(std::vector<T>& list) {
        uint64_t count = 0;
        take(count);
        if constexpr (Plain<T>) {
            const std::span<const std::byte> bytes =
                count <= left_.size() / sizeof(T) ? next(count * sizeof(T)) : next(~0ull);
            list.resize(bytes.size() / sizeof(T));
            if (!list.empty()) {
                std::memcpy(list.data(), bytes.data(), bytes.size());
            }
        } else {
            list.clear();
            // One after the other: none takes less than a byte.
            for (uint64_t i = 0; i < count && !fault_; ++i) {
                take(list.emplace_back());
            }
        }
    }
    template <class T, size_t Count>
    void take(std::array<T, Count>& list) {
        for (T& one : list) {
            take(one);
        }
    }
    template <class T>
    void take(std::optional<T>& value) {
        bool has = false;
        take(has);
        if (has) {
            take(value.emplace());
        }
    }
    template <class T>
    requires(std::is_class_v<T> && !Plain<T>) void take(T& value) { fields(*this, value); }

    std::span<const std::byte> all_, left_;
    std::optional<std::string> fault_;
};

} // namespace supple::runtime
