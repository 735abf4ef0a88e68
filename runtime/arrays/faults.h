// What is wrong with a host's arrays, and arrays of structs that may grow. Private to runtime/arrays/.
#pragma once

#include "cage/limits.h"
#include "cage/message.h"
#include "cage/refusal.h"
#include "runtime/api/struct_size.h"
#include "runtime/sized.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::runtime {

/// The faults of one element of a description, which messages call `element`; nothing if it is empty.
class Faults {
public:
    Faults(cage::Refusals& refusals, std::string element) : refusals_(&refusals), element_(std::move(element)) {}

    void add(const std::string& reason, ErrorCode code = ErrorCode::asset) {
        ++count_;
        refusals_->keep({code, {element_.empty() ? reason : element_ + ": " + reason}});
    }
    void add(const cage::Found& found, const char* one, const char* many) {
        if (found.count > 0) {
            add(found.told(one, many));
        }
    }
    /// A fault if one of the arrays is null although it has entries. Returns whether there is none.
    template <class... Arrays>
    bool present(uint64_t count, const char* what, Arrays... arrays) {
        const bool fine = count == 0 || (... && (arrays != nullptr));
        if (!fine) {
            add(std::string(what) + " is null", ErrorCode::nullPointer);
        }
        return fine;
    }
    /// Runs what may throw a Refusal.
    template <class Read>
    void gather(Read&& read) {
        try {
            read();
        } catch (const cage::Refusal& refusal) {
            for (const std::string& fault : refusal.faults) {
                add(fault, refusal.code);
            }
        }
    }
    [[nodiscard]] bool none() const { return count_ == 0; }
    [[nodiscard]] cage::Refusals& refusals() const { return *refusals_; }
    [[nodiscard]] const std::string& element() const { return element_; }

private:
    cage::Refusals* refusals_;
    std::string element_;
    size_t count_ = 0;
};

/// Takes in an array of structs that begin with structSize, of whatever version. Empty if that is a fault.
template <class T>
std::vector<T> takeArray(const T* first, uint32_t count, const char* what, Faults& faults) {
    std::vector<T> taken;
    if (!faults.present(count, what, first)) {
        return taken;
    }
    const auto* bytes = reinterpret_cast<const std::byte*>(first);
    for (uint32_t i = 0; i < count; ++i) {
        const T& from = *reinterpret_cast<const T*>(bytes + size_t{i} * first->structSize);
        T& to = taken.emplace_back();
        if (from.structSize != first->structSize) {
            faults.add(cage::item(what, i) + ".structSize is not that of " + cage::item(what, 0),
                       ErrorCode::structSize);
            return {};
        }
        if (!readSized(from, to)) {
            faults.add(api::faultOfSize<T>(cage::item(what, i), from.structSize), ErrorCode::structSize);
            return {};
        }
    }
    return taken;
}

/// The same of one struct, or of null, which is as if all were zero.
template <class T>
bool takeStruct(const T* from, T& to, const char* what, Faults& faults) {
    if (from == nullptr || readSized(*from, to)) {
        return true;
    }
    faults.add(api::faultOfSize<T>(what, from->structSize), ErrorCode::structSize);
    return false;
}

inline std::string orEmpty(const char* text) {
    return text != nullptr ? text : "";
}

/// Whether `values`, of `width` each, are numbers as coordinates are; null: there are none.
inline void checkNumbers(const float* values, uint64_t count, size_t width, const char* element, const char* one,
                         const char* many, Faults& faults) {
    cage::Found found;
    for (uint64_t i = 0; values != nullptr && i < count; ++i) {
        if (cage::faultOfCoordinates(values + width * i, width) != nullptr) {
            found.add([&] { return cage::at(element, i); });
        }
    }
    faults.add(found, one, many);
}

} // namespace supple::runtime
