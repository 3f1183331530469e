#include "ui/panels/timeline/frame_axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dollytrack::ui::frame_axis_test {
namespace {

TEST(FrameAxis, FindsEveryFrameAtItsMiddleUnderAnyZoom) {
    for (const int count : {1, 7, 300, 20'000}) {
        for (const double factor : {1.0, 0.5, 0.11, 0.0007}) {
            FrameAxis axis(count, 232, 1270, 0, 0);
            axis.zoom(700, factor);
            for (int i = static_cast<int>(std::ceil(axis.first())); i < axis.endFrame(); ++i) {
                ASSERT_EQ(axis.frameAt(axis.xOf(i + 0.5)), i) << count << " frames × " << factor;
            }
        }
    }
}

TEST(FrameAxis, ShowsAllFramesFromEdgeToEdge) {
    const FrameAxis axis(300, 100, 700, 0, 0);
    EXPECT_DOUBLE_EQ(axis.xOf(0), 100);
    EXPECT_DOUBLE_EQ(axis.xOf(300), 700);
    EXPECT_EQ(axis.frameAt(101.99), 0);  // 2 px per frame
    EXPECT_EQ(axis.frameAt(102.0), 1);
    EXPECT_EQ(axis.frameAt(-50), 0);
    EXPECT_EQ(axis.frameAt(5000), 299);
}

TEST(FrameAxis, HasRoomAfterTheLastFrameIfWanted) {
    FrameAxis axis(300, 100, 740, 0, 0, 20);
    EXPECT_DOUBLE_EQ(axis.xOf(300), 700);
    EXPECT_DOUBLE_EQ(axis.placeAt(740), 320);
    EXPECT_EQ(axis.frameAt(740), 299);
    EXPECT_EQ(axis.endFrame(), 300);
    EXPECT_FALSE(axis.isZoomed());
    axis.zoom(740, 0.5);
    EXPECT_TRUE(axis.isZoomed());
    EXPECT_DOUBLE_EQ(axis.first() + axis.shown(), 320);
    EXPECT_DOUBLE_EQ(axis.margin(), 20);
}

TEST(FrameAxis, KeepsWhatIsUnderTheMouseWhileZooming) {
    FrameAxis axis(20'000, 0, 1000, 0, 0);
    const double place = axis.placeAt(617);
    for (int i = 0; i < 12; ++i) axis.zoom(617, 0.8);
    EXPECT_LT(axis.shown(), 2000);
    EXPECT_NEAR(axis.placeAt(617), place, 1e-6);
}

TEST(FrameAxis, NeverLeavesTheFrames) {
    FrameAxis axis(500, 0, 1000, 0, 0);
    axis.zoom(500, 0.1);
    axis.pan(1e6);
    EXPECT_DOUBLE_EQ(axis.first(), 0);
    axis.pan(-1e6);
    EXPECT_DOUBLE_EQ(axis.first() + axis.shown(), 500);
    axis.zoom(500, 1e9);
    EXPECT_DOUBLE_EQ(axis.shown(), 500);
}

TEST(FrameAxis, RevealsAFrameWithTheLeastScrolling) {
    FrameAxis axis(1000, 0, 1000, 400, 100);
    axis.reveal(450);
    EXPECT_DOUBLE_EQ(axis.first(), 400);
    axis.reveal(500);
    EXPECT_DOUBLE_EQ(axis.first(), 401);
    axis.reveal(10);
    EXPECT_DOUBLE_EQ(axis.first(), 10);
}

// For random lengths, widths, zooms and values, the columns reach exactly the smallest and the
// largest shown value, and each column's range is that of the values in it.
TEST(PlotColumns, KeepExtremes) {
    std::mt19937 random(7);
    const auto between = [&](int low, int high) {
        return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    for (int round = 0; round < 300; ++round) {
        const int count = between(1, 5000);
        std::vector<double> values(count);
        for (double& value : values) value = between(-1000, 1000);
        values[random() % values.size()] = 1e6;  // a spike of one frame
        FrameAxis axis(count, 0, between(2, 900), 0, 0);
        for (int i = between(0, 5); i > 0; --i) axis.zoom(between(0, 900), 0.5);
        const auto columns = plotColumns(axis, count, [&](int i) { return values[i]; });
        ASSERT_FALSE(columns.empty());
        const auto begin = values.begin() + axis.frameAt(axis.left());
        const auto end = values.begin() + axis.endFrame();
        EXPECT_EQ(std::ranges::max(columns, {}, &PlotColumn::high).high,
                  *std::max_element(begin, end));
        EXPECT_EQ(std::ranges::min(columns, {}, &PlotColumn::low).low,
                  *std::min_element(begin, end));
        for (const PlotColumn& column : columns) {
            ASSERT_LE(column.low, column.last);
            ASSERT_LE(column.last, column.high);
        }
    }
}

TEST(PlotColumns, RepeatAValueOverItsWholeWidth) {
    const FrameAxis axis(2, 0, 10, 0, 0);
    const auto columns = plotColumns(axis, 2, [](int i) { return i == 0 ? 3 : 8; });
    ASSERT_EQ(columns.size(), 10U);
    for (std::size_t x = 0; x < 10; ++x) {
        EXPECT_EQ(columns[x].low, x < 5 ? 3 : 8) << x;
        EXPECT_EQ(columns[x].high, x < 5 ? 3 : 8) << x;
    }
}

}  // namespace
}  // namespace dollytrack::ui::frame_axis_test
