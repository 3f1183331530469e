#include "render/plots/figure.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <limits>

namespace dollytrack::render::figure_test {

TEST(Figure, TicksAreRoundAndSpanTheRange) {
    EXPECT_EQ(roundTicks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    const auto ticks = roundTicks(0.05, 1.0, 10);
    EXPECT_NEAR(ticks.front(), 0.0, 1e-12);
    EXPECT_NEAR(ticks.back(), 1.0, 1e-12);
    EXPECT_EQ(ticks.size(), 11U);
    EXPECT_GE(roundTicks(3.0, 3.0, 5).size(), 2U);  // a single value, too, has an axis
    EXPECT_GE(roundTicks(0.0, 0.0, 5).size(), 2U);
}

TEST(Figure, SvgInterruptsCurvesAndEscapesNames) {
    Figure figure;
    figure.title = "a < b & c";
    figure.charts.push_back(
        {"t", "x (m)", "y (%)", {{"curve", {0, 1, 2, 3, 4}, {1.0, 2.0, std::nullopt, 3.0, 4.0}}}});
    const std::string svg = figureSvg(figure);
    EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
    EXPECT_NE(svg.find("x (m)"), std::string::npos);
    int lines = 0;
    int dots = 0;
    for (std::size_t at = 0; (at = svg.find("stroke-width=\"2.0\"", at)) != std::string::npos;
         ++at) {
        ++lines;
    }
    for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++dots;
    EXPECT_EQ(lines, 3);  // two parts, and the legend's
    EXPECT_EQ(dots, 5);   // four values, and the legend's
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Figure, PngShowsBarsAsLongAsTheirValues) {
    const test::TempFolder folder;
    Figure figure;
    figure.bars.push_back({"v", {"one", "two"}, {10.0, 5.0}});
    ASSERT_TRUE(writeFigure(figure, folder.path() / "a.png"));
    const cv::Mat image = cv::imread((folder.path() / "a.png").string());
    ASSERT_FALSE(image.empty());
    // The first bar is blue, the second grey: their lengths are in the ratio of the values.
    int blue = 0;
    int grey = 0;
    for (int y = 0; y < image.rows; ++y) {
        int blue_here = 0;
        int grey_here = 0;
        for (int x = 0; x < image.cols; ++x) {
            const auto& p = image.at<cv::Vec3b>(y, x);
            blue_here += p == cv::Vec3b(178, 114, 0);
            grey_here += p == cv::Vec3b(90, 90, 90);
        }
        blue = std::max(blue, blue_here);
        grey = std::max(grey, grey_here);
    }
    EXPECT_GT(blue, 100);
    EXPECT_NEAR(grey, 0.5 * blue, 2.0);
}

TEST(Figure, OtherFilesAreRefused) {
    EXPECT_EQ(writeFigure({}, "figure.pdf").error().code, ErrorCode::Usage);
}

}  // namespace dollytrack::render::figure_test
