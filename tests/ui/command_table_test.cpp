#include "ui/widgets/commands/command_table.h"

#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <map>
#include <string>
#include <utility>

namespace dollytrack::ui::command_table_test {
namespace {

/// A table whose keys are checked once per frame, as the window does.
class CommandTableTest : public testing::Test {
  protected:
    CommandTableTest() {
        const auto count = [this](const char* id) { return [this, id] { ++ran[id]; }; };
        commands.add({"larger", "View", "Larger", {GLFW_KEY_EQUAL, true}, count("larger")});
        commands.add({"smaller", "View", "Smaller", {GLFW_KEY_MINUS, true}, count("smaller")});
        commands.add({"redo",
                      "Edit",
                      "Redo",
                      {GLFW_KEY_Z, true, true},
                      count("redo"),
                      {},
                      {},
                      {GLFW_KEY_Y, true}});
        commands.add({"open", "File", "Open", {GLFW_KEY_O, true}, count("open")});
    }
    std::map<std::string, int> ran;
    CommandTable commands;
    CommandTable::KeySigns signs;
    test::Screen screen{[this] { commands.runShortcuts(signs); }, 400, 300};
};

TEST_F(CommandTableTest, RunsWhatItsKeysSay) {
    screen.press(GLFW_KEY_O, true);
    screen.press(GLFW_KEY_O);
    EXPECT_EQ(ran["open"], 1);
    screen.press(GLFW_KEY_EQUAL, true);
    screen.press(GLFW_KEY_EQUAL, true, true);  // where + is Shift and =
    screen.press(GLFW_KEY_KP_ADD, true);
    EXPECT_EQ(ran["larger"], 3);
}

TEST_F(CommandTableTest, ACommandMayHaveTwoShortcuts) {
    screen.press(GLFW_KEY_Z, true, true);
    screen.press(GLFW_KEY_Z, true);
    screen.press(GLFW_KEY_Y, true);
    EXPECT_EQ(ran["redo"], 2);
    EXPECT_EQ(commands.find("redo")->keys(), "Ctrl+Shift+Z, Ctrl+Y");
    EXPECT_EQ(commands.find("open")->keys(), "Ctrl+O");
}

TEST_F(CommandTableTest, NamesKeysThatWriteNothing) {
    EXPECT_EQ(Shortcut{GLFW_KEY_ENTER}.text(), "Enter");
    EXPECT_EQ((Shortcut{GLFW_KEY_DELETE, true}.text()), "Ctrl+Delete");
}

// On a German keyboard + is right of Ü, at the position of ] on an American one.
TEST_F(CommandTableTest, FindsPlusAndMinusWhereTheKeyboardHasThem) {
    screen.press(GLFW_KEY_RIGHT_BRACKET, true);
    EXPECT_EQ(ran["larger"], 0) << "nobody has said that it writes +";
    signs = [](int key) -> std::string {
        if (key == GLFW_KEY_RIGHT_BRACKET) return "+";
        return key == GLFW_KEY_SLASH ? "-" : "";
    };
    screen.press(GLFW_KEY_RIGHT_BRACKET, true);
    screen.press(GLFW_KEY_SLASH, true);
    screen.press(GLFW_KEY_SLASH);
    EXPECT_EQ(ran["larger"], 1);
    EXPECT_EQ(ran["smaller"], 1);
}

TEST(CommandMenus, CommandsOfASubmenuAreInIt) {
    CommandTable commands;
    std::string ran;
    for (const char* id : {"before", "in.first", "in.second", "after"}) {
        Command command{id, "File", id, {}, [&ran, id] { ran = id; }};
        if (command.id.starts_with("in.")) command.submenu = "Inner";
        commands.add(std::move(command));
    }
    test::Screen screen([&] {
        if (ImGui::Button("Open")) ImGui::OpenPopup("File");
        nameItem("open");
        if (!ImGui::BeginPopup("File")) return;
        commands.drawMenuItems("File");
        ImGui::EndPopup();
    });
    screen.click("open");
    screen.frame(2);
    EXPECT_TRUE(screen.shows("command.before") && screen.shows("command.after")) << screen.names();
    EXPECT_FALSE(screen.shows("command.in.first"));
    screen.click("menu.Inner");
    screen.frame(2);
    ASSERT_TRUE(screen.click("command.in.second")) << screen.names();
    EXPECT_EQ(ran, "in.second");
}

}  // namespace
}  // namespace dollytrack::ui::command_table_test
