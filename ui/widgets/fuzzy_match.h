#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace dollytrack::ui {

struct FuzzyMatch {
    int score = 0;                    // higher is better
    std::vector<std::size_t> places;  // ascending byte indices of the matched characters
};

/// Fuzzy match of `pattern` in the first 256 bytes of `text`, ignoring ASCII case. The letters of
/// each word must occur in order, with gaps allowed; words may match in any order. Returns the
/// best-scoring match: word starts and consecutive letters score highest, and shorter texts are
/// preferred. Returns nullopt if a word does not match.
std::optional<FuzzyMatch> fuzzyMatch(std::string_view pattern, std::string_view text);

}  // namespace dollytrack::ui
