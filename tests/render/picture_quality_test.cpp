#include "render/pictures/picture_quality.h"

#include <gtest/gtest.h>

#include <functional>

namespace dollytrack::render::picture_quality_test {
namespace {

constexpr int kWidth = 60;  // not a multiple of the tile size
constexpr int kHeight = 44;

/// The quality of a grey image with this value at each pixel.
PictureQuality qualityOf(const std::function<int(int x, int y)>& grey) {
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<std::uint8_t>(grey(x, y)));
        }
    }
    return pictureQuality(kWidth, kHeight, rgb);
}

/// The quality of a dark image with a bright object that covers this many of its 44 rows.
PictureQuality withBrightRows(int rows) {
    return qualityOf([&](int, int y) { return y < rows ? 200 : 31; });
}

TEST(PictureQuality, IsDarkWhereOneInTwentyPixelsIsNotBrightEnough) {
    EXPECT_EQ(withBrightRows(0), PictureQuality::Dark);
    EXPECT_EQ(withBrightRows(2), PictureQuality::Dark);
    EXPECT_EQ(withBrightRows(3), PictureQuality::Usable);
    EXPECT_EQ(qualityOf([](int x, int) { return x < 30 ? 32 : 60; }), PictureQuality::Usable);
}

TEST(PictureQuality, IsWhiteWhereNearlyAllIsBlownOut) {
    EXPECT_EQ(qualityOf([](int x, int y) { return 244 + (x + y) % 12; }), PictureQuality::White);
    EXPECT_EQ(qualityOf([](int x, int) { return x < 30 ? 243 : 255; }), PictureQuality::Usable);
}

TEST(PictureQuality, IsFlatWhereNothingStandsOut) {
    EXPECT_EQ(qualityOf([](int, int) { return 120; }), PictureQuality::Flat);
    // Neither a wall that is lit from the side nor grain counts as content.
    EXPECT_EQ(qualityOf([](int x, int) { return 100 + x / 2; }), PictureQuality::Flat);
    EXPECT_EQ(qualityOf([](int x, int y) { return (x + y) % 2 == 0 ? 110 : 140; }),
              PictureQuality::Flat);
    EXPECT_EQ(qualityOf([](int x, int) { return x < 32 ? 100 : 106; }), PictureQuality::Usable);
}

TEST(PictureQuality, TheTallyCountsEachPictureOnce) {
    PictureTally tally;
    tally.add(0, PictureQuality::Usable);
    tally.add(1, PictureQuality::Dark);
    tally.add(2, PictureQuality::Flat);
    tally.add(3, PictureQuality::Dark);
    EXPECT_EQ(tally.pictures, 4);
    EXPECT_EQ(tally.dark, (std::vector<int>{1, 3}));
    EXPECT_EQ(tally.flat, (std::vector<int>{2}));
    EXPECT_EQ(tally.unusable(), 3);
    for (const int frame : {7, 8, 9}) tally.add(frame, PictureQuality::Dark);
    EXPECT_EQ(unusableText(tally),
              "6 of 7 images are unusable: 5 dark (frames 1, 3, 7-9), 1 flat (frame 2)");
    EXPECT_EQ(unusableText({}), "");
}

}  // namespace
}  // namespace dollytrack::render::picture_quality_test
