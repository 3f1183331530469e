#include "engine/document/target_filter.h"

#include "engine/core/field_list.h"
#include "engine/core/name_pattern.h"
#include "engine/scene/class_table.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack {
namespace {

bool isNamedByAny(const Object& object, const std::vector<std::string>& patterns) {
    return std::ranges::any_of(patterns,
                               [&](const auto& pattern) { return isNamedBy(object, pattern); });
}

void warnOfStrays(Scene& scene, const char* list, const std::vector<std::string>& patterns) {
    for (const std::string& pattern : patterns) {
        const auto named = [&](const Object& object) { return isNamedBy(object, pattern); };
        // A class that the scene does not have is not an error.
        if (isClassName(scene, pattern) || std::ranges::any_of(scene.objects, named)) continue;
        std::vector<std::string> names;
        for (int i = 1; i <= kNyu40Count; ++i) names.emplace_back(nyu40Name(i));
        if (scene.class_table) {
            for (const DatasetClass& one : scene.classes().classes()) names.push_back(one.name);
        }
        for (const Object& object : scene.objects) names.push_back(object.name);
        const std::string close = closestName(pattern, names);
        scene.report.warnings.push_back(
            fmt::format("{} '{}' is neither a class nor an object{}", list, pattern,
                        close.empty() ? "" : fmt::format("; did you mean '{}'?", close)));
    }
}

/// If the lists leave no targets, warns which list is the reason. `left_out`: ids of the objects
/// they excluded.
void warnOfNothingLeft(Scene& scene, const std::vector<int>& left_out, const SceneEdits& edits) {
    // Changes of single objects are applied after the lists.
    const auto included = [](const ObjectChange& change) { return change.role == Role::Target; };
    if (std::ranges::any_of(edits.changes, included)) return;
    const auto isTarget = [](const Object& object) { return object.role == Role::Target; };
    if (left_out.empty() || std::ranges::any_of(scene.objects, isTarget)) return;
    const bool only_names_some = edits.only.empty() || std::ranges::any_of(left_out, [&](int id) {
                                     return isNamedByAny(scene.object(id), edits.only);
                                 });
    scene.report.warnings.push_back(
        only_names_some
            ? std::string(edits.only.empty()
                              ? "ignore excludes every target; nothing is left to capture"
                              : "ignore excludes everything in only; nothing is left to capture")
            : fmt::format("only '{}' matches no target of this scene; nothing is left to capture",
                          fmt::join(edits.only, "', '")));
}

}  // namespace

bool isNamedBy(const Object& object, std::string_view pattern) {
    const int nyu40 = nyu40FromName(pattern);
    if (nyu40 != 0 && nyu40 == object.nyu40) return true;
    const std::string wanted = inSmallLetters(pattern);
    if (object.nyu40 == 0 && wanted == kWithoutClass) return true;
    if (object.dataset_class && fitsPattern(wanted, inSmallLetters(object.dataset_class->name))) {
        return true;
    }
    return fitsPattern(wanted, inSmallLetters(object.name)) ||
           (object.nyu40 != 0 && fitsPattern(wanted, inSmallLetters(nyu40Name(object.nyu40))));
}

bool isClassName(const Scene& scene, std::string_view pattern) {
    const std::string wanted = inSmallLetters(pattern);
    if (nyu40FromName(pattern) != 0 || wanted == kWithoutClass) return true;
    return scene.class_table &&
           std::ranges::any_of(scene.classes().classes(), [&](const DatasetClass& one) {
               return inSmallLetters(one.name) == wanted;
           });
}

bool isFilteredOut(const Object& object, const SceneEdits& edits) {
    return isNamedByAny(object, edits.ignore) ||
           (!edits.only.empty() && !isNamedByAny(object, edits.only));
}

void filterTargets(Scene& scene, const SceneEdits& edits) {
    std::vector<int> left_out;
    const std::size_t warned = scene.report.warnings.size();
    for (Object& object : scene.objects) {
        if (object.role == Role::Target && isFilteredOut(object, edits)) {
            object.role = Role::Excluded;
            left_out.push_back(object.id);
        }
    }
    warnOfStrays(scene, "ignore", edits.ignore);
    warnOfStrays(scene, "only", edits.only);
    if (scene.report.warnings.size() == warned) warnOfNothingLeft(scene, left_out, edits);
}

}  // namespace dollytrack
