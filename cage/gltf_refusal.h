// How the glTF reader's rooms stop: by throwing a Refusal, which readGltf() turns into an Error. Private to cage/; no
// Refusal leaves a public function.
#pragma once

#include "base/result.h"

#include <string>

namespace supple::cage {

struct Refusal {
    ErrorCode code;
    std::string message; ///< "element: reason"; readGltf() puts the file's name in front
};

[[noreturn]] inline void refuse(const std::string& element, const std::string& reason,
                                ErrorCode code = ErrorCode::asset) {
    throw Refusal{code, element + ": " + reason};
}

} // namespace supple::cage
