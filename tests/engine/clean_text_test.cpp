#include "engine/core/clean_text.h"
#include "engine/core/clean_lines.h"
#include "engine/core/text_lists.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dollytrack::clean_text_test {
namespace {

TEST(CleanText, KeepsWhatIsValid) {
    for (const std::string text : {"", "bed_1", "B\xC3\xBCro", "\xE6\xA4\x85\xE5\xAD\x90",
                                   "\xF0\x9F\x9B\x8B", "\xEF\xBF\xBD"}) {
        EXPECT_EQ(cleanText(text), text);
    }
}

TEST(CleanText, ReplacesBadBytes) {
    const std::string bad = "\xEF\xBF\xBD";
    EXPECT_EQ(cleanText("B\xFCro"), "B" + bad + "ro");                // Latin-1
    EXPECT_EQ(cleanText("\xE6\xA4"), bad);                            // cut off
    EXPECT_EQ(cleanText("\xE6\xA4x"), bad + "x");                     // cut off in the middle
    EXPECT_EQ(cleanText("\xC0\xAF"), bad + bad);                      // overlong
    EXPECT_EQ(cleanText("\xED\xA0\x80"), bad + bad + bad);            // surrogate
    EXPECT_EQ(cleanText("\xF4\x90\x80\x80"), bad + bad + bad + bad);  // beyond U+10FFFF
}

TEST(CleanText, DropsControlCharacters) {
    EXPECT_EQ(cleanText("a\x1B[31m\tb\r\n\x7F\xC2\x85"), "a[31mb");
    EXPECT_EQ(cleanText(std::string_view("a\0b", 3)), "ab");
    // U+202E and U+2066, but not their neighbours U+202F and U+2065.
    EXPECT_EQ(cleanText("a\xE2\x80\xAE"
                        "b\xE2\x81\xA6"
                        "c"),
              "abc");
    EXPECT_EQ(cleanText("\xE2\x80\xAF\xE2\x81\xA5"), "\xE2\x80\xAF\xE2\x81\xA5");
}

TEST(CleanLines, KeepsLineBreaksAndTabsAlone) {
    EXPECT_EQ(cleanLines("a\x1B[31m\tb\r\n\x7F\xC2\x85\xFC"), "a[31m\tb\n\xEF\xBF\xBD");
}

// Text from a stream, cut at any position.
TEST(CleanLines, PiecesGiveWhatTheWholeGives) {
    const std::string text =
        "B\xC3\xBCro \xE6\xA4\x85\xE5\xAD\x90\n\x1B\xF0\x9F\x9B\x8B \xFC \xE6x.";
    for (std::size_t cut = 0; cut <= text.size(); ++cut) {
        for (std::size_t second = cut; second <= text.size(); ++second) {
            LineCleaner cleaner;
            std::string clean = cleaner.add(text.substr(0, cut));
            clean += cleaner.add(text.substr(cut, second - cut));
            clean += cleaner.add(text.substr(second));
            EXPECT_EQ(clean, cleanLines(text)) << cut << ", " << second;
        }
    }
}

TEST(Trimmed, LeavesBlanksInTheMiddleAlone) {
    EXPECT_EQ(trimmed(" \ta b\r\n"), "a b");
    EXPECT_EQ(trimmed("a"), "a");
    EXPECT_EQ(trimmed(" \t\r\n"), "");
    EXPECT_EQ(trimmed(""), "");
}

TEST(FrameRanges, JoinNeighboursAndEndAfterTenRanges) {
    EXPECT_EQ(frameRanges({4}), "frame 4");
    EXPECT_EQ(frameRanges({4, 5}), "frames 4-5");
    EXPECT_EQ(frameRanges({0, 2, 3, 4, 9}), "frames 0, 2-4, 9");
    EXPECT_EQ(frameRanges({0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20}),
              "frames 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, ...");
}

TEST(CleanText, AnyTwoBytesMakeJson) {
    for (int i = 0; i < 65536; ++i) {
        const std::string text = {static_cast<char>(i >> 8), static_cast<char>(i & 255), 'x'};
        EXPECT_NO_THROW(static_cast<void>(nlohmann::json(cleanText(text)).dump())) << i;
    }
}

}  // namespace
}  // namespace dollytrack::clean_text_test
