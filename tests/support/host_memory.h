// A program's operator new: counts bytes, and fails where it is told to. Every allocation of a test program that has
// this passes here, whichever thread makes it.
#pragma once

#include <cstdint>

namespace supple::test {

/// Bytes from operator new since the last reset.
struct HostMemory {
    uint64_t allocations = 0;
    uint64_t bytes = 0; ///< all together, whether given back or not
    uint64_t peak = 0;  ///< most at a time, beyond what was there at the reset
    uint64_t largest = 0;
    int64_t live = 0; ///< taken and not given back
};

/// Begins counting anew.
void resetHostMemory();
[[nodiscard]] HostMemory hostMemory();

/// Whether one allocation fails, or that and all after it until the failure is lifted.
enum class Failure { one, all };
/// The n-th allocation of this thread from now on throws std::bad_alloc; 0 is the next one.
void failHostMemory(uint64_t n, Failure failure);
/// Ends that. Whether the n-th allocation came.
bool liftHostFailure();

/// While one lives, this thread's allocations do not fail and are not numbered: in a driver, in a test's own code.
class HostMemoryPause {
public:
    HostMemoryPause();
    ~HostMemoryPause();
    HostMemoryPause(const HostMemoryPause&) = delete;
    HostMemoryPause& operator=(const HostMemoryPause&) = delete;

private:
    bool before_;
};

} // namespace supple::test
