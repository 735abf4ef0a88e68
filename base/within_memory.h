// Running out of host memory as a value: it is the one thing that the standard library throws at us.
#pragma once

#include "base/result.h"

#include <new>

namespace supple {

/// What `build` returns, or a refusal that says what there was no memory for.
template <class Build>
[[nodiscard]] auto withinMemory(const char* what, Build&& build) -> decltype(build()) {
    try {
        return build();
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::hostMemory, std::string("out of memory for ") + what};
    }
}

} // namespace supple
