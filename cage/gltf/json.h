// JSON of a glTF file: parsing within bounds and typed access that refuses instead of converting. Private to
// cage/gltf/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace supple::cage::gltf {

using nlohmann::json;

/// JSON nested deeper than this is refused before it is parsed: parsers and writers recurse.
inline constexpr int kMaxJsonDepth = 64;

// All of these throw Refusal. A member that is null counts as absent; absent members pass the checks unless required.

/// The file's JSON object.
[[nodiscard]] json parseJson(std::string_view text);

/// Null where absent.
[[nodiscard]] const json* member(const json& object, const char* key);
const json* objectMember(const json& object, const char* key, const std::string& element);
[[nodiscard]] const json* arrayMember(const json& object, const char* key, const std::string& element);

/// A top-level array of objects, or an empty array where the file has none.
[[nodiscard]] const json& table(const json& root, const char* key);

[[nodiscard]] uint64_t toUnsigned(const json& value, const std::string& element);
/// Without a fallback the member is required.
uint64_t unsignedMember(const json& object, const char* key, const std::string& element,
                        std::optional<uint64_t> fallback);
/// Empty where absent.
[[nodiscard]] std::string stringMember(const json& object, const char* key, const std::string& element);
[[nodiscard]] bool hasExtension(const json& object, const char* name);

/// An index into the file's `count` elements called `what`.
void checkIndex(const json& value, const std::string& element, const char* what, size_t count);
void checkIndexMember(const json& object, const char* key, const std::string& element, const char* what, size_t count,
                      bool required = false);
void checkIndexArray(const json& object, const char* key, const std::string& element, const char* what, size_t count);

/// Whether a number is finite as the float it becomes.
[[nodiscard]] bool isFiniteFloat(const json& number);
/// An array of finite numbers, `length` of them where it is given.
void checkNumbers(const json& object, const char* key, const std::string& element, std::optional<size_t> length);
void checkString(const json& object, const char* key, const std::string& element);

/// An array of the vector's components.
template <class Vec>
[[nodiscard]] json numbers(const Vec& vector) {
    json list = json::array();
    for (int k = 0; k < vector.length(); ++k) {
        list.push_back(static_cast<double>(vector[k]));
    }
    return list;
}

} // namespace supple::cage::gltf
