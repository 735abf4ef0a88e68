#include "surface/table_check.h"

namespace supple::surface {

bool TableCheck::refuse(uint64_t first, uint64_t count, uint64_t limit, const char* of) {
    if (!fault_) {
        fault_ = std::string(what_) + ": " + std::to_string(first) +
                 (count > 1 ? " and " + std::to_string(count - 1) + " more" : "") + ", of " + std::to_string(limit) +
                 " " + of;
    }
    return false;
}

bool TableCheck::refuse(const char* fault) {
    if (!fault_) {
        fault_ = std::string(what_) + ": " + fault;
    }
    return false;
}

Status TableCheck::status() const {
    return fault_ ? Status(Error{ErrorCode::asset, *fault_}) : success();
}

bool areOfOneMesh(const Tables& tables, const Tables& others) {
    const auto isSame = [](const PatchRange& own, const PatchRange& other) {
        return own.patchClass == other.patchClass && own.section.count == other.section.count;
    };
    return tables.isolationSteps == others.isolationSteps && tables.poolStride == others.poolStride &&
           tables.attributeOutputs() == others.attributeOutputs() && tables.colors == others.colors &&
           std::equal(tables.ranges.begin(), tables.ranges.end(), others.ranges.begin(), others.ranges.end(), isSame);
}

} // namespace supple::surface
