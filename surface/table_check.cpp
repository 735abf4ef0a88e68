#include "surface/table_check.h"

#include "surface/schemes.h"

namespace supple::surface {

bool TableCheck::within(uint64_t first, uint64_t count, uint64_t limit, const char* of) {
    if (first <= limit && count <= limit - first) {
        return true;
    }
    if (!fault_) {
        fault_ = std::string(what_) + ": " + std::to_string(first) +
                 (count > 1 ? " and " + std::to_string(count - 1) + " more" : "") + ", of " + std::to_string(limit) +
                 " " + of;
    }
    return false;
}

bool TableCheck::require(bool holds, const char* fault) {
    if (!holds && !fault_) {
        fault_ = std::string(what_) + ": " + fault;
    }
    return holds;
}

Status TableCheck::status() const {
    return fault_ ? Status(Error{ErrorCode::asset, *fault_}) : success();
}

bool canCheckTables(SchemeId scheme) {
    return schemeOf(scheme).check != nullptr;
}

Status checkTables(const Tables& tables, const TableSource& source) {
    TableCheck check(tables, source);
    schemeOf(source.recipe.scheme).check(check);
    return check.status();
}

} // namespace supple::surface
