#include "ui/widgets/fuzzy_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>
#include <string>

namespace dollytrack::ui::fuzzy_match_test {
namespace {

int score(std::string_view pattern, std::string_view text) {
    const auto match = fuzzyMatch(pattern, text);
    return match ? match->score : -1'000'000;
}

TEST(FuzzyMatch, FindsLettersInOrderOnly) {
    EXPECT_TRUE(fuzzyMatch("fso", "File: Save Open"));
    EXPECT_FALSE(fuzzyMatch("osf", "File: Save Open"));
    EXPECT_FALSE(fuzzyMatch("savex", "File: Save"));
    EXPECT_TRUE(fuzzyMatch("", "anything"));
}

TEST(FuzzyMatch, TakesWordsInAnyOrder) {
    EXPECT_TRUE(fuzzyMatch("save file", "File: Save"));
    EXPECT_FALSE(fuzzyMatch("save view", "File: Save"));
}

TEST(FuzzyMatch, PrefersWordStartsRunsAndShortTexts) {
    EXPECT_GT(score("sa", "File: Save"), score("sa", "File: Reset all"));
    EXPECT_GT(score("open", "File: Open…"), score("open", "Overlay: paint edges now"));
    EXPECT_GT(score("save", "File: Save"), score("save", "File: Save as…"));
    EXPECT_GT(score("fill", "fill"), score("fill", "File: install"));
    EXPECT_GT(score("fs", "File: Save"), score("fs", "Offset"));
}

TEST(FuzzyMatch, MarksTheBestPlacesNotTheFirst) {
    // The first "s" is in "Reset"; the word "Save" begins later.
    const auto match = fuzzyMatch("save", "Reset: Save");
    ASSERT_TRUE(match);
    EXPECT_EQ(match->places, (std::vector<std::size_t>{7, 8, 9, 10}));
}

/// A match exists exactly where the letters are a subsequence, and its places spell the pattern.
TEST(FuzzyMatch, AgreesWithPlainSubsequenceSearch) {
    std::mt19937 random(7);
    const std::string letters = "abAB_ 1";
    const auto word = [&](std::size_t longest, const std::string& from) {
        std::string text;
        for (std::size_t i = random() % (longest + 1); i > 0; --i) {
            text += from[random() % from.size()];
        }
        return text;
    };
    const auto lower = [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    };
    int found = 0;
    for (int round = 0; round < 20'000; ++round) {
        const std::string pattern = word(4, "abAB1_");
        const std::string text = word(12, letters);
        std::size_t matched = 0;
        for (const char c : text) {
            if (matched < pattern.size() && lower(c) == lower(pattern[matched])) ++matched;
        }
        const auto match = fuzzyMatch(pattern, text);
        ASSERT_EQ(match.has_value(), matched == pattern.size()) << pattern << " in " << text;
        if (!match) continue;
        ++found;
        ASSERT_EQ(match->places.size(), pattern.size());
        for (std::size_t i = 0; i < pattern.size(); ++i) {
            ASSERT_EQ(lower(text[match->places[i]]), lower(pattern[i])) << pattern << " " << text;
        }
    }
    EXPECT_GT(found, 1000);
}

}  // namespace
}  // namespace dollytrack::ui::fuzzy_match_test
