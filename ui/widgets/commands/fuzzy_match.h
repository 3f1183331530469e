#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

struct FuzzyMatch {
    int score = 0;                    // higher is better
    std::vector<std::size_t> places;  // bytes of the text that matched, rising
};

/// Finds the letters of `pattern` in `text`, in order but with gaps, without regard to case; the
/// pattern's words may come in any order. Among all ways it takes the best: beginnings of words
/// and letters in a row count most. Nothing when a letter is missing.
std::optional<FuzzyMatch> fuzzyMatch(std::string_view pattern, std::string_view text);

}  // namespace dollytrack::ui
