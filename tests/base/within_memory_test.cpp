// Running out of memory becomes an error; nothing else is caught.
#include "base/within_memory.h"

#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace supple {
namespace {

TEST(WithinMemory, GivesWhatIsBuilt) {
    const Result<int> built = withinMemory("tables", []() -> Result<int> { return 3; });
    ASSERT_TRUE(built.ok());
    EXPECT_EQ(*built, 3);
}

TEST(WithinMemory, GivesTheErrorOfWhatIsBuilt) {
    const Result<int> built = withinMemory("tables", []() -> Result<int> {
        return Error{ErrorCode::asset, "no faces"};
    });
    ASSERT_FALSE(built.ok());
    EXPECT_EQ(built.error().code, ErrorCode::asset);
    EXPECT_EQ(built.error().message, "no faces");
}

TEST(WithinMemory, TurnsRunningOutIntoAnError) {
    const Result<int> built = withinMemory("tables", []() -> Result<int> { throw std::bad_alloc(); });
    ASSERT_FALSE(built.ok());
    EXPECT_EQ(built.error().code, ErrorCode::hostMemory);
    EXPECT_EQ(built.error().message, "out of memory for tables");
}

/// With 32 bits a file's count comes to more than a vector may hold.
TEST(WithinMemory, TurnsAVectorThatIsTooLongIntoAnError) {
    const Result<int> built = withinMemory("tables", []() -> Result<int> {
        std::vector<char> bytes;
        bytes.resize(bytes.max_size() + size_t{1});
        return 3;
    });
    ASSERT_FALSE(built.ok());
    EXPECT_EQ(built.error().code, ErrorCode::hostMemory);
    EXPECT_EQ(built.error().message, "out of memory for tables");
}

TEST(WithinMemory, CatchesNothingElse) {
    const auto wrong = [] {
        return withinMemory("tables", []() -> Result<int> { throw std::logic_error("a mistake"); });
    };
    EXPECT_THROW(static_cast<void>(wrong()), std::logic_error);
}

} // namespace
} // namespace supple
