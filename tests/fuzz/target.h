// What a fuzz target is: it takes any bytes and comes back. libFuzzer calls it (tools/fuzz.sh), and for the tests
// replay.cpp does, which needs no other compiler.
#pragma once

#include "tests/fuzz/mutation.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed);
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace supple::fuzz {

[[nodiscard]] inline std::span<const std::byte> bytesOf(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const std::byte*>(data), size};
}

/// A finding: says why, and ends the process as a crash does.
inline void demand(bool condition, const char* what) {
    if (!condition) {
        std::fprintf(stderr, "finding: %s\n", what);
        std::abort();
    }
}

/// Half of the inputs come from `mutate`, half from libFuzzer's own mutator of bytes.
template <class Mutate>
size_t mutateWith(Mutate&& mutate, uint8_t* data, size_t size, size_t most, unsigned seed) {
    Random random(seed + 1);
    const std::vector<uint8_t> changed = random() % 2 == 0 ? std::vector<uint8_t>() : mutate(data, size, random);
    if (changed.empty() || changed.size() > most) {
        return LLVMFuzzerMutate(data, size, most);
    }
    std::copy(changed.begin(), changed.end(), data);
    return changed.size();
}

} // namespace supple::fuzz
