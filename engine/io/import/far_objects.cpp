#include "engine/io/import/far_objects.h"

#include "engine/core/text_lists.h"
#include "engine/io/import/redundant_parts.h"
#include "engine/math/quantile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace dollytrack {
namespace {

constexpr double kLeastDistance_m = 500.0;
constexpr double kLeastSizes = 20.0;  // radii of the rest

/// An object as seen from the middle of the scene.
struct Remote {
    const ObjectDraft* draft;
    Eigen::AlignedBox3d box;  // m
    double near = 0.0;        // distance of its nearest point
    double far = 0.0;         // of its farthest corner
};

/// The median of the boxes' centres on each axis, which a few distant boxes cannot move far.
Eigen::Vector3d middleOf(const std::vector<Remote>& objects) {
    Eigen::Vector3d middle;
    std::vector<double> along(objects.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < objects.size(); ++i) along[i] = objects[i].box.center()[axis];
        middle[axis] = upperMedian(along);
    }
    return middle;
}

/// Sorts the objects by distance and returns the number of those that belong together.
std::size_t sortByDistance(std::vector<Remote>& objects) {
    const Eigen::Vector3d middle = middleOf(objects);
    for (Remote& object : objects) {
        object.near = object.box.exteriorDistance(middle);
        const Eigen::Vector3d farthest =
            (object.box.max() - middle).cwiseAbs().cwiseMax((object.box.min() - middle).cwiseAbs());
        object.far = farthest.norm();
    }
    std::ranges::stable_sort(objects, {}, &Remote::near);
    double radius = 0.0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const double least = std::max(kLeastDistance_m, kLeastSizes * radius);
        if (i > 0 && objects[i].near - radius > least) return i;
        radius = std::max(radius, objects[i].far);
    }
    return objects.size();
}

std::string distanceText(double metres) {
    constexpr double kKilometre_m = 1000.0;
    return metres < 10.0 * kKilometre_m ? fmt::format("{:.0f} m", metres)
                                        : fmt::format("{:.0f} km", metres / kKilometre_m);
}

}  // namespace

bool dropFarObjects(RawScene& raw, double unit_m, std::vector<ObjectDraft>& annotated,
                    std::vector<ObjectDraft>& drafts, ImportReport& report) {
    std::vector<Remote> objects;
    for (const auto* list : {&annotated, &drafts}) {
        for (const ObjectDraft& draft : *list) {
            const Eigen::AlignedBox3d box = boundsOf(raw, draft).cast<double>();
            if (box.isEmpty()) continue;
            objects.push_back({&draft, {unit_m * box.min(), unit_m * box.max()}});
        }
    }
    if (objects.empty()) return false;
    const std::size_t together = sortByDistance(objects);
    const std::size_t far = objects.size() - together;
    if (far == 0 || 3 * far >= objects.size()) return false;
    const auto end = objects.begin() + static_cast<std::ptrdiff_t>(together);
    const double radius = std::ranges::max_element(objects.begin(), end, {}, &Remote::far)->far;
    std::vector<std::string> names;
    for (std::size_t i = together; i < objects.size(); ++i) {
        names.push_back(
            fmt::format("{} ({})", objects[i].draft->name, distanceText(objects[i].near - radius)));
        for (const std::size_t part : objects[i].draft->parts) emptyPart(raw.parts[part]);
    }
    const auto isEmpty = [&](const ObjectDraft& draft) {
        return std::ranges::all_of(
            draft.parts, [&](std::size_t part) { return raw.parts[part].triangles.empty(); });
    };
    std::erase_if(annotated, isEmpty);
    std::erase_if(drafts, isEmpty);
    report.warnings.push_back(counted(far, "object lies far away from all others and is left out",
                                      "objects lie far away from all others and are left out") +
                              ": " + listOf(names, 6) +
                              "; to keep such objects, move them in the scene's file");
    return true;
}

}  // namespace dollytrack
