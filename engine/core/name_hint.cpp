#include "engine/core/name_hint.h"

#include "engine/core/field_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::size_t kListed = 8;

/// Pairs of neighbouring letters; the similarity of names compares them independently of word
/// order.
std::multiset<std::string> pairsOf(std::string_view text) {
    std::multiset<std::string> pairs;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) pairs.emplace(text.substr(i, 2));
    return pairs;
}

/// Similarity by shared letter pairs, 0 to 1.
double likeness(const std::multiset<std::string>& wrong, std::string_view name) {
    const auto pairs = pairsOf(name);
    std::vector<std::string> common;
    std::ranges::set_intersection(wrong, pairs, std::back_inserter(common));
    const std::size_t all = wrong.size() + pairs.size();
    return all == 0 ? 0.0 : 2.0 * static_cast<double>(common.size()) / static_cast<double>(all);
}

}  // namespace

std::string nameHint(std::string_view wrong, const std::vector<std::string>& names) {
    const std::string close = closestName(wrong, names);
    if (!close.empty()) return fmt::format("; did you mean '{}'?", close);
    const auto wanted = pairsOf(wrong);
    std::vector<std::pair<double, std::string>> known;
    for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
        known.emplace_back(-likeness(wanted, name), name);
    }
    if (known.empty()) return "; there are none.";
    std::ranges::sort(known);
    std::string list;
    for (std::size_t i = 0; i < std::min(kListed, known.size()); ++i) {
        list += (i == 0 ? "'" : ", '") + known[i].second + "'";
    }
    if (known.size() > kListed) list += fmt::format(" and {} more", known.size() - kListed);
    return fmt::format("; there {} {}.", known.size() == 1 ? "is" : "are", list);
}

}  // namespace dollytrack
