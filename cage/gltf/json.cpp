#include "cage/gltf/json.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <cmath>
#include <limits>

namespace supple::cage::gltf {
namespace {

void checkNesting(std::string_view text) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                inString = false;
            }
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth) {
                refuse("JSON", "nested deeper than " + std::to_string(kMaxJsonDepth) + " at byte " + std::to_string(i),
                       ErrorCode::limit);
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

} // namespace

json parseJson(std::string_view text) {
    checkNesting(text);
    try {
        json root = json::parse(text.begin(), text.end());
        if (!root.is_object()) {
            refuse("JSON", "not an object");
        }
        return root;
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." -> from "parse error" on
        const std::string what = error.what();
        const size_t end = what.find("] ");
        std::string reason = end == std::string::npos ? what : what.substr(end + 2);
        if (reason.size() > 200) {
            reason = reason.substr(0, 200) + "...";
        }
        refuse("JSON", reason);
    }
}

const json* member(const json& object, const char* key) {
    const auto it = object.find(key);
    return it == object.end() || it->is_null() ? nullptr : &*it;
}

const json* objectMember(const json& object, const char* key, const std::string& element) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_object()) {
        refuse(element + " " + key, "not an object");
    }
    return value;
}

const json* arrayMember(const json& object, const char* key, const std::string& element) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_array()) {
        refuse(element.empty() ? key : element + " " + key, "not an array");
    }
    return value;
}

const json& table(const json& root, const char* key) {
    static const json none = json::array();
    const json* value = arrayMember(root, key, "");
    if (value == nullptr) {
        return none;
    }
    for (size_t i = 0; i < value->size(); ++i) {
        if (!(*value)[i].is_object()) {
            refuse(at(key, i), "not an object");
        }
    }
    return *value;
}

uint64_t toUnsigned(const json& value, const std::string& element) {
    if (!value.is_number_integer()) {
        refuse(element, "not an integer");
    }
    if (!value.is_number_unsigned()) {
        refuse(element, std::to_string(value.get<int64_t>()) + " is negative");
    }
    return value.get<uint64_t>();
}

uint64_t unsignedMember(const json& object, const char* key, const std::string& element,
                        std::optional<uint64_t> fallback) {
    const json* value = member(object, key);
    if (value == nullptr) {
        if (!fallback) {
            refuse(element, std::string(key) + " is missing");
        }
        return *fallback;
    }
    return toUnsigned(*value, element + " " + key);
}

void checkIndex(const json& value, const std::string& element, const char* what, size_t count) {
    const uint64_t index = toUnsigned(value, element);
    if (index >= count) {
        refuse(element, at(what, index) + " is out of range: the file has " + std::to_string(count));
    }
}

void checkIndexMember(const json& object, const char* key, const std::string& element, const char* what, size_t count,
                      bool required) {
    const json* value = member(object, key);
    if (value != nullptr) {
        checkIndex(*value, element + " " + key, what, count);
    } else if (required) {
        refuse(element, std::string(key) + " is missing");
    }
}

void checkIndexArray(const json& object, const char* key, const std::string& element, const char* what, size_t count) {
    const json* values = arrayMember(object, key, element);
    if (values == nullptr) {
        return;
    }
    for (size_t i = 0; i < values->size(); ++i) {
        checkIndex((*values)[i], item(element + " " + key, i), what, count);
    }
}

bool isFiniteFloat(const json& number) {
    // Written so that a NaN fails too.
    return std::abs(number.get<double>()) <= std::numeric_limits<float>::max();
}

void checkNumbers(const json& object, const char* key, const std::string& element, std::optional<size_t> length) {
    const json* values = arrayMember(object, key, element);
    if (values == nullptr) {
        return;
    }
    const std::string place = element + " " + key;
    if (length && values->size() != *length) {
        refuse(place, std::to_string(values->size()) + " numbers instead of " + std::to_string(*length));
    }
    for (const json& value : *values) {
        if (!value.is_number()) {
            refuse(place, "not all numbers");
        }
        if (!isFiniteFloat(value)) {
            refuse(place, "not finite");
        }
    }
}

void checkString(const json& object, const char* key, const std::string& element) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_string()) {
        refuse(element + " " + key, "not a string");
    }
}

std::string stringMember(const json& object, const char* key, const std::string& element) {
    checkString(object, key, element);
    const json* value = member(object, key);
    return value == nullptr ? std::string() : value->get<std::string>();
}

bool hasExtension(const json& object, const char* name) {
    const json* extensions = member(object, "extensions");
    return extensions != nullptr && extensions->is_object() && extensions->contains(name);
}

} // namespace supple::cage::gltf
