#include "engine/document/target_filter.h"

#include "engine/core/field_list.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace dollytrack {
namespace {

std::string inSmallLetters(std::string_view text) {
    std::string small(text);
    std::ranges::transform(small, small.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

/// Keeps the last `*` and what it stood for, to let it stand for one character more.
bool matches(std::string_view pattern, std::string_view text) {
    std::size_t p = 0;
    std::size_t t = 0;
    std::size_t star = std::string_view::npos;
    std::size_t after_star = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            after_star = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++after_star;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool isNamedByAny(const Object& object, const std::vector<std::string>& patterns) {
    return std::ranges::any_of(patterns,
                               [&](const auto& pattern) { return isNamedBy(object, pattern); });
}

void warnOfStrays(Scene& scene, const char* list, const std::vector<std::string>& patterns) {
    for (const std::string& pattern : patterns) {
        const auto named = [&](const Object& object) { return isNamedBy(object, pattern); };
        // A class that this scene happens to lack is no slip.
        if (nyu40FromName(pattern) != 0 || std::ranges::any_of(scene.objects, named)) continue;
        std::vector<std::string> names;
        for (int i = 1; i <= kNyu40Count; ++i) names.emplace_back(nyu40Name(i));
        for (const Object& object : scene.objects) names.push_back(object.name);
        const std::string close = closestName(pattern, names);
        scene.report.warnings.push_back(
            fmt::format("{} '{}' names no class and no object{}", list, pattern,
                        close.empty() ? "" : fmt::format("; did you mean '{}'?", close)));
    }
}

}  // namespace

bool isNamedBy(const Object& object, std::string_view pattern) {
    const int nyu40 = nyu40FromName(pattern);
    if (nyu40 != 0 && nyu40 == object.nyu40) return true;
    const std::string wanted = inSmallLetters(pattern);
    return matches(wanted, inSmallLetters(object.name)) ||
           (object.nyu40 != 0 && matches(wanted, inSmallLetters(nyu40Name(object.nyu40))));
}

bool isFilteredOut(const Object& object, const SceneEdits& edits) {
    return isNamedByAny(object, edits.ignore) ||
           (!edits.only.empty() && !isNamedByAny(object, edits.only));
}

void filterTargets(Scene& scene, const SceneEdits& edits) {
    for (Object& object : scene.objects) {
        if (object.role == Role::Target && isFilteredOut(object, edits)) {
            object.role = Role::Excluded;
        }
    }
    warnOfStrays(scene, "ignore", edits.ignore);
    warnOfStrays(scene, "only", edits.only);
}

}  // namespace dollytrack
