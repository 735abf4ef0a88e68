#include "tests/support/host_memory.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

std::atomic<uint64_t> allocations{0};
std::atomic<uint64_t> bytes{0};
std::atomic<uint64_t> largest{0};
std::atomic<int64_t> live{0};
std::atomic<int64_t> peak{0};

// One thread is counted. Drivers have threads of their own, whose allocations would shift the count from run to run.
thread_local bool armed = false;
thread_local bool paused = false;
thread_local bool came = false;
thread_local uint64_t left = 0;
thread_local supple::test::Failure kind = supple::test::Failure::one;

bool fails() {
    if (!armed || paused) {
        return false;
    }
    if (left > 0) {
        --left;
        return false;
    }
    came = true;
    armed = kind == supple::test::Failure::all;
    return true;
}

template <class T>
void raiseTo(std::atomic<T>& most, T value) {
    for (T known = most; known < value && !most.compare_exchange_weak(known, value);) {
    }
}

void* taken(void* memory) {
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    const size_t size = malloc_usable_size(memory);
    ++allocations;
    bytes += size;
    raiseTo(largest, uint64_t{size});
    raiseTo(peak, live += static_cast<int64_t>(size));
    return memory;
}

void given(void* memory) noexcept {
    if (memory != nullptr) {
        live -= static_cast<int64_t>(malloc_usable_size(memory));
    }
    std::free(memory);
}

} // namespace

// Not inlined: GCC would take the malloc in the one for a mismatch of the other.
[[gnu::noinline]] void* operator new(std::size_t size) {
    return taken(fails() ? nullptr : std::malloc(size == 0 ? 1 : size));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto a = static_cast<std::size_t>(alignment);
    return taken(fails() ? nullptr : std::aligned_alloc(a, (size + a - 1) / a * a));
}
/// Does not fail: who asks so does without, and nobody learns of it.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    const supple::test::HostMemoryPause pause;
    return ::operator new(size);
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept {
    given(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    given(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    given(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    given(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    given(memory);
}

namespace supple::test {

void resetHostMemory() {
    allocations = 0;
    bytes = 0;
    largest = 0;
    live = 0;
    peak = 0;
}

HostMemory hostMemory() {
    return {allocations, bytes, static_cast<uint64_t>(std::max<int64_t>(peak, 0)), largest, live};
}

void failHostMemory(uint64_t n, Failure failure) {
    left = n;
    kind = failure;
    came = false;
    armed = true;
}

bool liftHostFailure() {
    armed = false;
    return came;
}

HostMemoryPause::HostMemoryPause() : before_(paused) {
    paused = true;
}
HostMemoryPause::~HostMemoryPause() {
    paused = before_;
}

} // namespace supple::test
