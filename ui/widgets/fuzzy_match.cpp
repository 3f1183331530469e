#include "ui/widgets/fuzzy_match.h"

#include <algorithm>
#include <cctype>
#include <limits>

namespace dollytrack::ui {
namespace {

constexpr int kLetter = 1;
constexpr int kInARow = 10;
constexpr int kWordStart = 8;
constexpr int kTextStart = 4;  // added to kWordStart
constexpr int kNever = std::numeric_limits<int>::min() / 2;
constexpr std::size_t kLongestText = 256;  // bounds the work: names from files can have any length

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool isWordStart(std::string_view text, std::size_t at) {
    if (at == 0) return true;
    const auto now = static_cast<unsigned char>(text[at]);
    const auto before = static_cast<unsigned char>(text[at - 1]);
    if (!std::isalnum(now)) return false;
    return !std::isalnum(before) || (std::isupper(now) && std::islower(before)) ||
           (std::isdigit(now) && !std::isdigit(before));
}

int letterScore(std::string_view text, std::size_t at) {
    int score = kLetter;
    if (isWordStart(text, at)) score += kWordStart;
    if (at == 0) score += kTextStart;
    return score;
}

/// Best match of one word, by dynamic programming over (letter, position).
std::optional<FuzzyMatch> matchWord(std::string_view word, std::string_view text) {
    const std::size_t n = text.size();
    const std::size_t m = word.size();
    if (m > n) return std::nullopt;
    // ending[i][j]: best score with letter i at position j; from[i][j]: position of letter i - 1.
    std::vector<int> ending(m * n, kNever);
    std::vector<std::size_t> from(m * n, 0);
    for (std::size_t i = 0; i < m; ++i) {
        int best_before = kNever;  // best score of letter i - 1 at a position before j - 1
        std::size_t best_place = 0;
        for (std::size_t j = i; j < n; ++j) {
            if (i > 0 && j >= 2 && ending[(i - 1) * n + j - 2] > best_before) {
                best_before = ending[(i - 1) * n + j - 2];
                best_place = j - 2;
            }
            if (lower(text[j]) != lower(word[i])) continue;
            const int own = letterScore(text, j);
            if (i == 0) {
                ending[j] = own;
                continue;
            }
            const int adjacent = ending[(i - 1) * n + j - 1];
            const int in_a_row = adjacent == kNever ? kNever : adjacent + kInARow;
            if (std::max(in_a_row, best_before) == kNever) continue;
            ending[i * n + j] = own + std::max(in_a_row, best_before);
            from[i * n + j] = in_a_row >= best_before ? j - 1 : best_place;
        }
    }
    const auto last = ending.end() - static_cast<std::ptrdiff_t>(n);
    const auto best = std::max_element(last, ending.end());
    if (*best == kNever) return std::nullopt;
    FuzzyMatch match;
    match.score = *best;
    auto place = static_cast<std::size_t>(best - last);
    for (std::size_t i = m; i-- > 0; place = from[i * n + place]) match.places.push_back(place);
    return match;
}

}  // namespace

std::optional<FuzzyMatch> fuzzyMatch(std::string_view pattern, std::string_view text) {
    text = text.substr(0, kLongestText);
    FuzzyMatch all;
    while (!pattern.empty()) {
        const std::size_t end = std::min(pattern.find(' '), pattern.size());
        const std::string_view word = pattern.substr(0, end);
        pattern.remove_prefix(std::min(end + 1, pattern.size()));
        if (word.empty()) continue;
        const auto match = matchWord(word, text);
        if (!match) return std::nullopt;
        all.score += match->score;
        all.places.insert(all.places.end(), match->places.begin(), match->places.end());
    }
    std::ranges::sort(all.places);
    const auto repeated = std::ranges::unique(all.places);
    all.places.erase(repeated.begin(), repeated.end());
    // Among equal matches the shorter text wins.
    all.score = all.score * 16 - static_cast<int>(text.size()) / 4;
    return all;
}

}  // namespace dollytrack::ui
