#include "engine/document/change_descriptions.h"

#include "engine/document/operation_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

// Writing and reading, or turning and turning back, changes values by rounding errors.
constexpr double kSameLength_m = 1e-6;
constexpr double kSameAngle = 1e-6;

}  // namespace

std::string_view changeOf(const Pose& before, const Pose& after) {
    const bool moved = (before.position - after.position).norm() > kSameLength_m;
    const bool turned = before.rotation.angularDistance(after.rotation) > kSameAngle;
    if (moved && turned) return "Move and turn";
    return turned ? "Turn" : "Move";
}

std::string_view changeOf(const OrientedBox& before, const OrientedBox& after) {
    const bool moved = (before.center - after.center).norm() > kSameLength_m;
    const bool resized = (before.half_size - after.half_size).norm() > kSameLength_m;
    const bool turned = std::abs(before.yaw - after.yaw) > kSameAngle;
    if (resized) return turned ? "Resize and turn" : "Resize";
    if (moved && turned) return "Move and turn";
    return turned ? "Turn" : "Move";
}

std::string describeObjects(const std::vector<ObjectRef>& objects) {
    // Limits the length of a line in the history and its tooltip.
    constexpr std::size_t kMost = 8;
    std::string words;
    const std::size_t named = objects.size() <= kMost + 1 ? objects.size() : kMost;
    for (std::size_t i = 0; i < named; ++i) {
        if (i > 0) words += i + 1 == objects.size() ? " and " : ", ";
        words += objects[i].name;
    }
    if (named < objects.size()) words += fmt::format(" and {} more", objects.size() - named);
    return words;
}

std::string describeView(const PinnedPoint& point) {
    if (point.objects.empty()) return point.name;
    const bool named_after_objects = point.name == inWords(point.objects);
    return "the pinned view " +
           (named_after_objects ? "of " + describeObjects(point.objects) : point.name);
}

}  // namespace dollytrack
