#include "engine/core/field_list.h"
#include "engine/core/name_hint.h"

#include <gtest/gtest.h>

namespace dollytrack::closest_name_test {
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
    EXPECT_EQ(closestName("max_speed", kNames), "max_speed_mps");  // a prefix
}

TEST(ClosestName, DoesNotGuessWhatIsFar) {
    EXPECT_EQ(closestName("foo", kNames), "");
    EXPECT_EQ(closestName("bgr", kNames), "");
    EXPECT_EQ(closestName("banana", kNames), "");
    EXPECT_EQ(closestName("", kNames), "");
}

TEST(NameHint, SaysWhatThereIsWhereNothingIsClose) {
    EXPECT_EQ(nameHint("chiar", kNames), "; did you mean 'chair'?");
    EXPECT_EQ(nameHint("lampe_3", {"sofa", "work_lamp_1"}), "; there are 'work_lamp_1', 'sofa'.");
    EXPECT_EQ(nameHint("lampe_3", {}), "; there are none.");
    std::vector<std::string> many;
    for (int i = 0; i < 20; ++i) many.push_back("furniture_" + std::to_string(i));
    EXPECT_NE(nameHint("zebra", many).find("' and 12 more."), std::string::npos);
}

}  // namespace dollytrack::closest_name_test
