#include "engine/core/field_list.h"

#include <gtest/gtest.h>

namespace dollytrack {
namespace {

const std::vector<std::string> kNames = {"rgb",   "depth", "loop",    "chair",
                                         "table", "fill",  "exclude", "max_speed_mps"};

}  // namespace

TEST(ClosestName, ForgivesSlipsOfTheHand) {
    EXPECT_EQ(closestName("rbg", kNames), "rgb");
    EXPECT_EQ(closestName("dept", kNames), "depth");
    EXPECT_EQ(closestName("chiar", kNames), "chair");
    EXPECT_EQ(closestName("tabel", kNames), "table");
    EXPECT_EQ(closestName("fil", kNames), "fill");
    EXPECT_EQ(closestName("exlude", kNames), "exclude");
    EXPECT_EQ(closestName("max_sped_mpz", kNames), "max_speed_mps");
    EXPECT_EQ(closestName("max_speed", kNames), "max_speed_mps");  // its beginning
}

TEST(ClosestName, DoesNotGuessWhatIsFar) {
    EXPECT_EQ(closestName("foo", kNames), "");
    EXPECT_EQ(closestName("bgr", kNames), "");
    EXPECT_EQ(closestName("banana", kNames), "");
    EXPECT_EQ(closestName("", kNames), "");
}

}  // namespace dollytrack
