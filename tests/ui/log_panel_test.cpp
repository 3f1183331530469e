#include "ui/panels/plan/log_panel.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <random>

namespace dollytrack::ui::log_panel_test {
namespace {

TEST(RowsBetween, AreThoseThatReachIntoTheRange) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> height(1, 5);
    std::vector<float> bottoms;
    for (int i = 0; i < 40; ++i) {
        bottoms.push_back((i > 0 ? bottoms.back() : 0.0F) + static_cast<float>(height(random)));
    }
    const float total = bottoms.back();
    for (float top = 0.0F; top < total; top += 0.5F) {
        for (float bottom = top + 0.5F; bottom < total + 3.0F; bottom += 0.5F) {
            const RowRange found = rowsBetween(bottoms, top, bottom);
            for (std::size_t i = 0; i < bottoms.size(); ++i) {
                const float begin = i > 0 ? bottoms[i - 1] : 0.0F;
                const bool reaches = begin < bottom && bottoms[i] > top;
                ASSERT_EQ(reaches, i >= found.first && i < found.end)
                    << "row " << i << " between " << top << " and " << bottom;
            }
        }
    }
    const RowRange below = rowsBetween(bottoms, total, total + 10.0F);
    EXPECT_EQ(below.first, below.end);
    const RowRange none = rowsBetween({}, 0.0F, 10.0F);
    EXPECT_EQ(none.first, none.end);
}

/// A log whose messages take one to several lines each.
struct Log {
    explicit Log(int count) {
        for (int i = 0; i < count; ++i) add(i);
    }
    void add(int i) {
        std::string message = "message " + std::to_string(i);
        for (int k = 0; k < i % 60; ++k) message += " with more words";
        buffer.add({log::Level::Info, "import", message});
    }
    void scroll(test::Screen& screen, float wheel) {
        screen.frame();
        ImGui::GetIO().MousePos = {300, 250};
        screen.frame(2);
        ImGui::GetIO().MouseWheel = wheel;
        screen.frame(3);
    }
    LogBuffer buffer;
    LogPanelState state;
};

TEST(LogPanel, DrawsOnlyTheVisibleMessagesAndFollowsNewOnes) {
    Log log(3000);
    test::Screen screen([&] { drawLogPanel(log.buffer, log.state); }, 900, 400);
    screen.frame(4);
    ASSERT_TRUE(screen.shows("log.message.2999")) << screen.names();
    EXPECT_FALSE(screen.shows("log.message.0"));
    EXPECT_FALSE(screen.shows("log.message.2900"));
    // Dear ImGui's own layout of the visible rows ends where the measured heights end.
    const float end = screen.find("log.message.2999")->bottom;
    log.add(3000);
    screen.frame(3);
    ASSERT_TRUE(screen.shows("log.message.3000")) << "the panel follows the end of the log";
    EXPECT_NEAR(screen.find("log.message.3000")->bottom, end, 1.0F);
    for (std::size_t i = 0; i + 1 < 3000; ++i) {
        const auto upper = screen.find("log.message." + std::to_string(i));
        const auto lower = screen.find("log.message." + std::to_string(i + 1));
        if (!upper || !lower) continue;
        EXPECT_NEAR(lower->top - upper->bottom, ImGui::GetStyle().ItemSpacing.y, 0.01F) << i;
    }
}

TEST(LogPanel, StaysWhereTheUserHasScrolledTo) {
    Log log(300);
    test::Screen screen([&] { drawLogPanel(log.buffer, log.state); }, 900, 400);
    screen.frame(4);
    log.scroll(screen, 1000.0F);
    ASSERT_TRUE(screen.shows("log.message.0")) << screen.names();
    const float top = screen.find("log.message.0")->top;
    log.add(300);
    screen.frame(3);
    ASSERT_TRUE(screen.shows("log.message.0"));
    EXPECT_EQ(screen.find("log.message.0")->top, top);
    EXPECT_FALSE(screen.shows("log.message.300"));
}

TEST(LogPanel, ShowsTheMessagesThatMatchTheFilter) {
    Log log(40);
    log.buffer.add({log::Level::Warning, "import", "a texture is missing"});
    test::Screen screen([&] { drawLogPanel(log.buffer, log.state); }, 900, 400);
    screen.frame(2);
    ASSERT_TRUE(screen.click("log.filter"));
    screen.type("texture");
    screen.frame(3);
    EXPECT_EQ(log.state.rows.records.size(), 1U);
    EXPECT_EQ(log.state.rows.all, 41U);
    EXPECT_TRUE(screen.shows("log.message.0"));
    EXPECT_FALSE(screen.shows("log.message.1"));
    ASSERT_TRUE(screen.click("log.clear"));
    screen.frame(2);
    EXPECT_FALSE(screen.shows("log.message.0"));
    EXPECT_EQ(log.state.rows.all, 0U);
}

}  // namespace
}  // namespace dollytrack::ui::log_panel_test
