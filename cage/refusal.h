// How a reader of cage/, or a writer of tools/gltf/, stops: it throws a Refusal, and its public function turns that
// into an Error. No Refusal leaves a public function.
#pragma once

#include "base/result.h"

#include <string>
#include <vector>

namespace supple::cage {

struct Refusal {
    ErrorCode code;
    std::vector<std::string> faults; ///< "element: reason"
};

[[noreturn]] inline void refuse(const std::string& element, const std::string& reason,
                                ErrorCode code = ErrorCode::asset) {
    throw Refusal{code, {element + ": " + reason}};
}

/// The faults of elements that are read one after the other. One that is refused does not keep the next from being
/// read, so that a user learns of all faults at once.
class Refusals {
public:
    /// Calls read(), keeps what it refuses, and tells whether it refused nothing. Throws all that is kept if a limit
    /// was exceeded, or if there are 32 faults.
    template <class Read>
    bool gather(Read&& read) {
        try {
            read();
            return true;
        } catch (const Refusal& refusal) {
            keep(refusal);
            return false;
        }
    }
    void keep(const Refusal& refusal);
    [[nodiscard]] bool none() const { return kept_.faults.empty(); }
    /// Throws what is kept, if there is anything.
    void raise() const;

private:
    Refusal kept_{ErrorCode::asset, {}};
};

/// A line per fault, each beginning with the file's name.
[[nodiscard]] Error asError(const Refusal& refusal, const std::string& name);

} // namespace supple::cage
