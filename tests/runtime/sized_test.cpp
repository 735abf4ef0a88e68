// Structs across versions: what runtime/sized.h makes of a struct that has grown.
#include "runtime/sized.h"

#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

namespace supple::runtime {
namespace {

/// As it was in the first version, as this library has it, and as a later one will.
struct First {
    uint32_t structSize;
    uint32_t a;
};
struct Now {
    uint32_t structSize;
    uint32_t a;
    uint32_t b;
    uint32_t c;
};
struct Later {
    uint32_t structSize;
    uint32_t a;
    uint32_t b;
    uint32_t c;
    uint64_t d;
};

} // namespace
template <>
inline constexpr size_t kFirstSize<Now> = sizeof(First);

namespace {

/// Bytes of a caller's struct, with more behind them that is nobody's business.
template <class T>
class Caller {
public:
    explicit Caller(const T& value, uint32_t structSize = sizeof(T)) {
        bytes_.fill(std::byte{0xEE});
        std::memcpy(bytes_.data(), &value, sizeof(value));
        std::memcpy(bytes_.data(), &structSize, sizeof(structSize));
    }
    [[nodiscard]] Now& asNow() { return *reinterpret_cast<Now*>(bytes_.data()); }
    [[nodiscard]] T value() const {
        T result;
        std::memcpy(&result, bytes_.data(), sizeof(result));
        return result;
    }
    [[nodiscard]] std::byte at(size_t offset) const { return bytes_[offset]; }

private:
    alignas(8) std::array<std::byte, 64> bytes_{};
};

TEST(Sized, AnOlderCallersStructIsTakenAsIfTheRestWereZero) {
    Caller<First> caller({0, 7});
    Now to{1, 2, 3, 4};
    ASSERT_TRUE(readSized(caller.asNow(), to));
    EXPECT_EQ(to.structSize, sizeof(Now));
    EXPECT_EQ(to.a, 7u);
    EXPECT_EQ(to.b, 0u) << "not what lies behind the caller's struct";
    EXPECT_EQ(to.c, 0u);
    // And one of the version between, which has b.
    Caller<Now> between({0, 7, 8, 9}, offsetof(Now, c));
    ASSERT_TRUE(readSized(between.asNow(), to));
    EXPECT_EQ(to.b, 8u);
    EXPECT_EQ(to.c, 0u);
}

TEST(Sized, SmallerThanTheFirstVersionIsRefused) {
    for (uint32_t size = 0; size < sizeof(First); ++size) {
        Caller<First> caller({0, 7}, size);
        Now to{1, 2, 3, 4};
        EXPECT_FALSE(readSized(caller.asNow(), to)) << size;
        EXPECT_EQ(to.a, 2u) << "untouched";
    }
}

TEST(Sized, ANewerCallersStructMustBeZeroWhereItIsUnknown) {
    Later later{0, 1, 2, 3, 0};
    Now to{};
    {
        Caller<Later> caller(later);
        ASSERT_TRUE(readSized(caller.asNow(), to));
        EXPECT_EQ(to.structSize, sizeof(Now));
        EXPECT_EQ(to.c, 3u);
    }
    for (uint32_t bit = 0; bit < 64; bit += 21) {
        later.d = uint64_t{1} << bit;
        Caller<Later> caller(later);
        EXPECT_FALSE(readSized(caller.asNow(), to)) << bit;
    }
}

TEST(Sized, WritingFillsWhatTheCallerHasAndNoMore) {
    const Now from{0, 11, 12, 13};
    Caller<First> older({0, 1});
    writeSized(from, older.asNow());
    EXPECT_EQ(older.value().structSize, sizeof(First)) << "stays the caller's";
    EXPECT_EQ(older.value().a, 11u);
    for (size_t i = sizeof(First); i < 64; ++i) {
        EXPECT_EQ(older.at(i), std::byte{0xEE}) << i;
    }
    Caller<Later> newer({0, 1, 2, 3, 0xFFFFFFFFFFFFFFFFull});
    writeSized(from, newer.asNow());
    EXPECT_EQ(newer.value().structSize, sizeof(Later));
    EXPECT_EQ(newer.value().c, 13u);
    EXPECT_EQ(newer.value().d, 0u) << "unknown here, so zero";
    for (size_t i = sizeof(Later); i < 64; ++i) {
        EXPECT_EQ(newer.at(i), std::byte{0xEE}) << i;
    }
}

} // namespace
} // namespace supple::runtime
