#include "host/deflate.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace supple::host {
namespace {

constexpr size_t kWindow = 32768;
constexpr size_t kShortest = 3; ///< lengths of what is repeated
constexpr size_t kLongest = 258;
constexpr uint32_t kEnd = 256; ///< symbol
constexpr int kHashBits = 15;

/// Bits from the lowest of each byte on.
class BitWriter {
public:
    explicit BitWriter(std::vector<uint8_t>& out) : out_(out) {}
    void put(uint32_t bits, int count) {
        held_ |= uint64_t{bits} << count_;
        for (count_ += count; count_ >= 8; count_ -= 8) {
            out_.push_back(static_cast<uint8_t>(held_));
            held_ >>= 8;
        }
    }
    /// A Huffman code, which goes from its highest bit on.
    void putCode(uint32_t code, int count) {
        uint32_t reversed = 0;
        for (int bit = 0; bit < count; ++bit)
            reversed |= (code >> bit & 1u) << (count - 1 - bit);
        put(reversed, count);
    }
    void fillByte() {
        if (count_ > 0)
            put(0, 8 - count_);
    }

private:
    std::vector<uint8_t>& out_;
    uint64_t held_ = 0;
    int count_ = 0;
};

/// A literal, the end, or a length, in the fixed code.
void putSymbol(BitWriter& bits, uint32_t symbol) {
    if (symbol < 144)
        bits.putCode(0x30 + symbol, 8);
    else if (symbol < 256)
        bits.putCode(0x190 + symbol - 144, 9);
    else if (symbol < 280)
        bits.putCode(symbol - 256, 7);
    else
        bits.putCode(0xC0 + symbol - 280, 8);
}

/// Which of the ranges that double in size every `perSize` codes a value lies in.
struct Range {
    uint32_t code;
    uint32_t extra; ///< value within the range
    int extraBits;
};
Range rangeOf(uint32_t value, uint32_t perSize) {
    Range range{value, 0, 0};
    if (value >= 2 * perSize) {
        while (value >> range.extraBits >= 2 * perSize)
            ++range.extraBits;
        range.code = static_cast<uint32_t>(range.extraBits) * perSize + (value >> range.extraBits);
        range.extra = value & ((1u << range.extraBits) - 1);
    }
    return range;
}

void putRepeat(BitWriter& bits, size_t length, size_t distance) {
    if (length == kLongest) {
        putSymbol(bits, 285);
    } else {
        const Range range = rangeOf(static_cast<uint32_t>(length - kShortest), 4);
        putSymbol(bits, 257 + range.code);
        bits.put(range.extra, range.extraBits);
    }
    const Range range = rangeOf(static_cast<uint32_t>(distance - 1), 2);
    bits.putCode(range.code, 5);
    bits.put(range.extra, range.extraBits);
}

} // namespace

void appendDeflateBlock(std::span<const uint8_t> bytes, std::vector<uint8_t>& out) {
    constexpr size_t kNever = std::numeric_limits<size_t>::max();
    std::vector<size_t> latest(size_t{1} << kHashBits, kNever); // place of the last three bytes of a hash
    const auto place = [&](size_t i) -> size_t& {
        const uint32_t three = bytes[i] | static_cast<uint32_t>(bytes[i + 1]) << 8 | uint32_t{bytes[i + 2]} << 16;
        return latest[three * 0x9E3779B1u >> (32 - kHashBits)];
    };
    BitWriter bits(out);
    bits.put(0, 1); // not the last
    bits.put(1, 2); // fixed codes
    for (size_t i = 0; i < bytes.size();) {
        size_t length = 0, distance = 0;
        if (i + kShortest <= bytes.size()) {
            const size_t before = place(i);
            place(i) = i;
            distance = before == kNever ? kWindow + 1 : i - before;
            const size_t most = std::min(kLongest, bytes.size() - i);
            while (distance <= kWindow && length < most && bytes[before + length] == bytes[i + length])
                ++length;
        }
        if (length < kShortest) {
            putSymbol(bits, bytes[i++]);
            continue;
        }
        putRepeat(bits, length, distance);
        for (const size_t end = i + length; ++i < end;) {
            if (i + kShortest <= bytes.size())
                place(i) = i;
        }
    }
    putSymbol(bits, kEnd);
    bits.put(0, 3); // a stored block of nothing begins at a whole byte
    bits.fillByte();
    out.insert(out.end(), {0x00, 0x00, 0xFF, 0xFF});
}

void appendLastDeflateBlock(std::vector<uint8_t>& out) {
    BitWriter bits(out);
    bits.put(1, 1); // the last
    bits.put(1, 2); // fixed codes
    putSymbol(bits, kEnd);
    bits.fillByte();
}

} // namespace supple::host
