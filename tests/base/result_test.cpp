// Results: a value or an error, never both, of types that can only be moved too.
#include "base/result.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace supple {
namespace {

Result<int> half(int number) {
    if (number % 2 != 0) {
        return Error{ErrorCode::range, std::to_string(number) + " is odd"};
    }
    return number / 2;
}

TEST(Result, HoldsAValue) {
    Result<int> result = half(8);
    ASSERT_TRUE(result.ok());
    EXPECT_TRUE(result);
    EXPECT_EQ(*result, 4);
    *result = 5;
    EXPECT_EQ(std::as_const(result).value(), 5);
}

TEST(Result, HoldsAnError) {
    const Result<int> result = half(7);
    ASSERT_FALSE(result.ok());
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::range);
    EXPECT_EQ(result.error().message, "7 is odd");
}

TEST(Result, TakesTypesThatCanOnlyBeMoved) {
    Result<std::unique_ptr<std::string>> result = std::make_unique<std::string>("joint");
    ASSERT_TRUE(result.ok());
    const Result<std::unique_ptr<std::string>> moved = std::move(result);
    ASSERT_TRUE(moved.ok());
    EXPECT_EQ((*moved)->size(), 5u);
    EXPECT_EQ(**moved, "joint");
    static_assert(!std::is_copy_constructible_v<Result<std::unique_ptr<std::string>>>);
}

TEST(Result, IsNoBoolByAccident) {
    // A Result<bool> that is false is a success: the two must not be mixed up without a word.
    static_assert(!std::is_convertible_v<Result<int>, bool>);
    const Result<bool> no = false;
    EXPECT_TRUE(no.ok());
    EXPECT_FALSE(*no);
}

TEST(Result, OfNothingIsAStatus) {
    EXPECT_TRUE(success().ok());
    const Status failed = Error{ErrorCode::io, "pip.glb: not found"};
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().message, "pip.glb: not found");
}

} // namespace
} // namespace supple
