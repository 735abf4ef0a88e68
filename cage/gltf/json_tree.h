// The JSON of a file as a tree of values that are read, not changed. Private to cage/gltf/.
//
// nlohmann's parser reports what it meets, and the tree is this folder's own: destroying nlohmann's values allocates,
// so they end the process where memory is short, and they take several times as much of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace supple::cage::gltf {

struct JsonMember;

/// A value. It refers to its JsonTree, and is copied as a number is.
class Json {
public:
    enum class Kind : uint8_t { null, boolean, unsignedInteger, negativeInteger, real, string, array, object };

    Json() = default; ///< null
    explicit Json(bool value) : kind_(Kind::boolean), boolean_(value) {}
    explicit Json(uint64_t value) : kind_(Kind::unsignedInteger), unsigned_(value) {}
    explicit Json(int64_t value) : kind_(Kind::negativeInteger), negative_(value) {}
    explicit Json(double value) : kind_(Kind::real), real_(value) {}
    explicit Json(std::string_view text)
        : kind_(Kind::string), size_(static_cast<uint32_t>(text.size())), text_(text.data()) {}
    explicit Json(std::span<const Json> items)
        : kind_(Kind::array), size_(static_cast<uint32_t>(items.size())), items_(items.data()) {}
    /// By rising name.
    explicit Json(std::span<const JsonMember> members);

    [[nodiscard]] Kind kind() const { return kind_; }
    [[nodiscard]] bool isNull() const { return kind_ == Kind::null; }
    [[nodiscard]] bool isBoolean() const { return kind_ == Kind::boolean; }
    [[nodiscard]] bool isUnsigned() const { return kind_ == Kind::unsignedInteger; }
    [[nodiscard]] bool isInteger() const { return isUnsigned() || kind_ == Kind::negativeInteger; }
    [[nodiscard]] bool isNumber() const { return isInteger() || kind_ == Kind::real; }
    [[nodiscard]] bool isString() const { return kind_ == Kind::string; }
    [[nodiscard]] bool isArray() const { return kind_ == Kind::array; }
    [[nodiscard]] bool isObject() const { return kind_ == Kind::object; }

    /// What the value holds; zero or empty if it is of another kind. Numbers become each other.
    [[nodiscard]] bool boolean() const { return isBoolean() && boolean_; }
    [[nodiscard]] double number() const;
    [[nodiscard]] float real() const { return static_cast<float>(number()); }
    [[nodiscard]] uint64_t unsignedInteger() const { return isUnsigned() ? unsigned_ : 0; }
    [[nodiscard]] int64_t negativeInteger() const { return kind_ == Kind::negativeInteger ? negative_ : 0; }
    [[nodiscard]] size_t index() const { return static_cast<size_t>(unsignedInteger()); }
    [[nodiscard]] std::string string() const { return std::string(isString() ? text() : std::string_view()); }
    [[nodiscard]] std::string_view text() const { return {text_, size_}; }

    /// The items of an array. Every other value has none.
    [[nodiscard]] std::span<const Json> items() const {
        return isArray() ? std::span(items_, size_) : std::span<const Json>();
    }
    [[nodiscard]] size_t size() const { return items().size(); }
    [[nodiscard]] bool empty() const { return items().empty(); }
    [[nodiscard]] const Json* begin() const { return items().data(); }
    [[nodiscard]] const Json* end() const { return items().data() + items().size(); }
    [[nodiscard]] const Json& operator[](size_t item) const { return items_[item]; }

    /// The members of an object, by rising name, each name once. Every other value has none.
    [[nodiscard]] std::span<const JsonMember> members() const;
    /// Null where absent.
    [[nodiscard]] const Json* find(std::string_view name) const;
    [[nodiscard]] bool contains(std::string_view name) const { return find(name) != nullptr; }
    /// A member that has been checked; a null value where absent.
    [[nodiscard]] const Json& at(std::string_view name) const;

private:
    Kind kind_ = Kind::null;
    uint32_t size_ = 0;
    union {
        bool boolean_;
        uint64_t unsigned_ = 0;
        int64_t negative_;
        double real_;
        const char* text_;
        const Json* items_;
        const JsonMember* members_;
    };
};

struct JsonMember {
    std::string_view name;
    Json value;
};

/// How much a text holds at most.
struct JsonCount {
    size_t items = 0;
    size_t members = 0;
    size_t bytes = 0; ///< of strings

    /// What the tree takes while it is made.
    [[nodiscard]] uint64_t treeBytes() const {
        return items * sizeof(Json) + members * sizeof(JsonMember) + (items + members) * sizeof(JsonMember) + bytes;
    }
};

/// Owns what values refer to. It may be moved, and they stay where they are.
class JsonTree {
public:
    /// Throws Refusal.
    JsonTree(std::string_view text, const JsonCount& count);
    JsonTree() = default;
    JsonTree(JsonTree&&) = default;
    JsonTree& operator=(JsonTree&&) = default;

    [[nodiscard]] const Json& root() const { return root_; }

private:
    class Builder;
    // Never grown beyond what was reserved for them.
    std::vector<Json> items_;
    std::vector<JsonMember> members_;
    std::vector<char> texts_;
    Json root_;
};

/// The value as text, for messages; no more than `most` bytes of it.
[[nodiscard]] std::string shown(const Json& value, size_t most);

} // namespace supple::cage::gltf
