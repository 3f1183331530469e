#include "ui/widgets/commands/help_overlay.h"

#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace dollytrack::ui::help_overlay_test {
namespace {

TEST(HelpOverlay, OpensIsSearchableAndClosesByKeyAndButton) {
    CommandTable commands;
    for (const char* group : {"File", "Edit", "View"}) {
        for (int i = 0; i < 12; ++i) {
            commands.add({group + std::to_string(i),
                          group,
                          "Command " + std::to_string(i),
                          {GLFW_KEY_A + i, true},
                          [] {}});
        }
    }
    HelpState state;
    test::Screen screen([&] { drawHelpOverlay(commands, state); });
    EXPECT_FALSE(screen.shows("help.filter"));
    state.open = true;
    screen.frame(3);
    ASSERT_TRUE(screen.shows("help.filter"));
    screen.type("orbit");
    EXPECT_EQ(state.filter, "orbit");
    screen.press(GLFW_KEY_F1);
    EXPECT_FALSE(state.open);
    state.open = true;
    screen.frame(3);
    EXPECT_TRUE(state.filter.empty());
    ASSERT_TRUE(screen.click("help.close"));
    EXPECT_FALSE(state.open);
    EXPECT_FALSE(screen.shows("help.filter"));
}

}  // namespace
}  // namespace dollytrack::ui::help_overlay_test
