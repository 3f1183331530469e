#include "render/dataset/frame_range.h"

#include <gtest/gtest.h>

#include <limits>

namespace dollytrack::render::frame_range_test {
namespace {

TEST(FrameRange, ReadsItsThreeParts) {
    const auto full = parseFrameRange("5:20:3");
    ASSERT_TRUE(full);
    EXPECT_EQ(full->begin, 5);
    EXPECT_EQ(full->end, 20);
    EXPECT_EQ(full->step, 3);
    const auto open = parseFrameRange("::4");
    ASSERT_TRUE(open);
    EXPECT_FALSE(open->end.has_value());
    EXPECT_EQ(open->step, 4);
    for (const char* wrong : {"", "5", "a:b", "1:2:3:4", "3:2", "0:9:0", "-1:4", "1:2x"}) {
        EXPECT_FALSE(parseFrameRange(wrong)) << wrong;
    }
}

TEST(FrameRange, SaysWhatIsWrongWithIt) {
    for (const char* text : {"10:5", "5:5", ":0"}) {
        const auto backwards = parseFrameRange(text);
        ASSERT_FALSE(backwards) << text;
        EXPECT_NE(backwards.error().message.find("ends before"), std::string::npos) << text;
    }
    EXPECT_NE(parseFrameRange("5").error().message.find("first:end:step"), std::string::npos);
}

TEST(FrameRange, SaysItselfAsItIsRead) {
    for (const char* text : {"0::1", "5:20:3", "7::2"}) {
        const auto range = parseFrameRange(text);
        ASSERT_TRUE(range);
        EXPECT_EQ(toText(*range), text);
    }
}

// The sum of an index and such a step would overflow.
TEST(FrameRange, TakesTheLargestStep) {
    const int huge = std::numeric_limits<int>::max();
    const auto range = parseFrameRange("3::" + std::to_string(huge));
    ASSERT_TRUE(range);
    EXPECT_EQ(framesOf(*range, 10), std::vector<int>{3});
    EXPECT_EQ(framesOf({0, std::nullopt, huge}, huge), std::vector<int>{0});
    EXPECT_FALSE(parseFrameRange("::" + std::to_string(std::int64_t{huge} + 1)));
    EXPECT_TRUE(framesOf({10, std::nullopt, 1}, 10).empty());
}

}  // namespace
}  // namespace dollytrack::render::frame_range_test
