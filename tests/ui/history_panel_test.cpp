#include "ui/panels/plan/history_panel.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>

namespace dollytrack::ui::history_panel_test {
namespace {

TEST(HistoryPanel, ClickGoesToAStepBackAndForward) {
    const std::vector<std::string> names = {"Open", "Exclude lamp", "Set fill to 0.5"};
    HistoryState state;
    std::optional<std::size_t> asked;
    std::size_t position = 1;
    test::Screen screen([&] {
        if (const auto actions = drawHistoryPanel({&names, position}, state); actions.go_to) {
            asked = actions.go_to;
        }
    });
    ASSERT_TRUE(screen.click("history.step.0")) << screen.names();
    EXPECT_EQ(asked, 0U);
    ASSERT_TRUE(screen.click("history.step.2"));
    EXPECT_EQ(asked, 2U);
    // Clicking the current step does nothing.
    asked.reset();
    ASSERT_TRUE(screen.click("history.step.1"));
    EXPECT_FALSE(asked);
}

TEST(HistoryPanel, BringsTheCurrentOfManyStepsIntoView) {
    std::vector<std::string> names;
    for (int i = 0; i < 5000; ++i) names.push_back("Step " + std::to_string(i));
    HistoryState state;
    std::size_t position = 4999;
    test::Screen screen([&] { drawHistoryPanel({&names, position}, state); }, 300, 400);
    screen.frame(2);
    EXPECT_TRUE(screen.shows("history.step.4999"));
    position = 2500;
    screen.frame(3);
    EXPECT_TRUE(screen.shows("history.step.2500"));
    EXPECT_FALSE(screen.shows("history.step.4999"));
}

}  // namespace
}  // namespace dollytrack::ui::history_panel_test
