// Where lists and texts of calls live while the calls are made. std::pmr would do, but libc++ has it from version 16
// on.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace supple::runtime {

class CallMemory {
public:
    /// For any type that `new` aligns without being told; nothing of it is written.
    [[nodiscard]] void* allocate(size_t bytes) {
        auto* const block = new std::byte[bytes]; // NOLINT(*-owning-memory): make_unique would write zeros
        return blocks_.emplace_back(block).get();
    }
    void release() { blocks_.clear(); }

private:
    std::vector<std::unique_ptr<std::byte[]>> blocks_;
};

} // namespace supple::runtime
