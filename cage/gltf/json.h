// JSON of a glTF file: parsing within bounds and typed access that refuses instead of converting. Private to
// cage/gltf/.
#pragma once

#include "cage/gltf/json_tree.h"
#include "cage/memory_budget.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace supple::cage::gltf {

/// JSON nested deeper than this is refused before it is parsed: parsers and writers recurse.
inline constexpr int kMaxJsonDepth = 64;

// All of these throw Refusal. A member that is null counts as absent; absent members pass the checks unless required.

/// The file's JSON object, its root.
[[nodiscard]] JsonTree parseJson(std::string_view text, MemoryBudget& memory);

/// Null where absent.
[[nodiscard]] const Json* member(const Json& object, const char* key);
/// The member, if it is an object, else null: of what nobody checks. `object` may be null or no object.
[[nodiscard]] const Json* objectIn(const Json* object, const char* key);
const Json* objectMember(const Json& object, const char* key, const std::string& element);
[[nodiscard]] const Json* arrayMember(const Json& object, const char* key, const std::string& element);

/// A top-level array of objects, or an empty array where the file has none.
[[nodiscard]] Json table(const Json& root, const char* key);

[[nodiscard]] uint64_t toUnsigned(const Json& value, const std::string& element);
/// Without a fallback the member is required.
uint64_t unsignedMember(const Json& object, const char* key, const std::string& element,
                        std::optional<uint64_t> fallback);
/// Empty where absent.
[[nodiscard]] std::string stringMember(const Json& object, const char* key, const std::string& element);
/// A number from `least` to `most`, or `otherwise` where absent.
[[nodiscard]] float numberMember(const Json& object, const char* key, float otherwise, float least, float most,
                                 const std::string& element);
[[nodiscard]] bool hasExtension(const Json& object, const char* name);

/// An index into the file's `count` elements called `what`.
void checkIndex(const Json& value, const std::string& element, const char* what, size_t count);
void checkIndexMember(const Json& object, const char* key, const std::string& element, const char* what, size_t count,
                      bool required = false);
void checkIndexArray(const Json& object, const char* key, const std::string& element, const char* what, size_t count);

/// Whether a number is finite as the float it becomes.
[[nodiscard]] bool isFiniteFloat(const Json& number);
/// An array of finite numbers, `length` of them where it is given.
void checkNumbers(const Json& object, const char* key, const std::string& element, std::optional<size_t> length);
void checkString(const Json& object, const char* key, const std::string& element);

} // namespace supple::cage::gltf
