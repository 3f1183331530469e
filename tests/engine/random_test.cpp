#include "engine/core/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dollytrack::random_test {

// Reference output of PCG32's demo program: seed 42, stream 54.
TEST(Random, MatchesThePublishedSequence) {
    Random random(42, 54);
    for (const std::uint32_t expected :
         {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U, 0x83d2f293U, 0xbfa4784bU, 0xcbed606eU}) {
        EXPECT_EQ(random.next(), expected);
    }
}

TEST(Random, NormalHasMeanZeroAndDeviationOne) {
    Random random(1);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int kCount = 100'000;
    for (int i = 0; i < kCount; ++i) {
        const double x = random.normal();
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / kCount, 0.0, 0.02);
    EXPECT_NEAR(std::sqrt(squares / kCount), 1.0, 0.02);
}

TEST(Random, BelowStaysInRangeAndReachesItsEnds) {
    Random random(3);
    bool seen[5] = {};
    for (int i = 0; i < 1000; ++i) seen[random.below(5)] = true;
    for (const bool one : seen) EXPECT_TRUE(one);
}

}  // namespace dollytrack::random_test
