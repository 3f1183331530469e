#include "ui/screen_scale.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::screen_scale_test {
namespace {

// Scales that desktops choose for these screens, or that people set by hand.
TEST(ScreenScale, IsUsualOnUsualScreens) {
    EXPECT_EQ(screenScale(1.0, {1920, 1080, 531, 299}), 1.0) << "24 inches";
    EXPECT_EQ(screenScale(1.0, {2560, 1440, 597, 336}), 1.0) << "27 inches";
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 597, 336}), 1.5) << "27 inches, 4K";
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 708, 399}), 1.25) << "32 inches, 4K";
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 344, 194}), 2.5) << "laptop, 4K";
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 941, 529}), 1.0) << "43 inches, 4K";
}

TEST(ScreenScale, FollowsTheDesktopsOwn) {
    EXPECT_EQ(screenScale(2.0, {1920, 1080, 531, 299}), 2.0);
    EXPECT_EQ(screenScale(1.3, {3840, 2160, 597, 336}), 1.25);
    EXPECT_EQ(screenScale(9.0, {3840, 2160, 597, 336}), 4.0);
}

TEST(ScreenScale, GuessesByTheLinesWhereTheSizeIsMadeUp) {
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 1016, 572}), 2.0) << "96 dpi exactly";
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 0, 0}), 2.0);
    EXPECT_EQ(screenScale(1.0, {3840, 2160, 160, 90}), 2.0) << "an aspect ratio, not millimetres";
    EXPECT_EQ(screenScale(1.0, {1920, 1080, 508, 286}), 1.0);
    EXPECT_EQ(screenScale(1.0, {0, 0, 0, 0}), 1.0);
}

// The window's parts fit from 1280 x 720 on, so that nothing is cut off.
TEST(ScreenScale, LeavesRoomForTheWindow) {
    for (const int width : {800, 1280, 1366, 1600, 1920, 2560, 3840, 7680}) {
        const int height = width * 9 / 16;
        const double scale = screenScale(1.0, {width, height, 250, 140});
        EXPECT_TRUE(scale == 1.0 || (width / scale >= 1279.0 && height / scale >= 719.0)) << width;
    }
}

}  // namespace
}  // namespace dollytrack::ui::screen_scale_test
