#include "cage/refusal.h"

#include "cage/message.h"

#include <algorithm>
#include <cstddef>

namespace supple::cage {
namespace {

constexpr size_t kMostFaults = 32;

} // namespace

void Refusals::keep(const Refusal& refusal) {
    if (kept_.faults.empty()) {
        kept_.code = refusal.code;
    }
    for (const std::string& fault : refusal.faults) {
        // Nodes may share a mesh.
        if (std::find(kept_.faults.begin(), kept_.faults.end(), fault) == kept_.faults.end()) {
            kept_.faults.push_back(fault);
        }
    }
    if (kept_.faults.size() >= kMostFaults) {
        kept_.faults.resize(kMostFaults);
        kept_.faults.push_back("file: so many faults that the rest was not read");
    }
    if (refusal.code == ErrorCode::limit || kept_.faults.size() >= kMostFaults) {
        raise();
    }
}

void Refusals::raise() const {
    if (!kept_.faults.empty()) {
        throw kept_;
    }
}

Error asError(const Refusal& refusal, const std::string& name) {
    std::string message;
    for (const std::string& fault : refusal.faults) {
        message += (message.empty() ? "" : "\n") + oneLine(name + ": " + fault);
    }
    return {refusal.code, message};
}

} // namespace supple::cage
