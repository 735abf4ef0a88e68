#include "cage/gltf/json.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <cmath>
#include <limits>

namespace supple::cage::gltf {
namespace {

/// Looks through the text once: refuses deep nesting, and counts what the tree will hold, which cannot be more than
/// the marks between values.
JsonCount countValues(std::string_view text) {
    JsonCount count{1, 0, 0};
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
            ++count.bytes; // no escape decodes to more bytes than it is counted here
        } else if (c == '"') {
            inString = true;
        } else if (c == ',') {
            ++count.items;
        } else if (c == ':') {
            ++count.members;
        } else if (c == '{' || c == '[') {
            ++count.items;
            if (++depth > kMaxJsonDepth) {
                refuse("JSON", "nested deeper than " + std::to_string(kMaxJsonDepth) + " at byte " + std::to_string(i),
                       ErrorCode::limit);
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return count;
}

} // namespace

JsonTree parseJson(std::string_view text, MemoryBudget& memory) {
    if (text.size() > std::numeric_limits<uint32_t>::max()) {
        refuse("JSON", "larger than 4 GiB", ErrorCode::limit);
    }
    const JsonCount count = countValues(text);
    memory.take(count.treeBytes(), "JSON");
    JsonTree tree(text, count);
    if (!tree.root().isObject()) {
        refuse("JSON", "not an object");
    }
    return tree;
}

const Json* member(const Json& object, const char* key) {
    const Json* value = object.find(key);
    return value == nullptr || value->isNull() ? nullptr : value;
}

const Json* objectIn(const Json* object, const char* key) {
    const Json* found = object != nullptr && object->isObject() ? member(*object, key) : nullptr;
    return found != nullptr && found->isObject() ? found : nullptr;
}

const Json* objectMember(const Json& object, const char* key, const std::string& element) {
    const Json* value = member(object, key);
    if (value != nullptr && !value->isObject()) {
        refuse(element + " " + key, "not an object");
    }
    return value;
}

const Json* arrayMember(const Json& object, const char* key, const std::string& element) {
    const Json* value = member(object, key);
    if (value != nullptr && !value->isArray()) {
        refuse(element.empty() ? key : element + " " + key, "not an array");
    }
    return value;
}

Json table(const Json& root, const char* key) {
    const Json* value = arrayMember(root, key, "");
    if (value == nullptr) {
        return {};
    }
    for (size_t i = 0; i < value->size(); ++i) {
        if (!(*value)[i].isObject()) {
            refuse(at(key, i), "not an object");
        }
    }
    return *value;
}

uint64_t toUnsigned(const Json& value, const std::string& element) {
    if (!value.isInteger()) {
        refuse(element, "not an integer");
    }
    if (!value.isUnsigned()) {
        refuse(element, std::to_string(value.negativeInteger()) + " is negative");
    }
    return value.unsignedInteger();
}

uint64_t unsignedMember(const Json& object, const char* key, const std::string& element,
                        std::optional<uint64_t> fallback) {
    const Json* value = member(object, key);
    if (value == nullptr) {
        if (!fallback) {
            refuse(element, std::string(key) + " is missing");
        }
        return *fallback;
    }
    return toUnsigned(*value, element + " " + key);
}

void checkIndex(const Json& value, const std::string& element, const char* what, size_t count) {
    const uint64_t index = toUnsigned(value, element);
    if (index >= count) {
        refuse(element, at(what, index) + " is out of range: the file has " + std::to_string(count));
    }
}

void checkIndexMember(const Json& object, const char* key, const std::string& element, const char* what, size_t count,
                      bool required) {
    const Json* value = member(object, key);
    if (value != nullptr) {
        checkIndex(*value, element + " " + key, what, count);
    } else if (required) {
        refuse(element, std::string(key) + " is missing");
    }
}

void checkIndexArray(const Json& object, const char* key, const std::string& element, const char* what, size_t count) {
    const Json* values = arrayMember(object, key, element);
    if (values == nullptr) {
        return;
    }
    for (size_t i = 0; i < values->size(); ++i) {
        checkIndex((*values)[i], item(element + " " + key, i), what, count);
    }
}

bool isFiniteFloat(const Json& number) {
    // Written so that a NaN fails too.
    return std::abs(number.number()) <= std::numeric_limits<float>::max();
}

void checkNumbers(const Json& object, const char* key, const std::string& element, std::optional<size_t> length) {
    const Json* values = arrayMember(object, key, element);
    if (values == nullptr) {
        return;
    }
    const std::string place = element + " " + key;
    if (length && values->size() != *length) {
        refuse(place, std::to_string(values->size()) + " numbers instead of " + std::to_string(*length));
    }
    for (const Json& value : *values) {
        if (!value.isNumber()) {
            refuse(place, "not all numbers");
        }
        if (!isFiniteFloat(value)) {
            refuse(place, "not finite");
        }
    }
}

void checkString(const Json& object, const char* key, const std::string& element) {
    const Json* value = member(object, key);
    if (value != nullptr && !value->isString()) {
        refuse(element + " " + key, "not a string");
    }
}

std::string stringMember(const Json& object, const char* key, const std::string& element) {
    checkString(object, key, element);
    const Json* value = member(object, key);
    return value == nullptr ? std::string() : value->string();
}

float numberMember(const Json& object, const char* key, float otherwise, float least, float most,
                   const std::string& element) {
    const Json* given = member(object, key);
    if (given == nullptr) {
        return otherwise;
    }
    if (!given->isNumber() || !(given->real() >= least) || !(given->real() <= most)) {
        refuse(element + " " + key, "not a number from " + shortNumber(static_cast<double>(least)) + " to " +
                                        shortNumber(static_cast<double>(most)));
    }
    return given->real();
}

bool hasExtension(const Json& object, const char* name) {
    const Json* extensions = member(object, "extensions");
    return extensions != nullptr && extensions->isObject() && extensions->contains(name);
}

} // namespace supple::cage::gltf
