#include "ui/widgets/commands/command_palette.h"

#include "tests/support/scene_builder.h"
#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace dollytrack::ui::command_palette_test {
namespace {

/// The palette over a few commands, two parameters and a furnished room.
class CommandPaletteTest : public testing::Test {
  protected:
    CommandPaletteTest() {
        const auto nothing = [] {};
        commands.add({"file.open", "File", "Open…", {GLFW_KEY_O, true}, nothing});
        commands.add({"file.save", "File", "Save", {GLFW_KEY_S, true}, nothing, [] {
                          return std::string("Nothing is open.");
                      }});
        commands.add({"view.frame_all", "View", "Frame all", {GLFW_KEY_HOME}, nothing});
        state.open = true;
        screen.frame(3);
    }
    void draw() {
        const auto now = drawCommandPalette({&commands, &parameters, &scene}, state);
        if (!now.run.empty() || !now.focus_parameter.empty() || now.select_object != 0) {
            actions = now;
        }
    }
    CommandTable commands;
    std::vector<PaletteItem> parameters = {{"fill", "Share of the image"},
                                           {"corner_distance_m", "Set-back"}};
    Scene scene = test::furnishedRoom();
    CommandPaletteState state;
    CommandPaletteActions actions;
    test::Screen screen{[this] { draw(); }};
};

TEST_F(CommandPaletteTest, TypedLettersAndEnterRunTheBestCommand) {
    screen.type("fra");
    EXPECT_TRUE(screen.shows("palette.command.view.frame_all")) << screen.names();
    EXPECT_FALSE(screen.shows("palette.command.file.open"));
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(actions.run, "view.frame_all");
    EXPECT_FALSE(state.open);
}

TEST_F(CommandPaletteTest, IsAsSmallAsItsOneLineIfNothingMatches) {
    screen.type("qqqq");
    screen.frame(3);
    ASSERT_TRUE(state.hits.empty());
    ASSERT_FALSE(ImGui::GetCurrentContext()->OpenPopupStack.empty());
    const ImGuiWindow* popup = ImGui::GetCurrentContext()->OpenPopupStack.back().Window;
    const ImGuiStyle& style = ImGui::GetStyle();
    EXPECT_NEAR(popup->Size.y,
                ImGui::GetFrameHeight() + style.ItemSpacing.y + ImGui::GetTextLineHeight() +
                    2 * style.WindowPadding.y,
                2.0F);
}

TEST_F(CommandPaletteTest, ArrowsMoveTheChoice) {
    screen.press(GLFW_KEY_DOWN);
    screen.press(GLFW_KEY_DOWN);
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(actions.run, "view.frame_all");
}

TEST_F(CommandPaletteTest, ACommandThatCannotRunIsShownButNotRun) {
    EXPECT_TRUE(screen.shows("palette.command.file.save"));
    EXPECT_FALSE(screen.enabled("palette.command.file.save"));
    screen.type("save");
    screen.press(GLFW_KEY_ENTER);
    EXPECT_TRUE(actions.run.empty());
    EXPECT_TRUE(state.open);
}

TEST_F(CommandPaletteTest, FindsParametersAndObjects) {
    screen.type("corner");
    ASSERT_TRUE(screen.click("palette.parameter.corner_distance_m")) << screen.names();
    EXPECT_EQ(actions.focus_parameter, "corner_distance_m");

    state.open = true;
    screen.frame(3);
    screen.type("sofa");
    int sofa = 0;
    for (const Object& object : scene.objects) {
        if (object.name == "sofa") sofa = object.id;
    }
    ASSERT_NE(sofa, 0);
    ASSERT_TRUE(screen.click("palette.object." + std::to_string(sofa))) << screen.names();
    EXPECT_EQ(actions.select_object, sofa);
}

TEST_F(CommandPaletteTest, EscapeClosesItAndItOpensAgainEmpty) {
    screen.type("fra");
    screen.press(GLFW_KEY_ESCAPE);
    EXPECT_FALSE(state.open);
    EXPECT_FALSE(screen.shows("palette.text"));
    state.open = true;
    screen.frame(3);
    EXPECT_TRUE(state.text.empty());
    EXPECT_TRUE(screen.shows("palette.command.file.open"));
}

}  // namespace
}  // namespace dollytrack::ui::command_palette_test
