// Running out of host memory as a value: it is the one thing that the standard library throws at us.
#pragma once

#include "base/result.h"

#include <new>
#include <stdexcept>

namespace supple {

/// What `build` returns, or a refusal that says what there was no memory for.
template <class Build>
[[nodiscard]] auto withinMemory(const char* what, Build&& build) -> decltype(build()) {
    const auto refusal = [&] { return Error{ErrorCode::hostMemory, std::string("out of memory for ") + what}; };
    try {
        return build();
    } catch (const std::bad_alloc&) {
        return refusal();
    } catch (const std::length_error&) { // more than a vector may hold, which counts of files come to with 32 bits
        return refusal();
    }
}

} // namespace supple
