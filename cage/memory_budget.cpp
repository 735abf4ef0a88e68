#include "cage/memory_budget.h"

#include "cage/refusal.h"

#include <limits>

namespace supple::cage {

void MemoryBudget::take(uint64_t bytes, const std::string& element) {
    check(bytes, element);
    taken_ += bytes;
}

void MemoryBudget::check(uint64_t bytes, const std::string& element) const {
    if (bytes <= limit() - taken_) {
        return;
    }
    const std::string limit = std::to_string(this->limit());
    refuse(element,
           given_ != 0 ? "the file needs more memory than the " + limit + " bytes of memoryLimit"
                       : "the file needs more memory than one of " + std::to_string(fileBytes_) +
                             " bytes may take by default, " + limit + " bytes (memoryLimit says otherwise)",
           ErrorCode::limit);
}

void MemoryBudget::take(uint64_t count, uint64_t bytesEach, const std::string& element) {
    const bool fits = bytesEach == 0 || count <= std::numeric_limits<uint64_t>::max() / bytesEach;
    take(fits ? count * bytesEach : std::numeric_limits<uint64_t>::max(), element);
}

} // namespace supple::cage
