// Counts what a thread allocates with operator new. Every allocation of a test program that has this passes here.
#pragma once

#include <cstdint>

namespace supple::test {

/// While one lives, this thread's allocations are counted.
class AllocationCount {
public:
    AllocationCount();
    ~AllocationCount();
    AllocationCount(const AllocationCount&) = delete;
    AllocationCount& operator=(const AllocationCount&) = delete;
};
/// While one lives, they are not: in what is called from there and is not looked at, the driver say.
class AllocationPause {
public:
    AllocationPause();
    ~AllocationPause();
    AllocationPause(const AllocationPause&) = delete;
    AllocationPause& operator=(const AllocationPause&) = delete;

private:
    bool before_;
};

/// What this thread has counted.
[[nodiscard]] uint64_t allocationsCounted();

} // namespace supple::test
