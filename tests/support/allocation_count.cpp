#include "tests/support/allocation_count.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local bool counting = false;
thread_local uint64_t counted = 0;

} // namespace

// Not inlined: GCC would take the malloc in the one for a mismatch of the other.
[[gnu::noinline]] void* operator new(std::size_t size) {
    counted += counting ? 1 : 0;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) {
        return memory;
    }
    throw std::bad_alloc();
}
// std::stable_sort takes this one.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    counted += counting ? 1 : 0;
    return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    counted += counting ? 1 : 0;
    const auto a = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) {
        return memory;
    }
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace supple::test {

AllocationCount::AllocationCount() {
    counting = true;
}
AllocationCount::~AllocationCount() {
    counting = false;
}

AllocationPause::AllocationPause() : before_(counting) {
    counting = false;
}
AllocationPause::~AllocationPause() {
    counting = before_;
}

uint64_t allocationsCounted() {
    return counted;
}

} // namespace supple::test
