#include "ui/theme.h"

#include "tests/ui/screen.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace dollytrack::ui::theme_test {
namespace {

bool hasGlyph(const ImFont* font, ImWchar letter) {
    return font->FindGlyphNoFallback(letter) != nullptr;
}

// Chinese is in Droid, Russian in Inter and DejaVu.
TEST(Theme, LoadsTheLettersOfNames) {
    constexpr ImWchar kShaFa = 0x6C99;
    constexpr ImWchar kDe = 0x0434;
    const test::Screen screen([] {});
    EXPECT_TRUE(hasGlyph(fonts().text, 'a'));
    EXPECT_FALSE(hasGlyph(fonts().text, kShaFa));
    EXPECT_FALSE(addLetters("sofa, canapé, \u03bb"));
    EXPECT_TRUE(addLetters("\u6c99\u53d1 \u0434\u0438\u0432\u0430\u043d"));
    EXPECT_FALSE(addLetters("\u53d1"));
    EXPECT_FALSE(addLetters("not UTF-8: \xc3"));
    loadFonts(1.0);
    ASSERT_TRUE(ImGui::GetIO().Fonts->Build());
    for (const ImFont* font : {fonts().text, fonts().bold, fonts().mono}) {
        EXPECT_TRUE(hasGlyph(font, kShaFa));
        EXPECT_TRUE(hasGlyph(font, 'a'));
    }
    EXPECT_TRUE(hasGlyph(fonts().text, kDe));
}

}  // namespace
}  // namespace dollytrack::ui::theme_test
