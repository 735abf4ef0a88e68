// How a reader or writer of cage/ stops: it throws a Refusal, and its public function turns that into an Error. No
// Refusal leaves a public function.
#pragma once

#include "base/result.h"

#include <string>

namespace supple::cage {

struct Refusal {
    ErrorCode code;
    std::string message; ///< "element: reason"; the public function puts the file's name in front
};

[[noreturn]] inline void refuse(const std::string& element, const std::string& reason,
                                ErrorCode code = ErrorCode::asset) {
    throw Refusal{code, element + ": " + reason};
}

} // namespace supple::cage
