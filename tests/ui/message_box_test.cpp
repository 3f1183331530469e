#include "ui/widgets/message_box.h"

#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace dollytrack::ui::message_box_test {
namespace {

/// Shows a message box until it is answered.
struct Asking {
    MessageBox box;
    int answer = -1;
    void operator()() {
        if (answer < 0) answer = drawMessageBox(box);
    }
};

TEST(MessageBox, ReturnsTheButtonThatWasClicked) {
    Asking asking{{true, "The scene is gone", "Find it.", {"Find…", "Close it", "Cancel"}}};
    test::Screen screen(std::ref(asking));
    ASSERT_TRUE(screen.click("message.close_it")) << screen.names();
    EXPECT_EQ(asking.answer, 1);
    EXPECT_FALSE(screen.shows("message.close_it"));
}

TEST(MessageBox, EnterIsTheFirstAndEscapeTheLastButton) {
    Asking first{{false, "Title", "Text", {"Yes", "No"}}};
    test::Screen(std::ref(first)).press(GLFW_KEY_ENTER);
    EXPECT_EQ(first.answer, 0);
    Asking second{{false, "Title", "Text", {"Yes", "No"}}};
    test::Screen(std::ref(second)).press(GLFW_KEY_ESCAPE);
    EXPECT_EQ(second.answer, 1);
}

TEST(MessageBox, LongTextLeavesTheButtonsOnTheScreen) {
    std::string text;
    for (int i = 0; i < 300; ++i) text += "texture_" + std::to_string(i) + ".png is missing\n";
    Asking asking{{true, "Textures are missing", text, {"OK"}}};
    test::Screen screen(std::ref(asking));
    screen.frame(3);
    const auto ok = screen.find("message.ok");
    ASSERT_TRUE(ok);
    EXPECT_LE(ok->bottom, 720.0F);
}

TEST(MessageBox, UnsavedChangesHaveThreeAnswers) {
    for (const auto& [name, expected] : {std::pair{"message.save", UnsavedAnswer::Save},
                                         std::pair{"message.dont_save", UnsavedAnswer::Discard},
                                         std::pair{"message.cancel", UnsavedAnswer::Cancel}}) {
        UnsavedAnswer answer = UnsavedAnswer::None;
        test::Screen screen([&answer] {
            if (answer == UnsavedAnswer::None) {
                answer = askUnsaved("Save the changes to room.dolly?", "before it is closed");
            }
        });
        ASSERT_TRUE(screen.click(name)) << screen.names();
        EXPECT_EQ(answer, expected) << name;
    }
}

}  // namespace
}  // namespace dollytrack::ui::message_box_test
