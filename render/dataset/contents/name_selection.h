#pragma once

#include "engine/core/field_list.h"
#include "engine/core/result.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// Lower case without spaces, to suggest a name for input such as " RGB".
inline std::string lowerTrimmed(std::string_view text) {
    std::string plain;
    for (const char c : text) {
        if (c >= 'A' && c <= 'Z') {
            plain += static_cast<char>(c - 'A' + 'a');
        } else if (c != ' ') {
            plain += c;
        }
    }
    return plain;
}

/// Names to suggest for a wrong one: those that start with it without a plural s, else the closest.
/// For "normals": "'normal_camera' or 'normal_world'". Empty if none is close.
inline std::string meantNames(std::string_view wrong, const std::vector<std::string>& known) {
    std::string_view stem = wrong;
    if (stem.size() > 3 && stem.ends_with('s')) stem.remove_suffix(1);
    std::string meant;
    for (const std::string& name : known) {
        if (stem.size() < 3 || !name.starts_with(stem)) continue;
        if (name == stem) return "'" + name + "'";
        meant += (meant.empty() ? "'" : " or '") + name + "'";
    }
    if (!meant.empty()) return meant;
    const std::string close = closestName(wrong, known);
    return close.empty() ? close : "'" + close + "'";
}

/// Selects the rows of a table by name, in the table's order: all of them for "all", the standard
/// ones if `names` is empty. A row must have `name` and `standard`. Returns Usage at `where`,
/// suggesting the closest name, for an unknown one.
template <class Row>
Result<std::vector<const Row*>> chooseRows(std::span<const Row> table,
                                           const std::vector<std::string>& names,
                                           const std::string& kind, const std::string& where) {
    std::vector<std::string> known;
    for (const Row& row : table) known.push_back(row.name);
    const bool all_wanted = std::find(names.begin(), names.end(), "all") != names.end();
    for (const std::string& name : names) {
        if (name == "all" || std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string close = meantNames(lowerTrimmed(name), known);
        std::string all;
        for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
        return fail(ErrorCode::Usage,
                    "There is no " + kind + " '" + name + "'" +
                        (close.empty() ? "" : "; did you mean " + close + "?") +
                        (close.empty() ? "; there are " : " There are ") + all + ".",
                    where);
    }
    std::vector<const Row*> chosen;
    for (const Row& row : table) {
        const bool named = std::find(names.begin(), names.end(), row.name) != names.end();
        if (all_wanted || named || (names.empty() && row.standard)) {
            chosen.push_back(&row);
        }
    }
    return chosen;
}

}  // namespace dollytrack::render
