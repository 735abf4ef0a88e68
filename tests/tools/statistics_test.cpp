#include "tools/common/statistics.h"

#include <gtest/gtest.h>
#include <vector>

namespace supple::tools {
namespace {

TEST(Statistics, QuantileInterpolatesBetweenRanks) {
    const std::vector<double> values{1.0, 2.0, 4.0, 8.0};
    EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(quantile(values, 0.5), 3.0);
    EXPECT_DOUBLE_EQ(quantile(values, 2.0 / 3.0), 4.0);
    EXPECT_DOUBLE_EQ(quantile(values, 0.95), 4.0 + 0.85 * 4.0);
    EXPECT_DOUBLE_EQ(quantile(values, 1.0), 8.0);
    EXPECT_DOUBLE_EQ(quantile(values, 7.0), 8.0);
}

TEST(Statistics, SummarySortsAndTakesAnyCount) {
    const std::vector<double> odd{9.0, 1.0, 5.0};
    EXPECT_DOUBLE_EQ(summarize(odd).median, 5.0);
    EXPECT_DOUBLE_EQ(summarize(odd).max, 9.0);
    const std::vector<double> one{2.5};
    EXPECT_DOUBLE_EQ(summarize(one).median, 2.5);
    EXPECT_DOUBLE_EQ(summarize(one).p95, 2.5);
    EXPECT_DOUBLE_EQ(summarize(one).max, 2.5);
    EXPECT_DOUBLE_EQ(summarize({}).median, 0.0);
    EXPECT_DOUBLE_EQ(summarize({}).max, 0.0);
}

TEST(Statistics, P95IsNotTheMaximumOfManyFrames) {
    std::vector<double> values(100, 1.0);
    values[17] = 50.0; // one hiccup
    EXPECT_DOUBLE_EQ(summarize(values).p95, 1.0);
    EXPECT_DOUBLE_EQ(summarize(values).max, 50.0);
}

} // namespace
} // namespace supple::tools
