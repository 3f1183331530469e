#include "ui/widgets/fields/number_input.h"

#include "tests/ui/screen.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

namespace dollytrack::ui::number_input_test {
namespace {

struct Number {
    Number() {
        limits.range = {0.01, 1.0};
        limits.unit = " m";
    }
    void draw() {
        ImGui::SetNextItemWidth(200);
        const FieldEdit edit = numberInput(value, limits, "number");
        changes += edit.changed ? 1 : 0;
        ends += edit.finished ? 1 : 0;
    }
    NumberLimits limits;
    double value = 0.6;
    int changes = 0;
    int ends = 0;
};

TEST(NumberInput, ReadsWhatPeopleType) {
    NumberLimits limits;
    limits.range = {-5.0, 10.0};
    limits.unit = " m";
    const auto value = [&](const char* text) { return readNumber(text, limits).value; };
    EXPECT_EQ(value("0.45"), 0.45);
    EXPECT_EQ(value(" 0,45 m "), 0.45);
    EXPECT_EQ(value("+3"), 3.0);
    EXPECT_EQ(value("-2e-1"), -0.2);
    for (const char* text : {"", "abc", "1.2.3", "4 kg", "nan", "inf", "1,000,000"}) {
        EXPECT_FALSE(value(text)) << text;
        EXPECT_FALSE(readNumber(text, limits).note.empty()) << text;
    }
    EXPECT_EQ(value("40"), 10.0);
    EXPECT_EQ(readNumber("40", limits).note, "-5 .. 10 m; set to 10 m");
    EXPECT_EQ(readNumber("4", limits).note, "");
    limits.whole = true;
    EXPECT_EQ(value("2.6"), 3.0);
    EXPECT_FALSE(readNumber("2.6", limits).note.empty());
}

TEST(NumberInput, KnowsRangesThatBeginAboveAZeroOfItsOwn) {
    NumberLimits limits;
    limits.range = {0.0, 20000.0, 1000.0};
    limits.unit = " K";
    EXPECT_EQ(readNumber("0", limits).note, "");
    EXPECT_EQ(readNumber("1000", limits).note, "");
    EXPECT_EQ(readNumber("500", limits).value, 1000.0);
    EXPECT_EQ(readNumber("500", limits).note, "0, or 1000 .. 20000 K; set to 1000 K");
    EXPECT_EQ(readNumber("-1", limits).value, 0.0);
}

TEST(NumberInput, TakesATypedValueAsOneEdit) {
    Number number;
    test::Screen screen([&] { number.draw(); });
    ASSERT_TRUE(screen.typeInto("number", "0.25"));
    EXPECT_EQ(number.value, 0.25);
    EXPECT_EQ(number.changes, 1);
    EXPECT_EQ(number.ends, 1);
    EXPECT_FALSE(screen.shows("number.note"));
}

TEST(NumberInput, SaysWhatBecomesOfAValueOutOfRange) {
    Number number;
    test::Screen screen([&] { number.draw(); });
    screen.typeInto("number", "40");
    EXPECT_EQ(number.value, 1.0);
    EXPECT_TRUE(screen.shows("number.note"));
    screen.frame(60 * 8);
    EXPECT_FALSE(screen.shows("number.note")) << "it goes by itself";
}

TEST(NumberInput, SaysThatAWordIsNoNumber) {
    Number number;
    test::Screen screen([&] { number.draw(); });
    screen.typeInto("number", "abc");
    EXPECT_EQ(number.value, 0.6);
    EXPECT_EQ(number.changes, 0);
    EXPECT_TRUE(screen.shows("number.note"));
}

TEST(NumberInput, ADoubleClickTypesAndMovesNothing) {
    Number number;
    test::Screen screen([&] { number.draw(); });
    screen.doubleClick("number");
    EXPECT_EQ(number.value, 0.6) << "the middle of the bar is 0.505";
    EXPECT_EQ(number.changes, 0);
    screen.type("0.3");
    EXPECT_EQ(number.value, 0.6) << "not before Enter";
    screen.press(GLFW_KEY_ENTER);
    EXPECT_EQ(number.value, 0.3);
}

TEST(NumberInput, EscapeLeavesTheValue) {
    Number number;
    test::Screen screen([&] { number.draw(); });
    screen.doubleClick("number");
    screen.type("0.3");
    screen.press(GLFW_KEY_ESCAPE);
    EXPECT_EQ(number.value, 0.6);
    EXPECT_EQ(number.changes + number.ends, 0);
    EXPECT_FALSE(screen.shows("number.note"));
}

TEST(NumberInput, APressAloneChangesNothingAndADragDoes) {
    Number number;
    test::Screen screen([&] { number.draw(); });
    screen.click("number");
    EXPECT_EQ(number.value, 0.6);
    EXPECT_EQ(number.ends, 0);
    screen.drag("number", 50, 0);  // from the middle to three quarters of the bar
    EXPECT_NEAR(number.value, 0.75, 0.03);
    EXPECT_GT(number.changes, 2);
    EXPECT_EQ(number.ends, 1);
}

TEST(NumberInput, DragsRelativelyWhereTheRangeIsWide) {
    Number number;
    number.limits.slides = false;
    number.limits.range.max = 1e6;
    number.limits.speed = 0.5F;
    test::Screen screen([&] { number.draw(); });
    screen.drag("number", 100, 0);
    EXPECT_GT(number.value, 30.0);
    EXPECT_LT(number.value, 60.0);
    EXPECT_EQ(number.ends, 1);
}

}  // namespace
}  // namespace dollytrack::ui::number_input_test
