// A hash of 32-bit words: two sums over them, each of a mix of the word and its place, so that lanes of a device could
// add it up in any order. It finds accidental differences. It is not cryptographic.
#pragma once

#include "shaders/shared/word_hash.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace supple::tools {

class WordHash {
public:
    /// `bytes`: whole words.
    void add(std::span<const std::byte> bytes) {
        for (size_t at = 0; at + sizeof(uint32_t) <= bytes.size(); at += sizeof(uint32_t)) {
            uint32_t word = 0;
            std::memcpy(&word, bytes.data() + at, sizeof word);
            low_ += shared::lowWordMix(word, count_);
            high_ += shared::highWordMix(word, count_);
            ++count_;
        }
    }
    [[nodiscard]] uint64_t value() const { return low_ | uint64_t{high_} << 32; }

private:
    uint32_t low_ = 0, high_ = 0;
    uint32_t count_ = 0; ///< of words
};

} // namespace supple::tools
