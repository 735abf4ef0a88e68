// A hash of 32-bit words: two sums over them, each of a mix of the word and its place, so that lanes of a device could
// add it up in any order. It finds accidental differences. It is not cryptographic.
#pragma once

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
            low_ += mixed(word, 0x9E3779B1u, 0u);
            high_ += mixed(word, 0x85EBCA77u, 0x165667B1u);
            ++count_;
        }
    }
    [[nodiscard]] uint64_t value() const { return low_ | uint64_t{high_} << 32; }

private:
    [[nodiscard]] uint32_t mixed(uint32_t word, uint32_t factor, uint32_t shift) const {
        uint32_t h = word ^ ((count_ + shift) * factor);
        h ^= h >> 16;
        h *= 0x85EBCA6Bu;
        h ^= h >> 13;
        h *= 0xC2B2AE35u;
        h ^= h >> 16;
        h = ((h + count_) * factor) ^ (word >> 7);
        h ^= h >> 15;
        h *= 0x2C1B3C6Du;
        return h ^ h >> 12;
    }

    uint32_t low_ = 0, high_ = 0;
    uint32_t count_ = 0;
};

} // namespace supple::tools
