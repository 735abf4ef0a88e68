#include "cage/refusal.h"

#include "cage/message.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace supple::cage {
namespace {

constexpr size_t kMostFaults = 32;

} // namespace

void Refusals::keep(const Refusal& refusal) {
    // Readers that gather for readers must learn of an exceeded limit, whatever came before it.
    if (kept_.faults.empty() || refusal.code == ErrorCode::limit) {
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
        kept_.faults.push_back("file: the rest was not read after " + std::to_string(kMostFaults) + " faults");
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
        message.append(message.empty() ? "" : "\n").append(oneLine(cutOff(name + ": " + fault)));
    }
    return {refusal.code, message};
}

} // namespace supple::cage
