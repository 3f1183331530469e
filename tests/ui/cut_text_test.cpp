#include "ui/widgets/cut_text.h"

#include "tests/ui/screen.h"
#include "ui/widgets/cut_lines.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::ui::cut_text_test {
namespace {

float widthOf(const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x;
}

/// Calls `check` inside a drawn frame, where text can be measured.
void onScreen(const std::function<void()>& check) {
    bool done = false;
    const test::Screen screen([&] {
        if (!std::exchange(done, true)) check();
    });
}

TEST(CutText, LeavesAloneWhatFits) {
    onScreen([] {
        EXPECT_EQ(cutToWidth("sofa", widthOf("sofa")), "sofa");
        EXPECT_EQ(cutToWidth("", 10.0F), "");
    });
}

// The result must equal that of trying every length.
TEST(CutText, KeepsAsMuchAsFits) {
    onScreen([] {
        const std::string text = "curtain_living_room_left_2";
        for (float width = 20.0F; width < widthOf(text); width += 7.0F) {
            std::string longest = "\u2026";
            for (std::size_t i = 0; i <= text.size(); ++i) {
                const std::string tried = text.substr(0, i) + "\u2026";
                if (widthOf(tried) <= width) longest = tried;
            }
            EXPECT_EQ(cutToWidth(text, width), longest) << width;
        }
    });
}

TEST(CutText, KeepsWhatTellsNamesApart) {
    onScreen([] {
        const std::vector<std::string> names = {"flat-COLLADA-sofa-material",
                                                "flat-COLLADA-lamp-material", "stool"};
        EXPECT_EQ(cutApart(names, widthOf("flat-CO\u2026erial")),
                  (std::vector<std::string>{"\u2026sofa\u2026", "\u2026lamp\u2026", "stool"}));
        EXPECT_EQ(cutApart(names, 2 * widthOf(names[0])), names);
        // Parts of words are kept, and names of which nothing would be left.
        for (const std::vector<std::string>& others :
             {std::vector<std::string>{"curtainAAAAroom", "curtainBBBBroom"},
              std::vector<std::string>{"chair-of-the-room-", "chair-of-the-room-room-"}}) {
            const float width = widthOf("chair\u2026om-");
            const std::vector<std::string> shown = cutApart(others, width);
            for (std::size_t i = 0; i < others.size(); ++i) {
                EXPECT_EQ(shown[i], cutToWidth(others[i], width, Cut::Middle));
            }
        }
        EXPECT_EQ(
            cutApart(
                {"a-long-room-of-one-kind", "a-long-room-of-two-kind", "a-long-room-of-one-kind"},
                widthOf("a-lon\u2026ind")),
            (std::vector<std::string>{"\u2026one\u2026", "\u2026two\u2026", "\u2026one\u2026"}));
    });
}

TEST(CutText, KeepsTheNumberAtANamesEnd) {
    onScreen([] {
        const float width = widthOf("curtain_liv");
        const std::string one = cutToWidth("curtain_living_1", width, Cut::Middle);
        const std::string two = cutToWidth("curtain_living_2", width, Cut::Middle);
        EXPECT_NE(one, two);
        EXPECT_TRUE(one.ends_with("_1")) << one;
        EXPECT_TRUE(one.starts_with("cur")) << one;
        EXPECT_LE(widthOf(one), width);
    });
}

TEST(CutText, NeverCutsALetterApart) {
    onScreen([] {
        const std::string text = "\u00dcberhangm\u00f6belst\u00fcck";
        for (float width = 5.0F; width < 150.0F; width += 3.0F) {
            for (const Cut cut : {Cut::End, Cut::Middle}) {
                const std::string shown = cutToWidth(text, width, cut);
                for (std::size_t i = 0; i < shown.size(); ++i) {
                    const auto byte = static_cast<unsigned char>(shown[i]);
                    const std::size_t length = byte < 0x80 ? 1 : byte < 0xE0 ? 2 : 3;
                    ASSERT_NE(byte & 0xC0U, 0x80U) << shown;
                    i += length - 1;
                    ASSERT_LT(i, shown.size());
                }
            }
        }
    });
}

/// The texts that are cut where `draw` draws them, in a window of 200 x 100 px.
std::vector<std::string> cutIn(const std::function<void()>& draw) {
    const test::Screen screen(draw, 200, 100);
    std::vector<std::string> texts;
    for (const CutLine& line : findCutLines(*ImGui::GetDrawData())) texts.push_back(line.text);
    return texts;
}

TEST(CutLines, TextThatFitsIsNotCut) {
    EXPECT_TRUE(cutIn([] {
                    ImGui::Button("Import \u2026");
                    ImGui::TextUnformatted("Length");
                    ImGui::Button("\u00d7");
                    ImGui::TextWrapped("%s", "A sentence that needs more than one line of text.");
                }).empty());
}

TEST(CutLines, AnEdgeThatCutsLettersIsFound) {
    // By the widget, by the window, and by a column.
    EXPECT_EQ(cutIn([] { ImGui::Button("Reset all values", {60, 0}); }).size(), 1U);
    EXPECT_EQ(cutIn([] { ImGui::TextUnformatted("MMMMMMMMMMMMMMMMMMMMMMMMMMMMMMMM"); }).size(), 1U);
    const auto texts = cutIn([] {
        if (!ImGui::BeginTable("t", 2)) return;
        ImGui::TableNextColumn();
        ImGui::TextUnformatted("MMMMMMMMMMMMMMMM");
        ImGui::TableNextColumn();
        ImGui::TextUnformatted("fits");
        ImGui::EndTable();
    });
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_TRUE(texts[0].starts_with("MMM")) << texts[0];
}

TEST(CutLines, AShortenedTextIsFound) {
    const auto texts =
        cutIn([] { cutText("curtain_living_room_left", ImVec4(1, 1, 1, 1), {}, Cut::End, 90.0F); });
    ASSERT_EQ(texts.size(), 1U);
    EXPECT_TRUE(texts[0].starts_with("curtain")) << texts[0];
    EXPECT_TRUE(texts[0].ends_with("\u2026")) << texts[0];
}

TEST(CutLines, LinesThatScrollOutOfAListAreNotCut) {
    EXPECT_TRUE(cutIn([] {
                    ImGui::BeginChild("list", {0, 45});
                    for (int i = 0; i < 20; ++i) ImGui::TextUnformatted("one line of a list");
                    ImGui::EndChild();
                }).empty());
}

}  // namespace
}  // namespace dollytrack::ui::cut_text_test
