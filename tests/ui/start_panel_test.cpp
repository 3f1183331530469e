#include "ui/panels/scene/start_panel.h"

#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <string>

namespace dollytrack::ui::start_panel_test {
namespace {

/// A start screen with some recent files, one of them missing.
struct Start {
    explicit Start(int files) {
        for (int i = 0; i < files; ++i) {
            const std::string name = "room" + std::to_string(i) + ".dolly";
            view.recent.push_back({"/homes/" + name, name, "/homes", "2024-05-31 17:04"});
        }
        view.example = {"/usr/share/apartment.glb", "apartment.glb", "/usr/share", ""};
    }
    void draw() {
        const StartActions now = drawStartPanel(view, state);
        if (!now.open.empty()) actions.open = now.open;
        if (!now.remove.empty()) actions.remove = now.remove;
        actions.choose_file = actions.choose_file || now.choose_file;
    }
    StartView view;
    StartState state;
    StartActions actions;
};

TEST(StartPanel, OpensWhatIsClicked) {
    Start panel(3);
    test::Screen screen([&] { panel.draw(); }, 800, 600);
    ASSERT_TRUE(screen.click("start.recent.1")) << screen.names();
    EXPECT_EQ(panel.actions.open, "/homes/room1.dolly");
    ASSERT_TRUE(screen.click("start.example"));
    EXPECT_EQ(panel.actions.open, "/usr/share/apartment.glb");
    EXPECT_FALSE(panel.actions.choose_file);
    ASSERT_TRUE(screen.click("start.open"));
    EXPECT_TRUE(panel.actions.choose_file);
}

TEST(StartPanel, IsUsedWithTheKeyboardAtOnce) {
    Start panel(1);
    test::Screen screen([&] { panel.draw(); }, 800, 600);
    screen.frame(2);
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(panel.actions.open, "/homes/room0.dolly") << "the newest is chosen";
    screen.press(GLFW_KEY_DOWN);
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(panel.actions.open, "/usr/share/apartment.glb");
    screen.press(GLFW_KEY_RIGHT);
    screen.press(GLFW_KEY_ENTER);
    EXPECT_TRUE(panel.actions.choose_file);
    screen.press(GLFW_KEY_RIGHT);
    EXPECT_EQ(panel.state.chosen, 2) << "it is the last";
    screen.press(GLFW_KEY_DELETE);
    EXPECT_EQ(panel.actions.remove, "") << "only recent files can be removed";
}

// Two columns: 0 1 / 2 / example, Open.
TEST(StartPanel, ArrowKeysFollowTheColumns) {
    Start panel(3);
    test::Screen screen([&] { panel.draw(); }, 800, 600);
    screen.frame(2);
    ASSERT_EQ(screen.find("start.recent.0")->top, screen.find("start.recent.1")->top);
    ASSERT_LT(screen.find("start.recent.1")->top, screen.find("start.recent.2")->top);
    const auto after = [&](int key) {
        screen.press(key);
        return panel.state.chosen;
    };
    EXPECT_EQ(after(GLFW_KEY_UP), 0);
    EXPECT_EQ(after(GLFW_KEY_RIGHT), 1);
    EXPECT_EQ(after(GLFW_KEY_DOWN), 2) << "a shorter line";
    EXPECT_EQ(after(GLFW_KEY_DOWN), 3);
    EXPECT_EQ(after(GLFW_KEY_RIGHT), 4);
    EXPECT_EQ(after(GLFW_KEY_DOWN), 4);
    EXPECT_EQ(after(GLFW_KEY_UP), 2);
    EXPECT_EQ(after(GLFW_KEY_UP), 0);
}

TEST(StartPanel, AMissingFileIsNotOpenedButRemoved) {
    Start panel(2);
    panel.view.recent[0].missing = true;
    test::Screen screen([&] { panel.draw(); }, 800, 600);
    screen.frame(2);
    EXPECT_FALSE(screen.enabled("start.recent.0"));
    screen.click("start.recent.0");
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(panel.actions.open, "");
    ASSERT_TRUE(screen.click("start.recent.0.remove")) << screen.names();
    EXPECT_EQ(panel.actions.remove, "/homes/room0.dolly");
    EXPECT_EQ(panel.actions.open, "") << "the button lies above the row";
    screen.press(GLFW_KEY_RIGHT);
    screen.press(GLFW_KEY_DELETE);
    EXPECT_EQ(panel.actions.remove, "/homes/room1.dolly");
}

TEST(StartPanel, KeysReachRowsBelowTheEdge) {
    Start panel(10);
    test::Screen screen([&] { panel.draw(); }, 400, 300);
    screen.frame(2);
    EXPECT_FALSE(screen.shows("start.open")) << screen.names();
    for (int i = 0; i < 11; ++i) screen.press(GLFW_KEY_DOWN);
    screen.frame(2);
    ASSERT_TRUE(screen.shows("start.open")) << screen.names();
    screen.press(GLFW_KEY_ENTER);
    EXPECT_TRUE(panel.actions.choose_file);
}

}  // namespace
}  // namespace dollytrack::ui::start_panel_test
