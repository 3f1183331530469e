#include "planning/motions/motion_check.h"

#include "planning/collision/mapped_scene.h"
#include "planning/collision/path_clearance.h"
#include "planning/free_space/free_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace dollytrack::planning {
namespace {

// SweptSphere counts a clearance of less than this beyond the radius as contact.
constexpr double kContactMargin = 0.001;

}  // namespace

MotionCheck::MotionCheck(const MappedScene& scene)
    : scene_(scene),
      touching_(*scene.rays, *scene.free_space, scene.sphere->radius() - kContactMargin,
                scene.region.get()) {}

bool MotionCheck::isFree(const Eigen::Vector3d& position) const {
    return isFree(position, position);
}

bool MotionCheck::isFree(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    if (scene_.sphere->segment(from, to).free) return true;
    const double radius = scene_.sphere->radius();
    return touching_.segment(from, to).free &&
           smallestClearance(*scene_.rays, {from, to}, radius, {}) >= radius;
}

int MotionCheck::componentOf(const Eigen::Vector3d& position) const {
    const FreeSpace& free_space = *scene_.free_space;
    const int here = free_space.componentAt(position);
    if (here >= 0) return here;
    for (int i = 0; i < 27; ++i) {
        const Eigen::Vector3d step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        const Eigen::Vector3d beside = position + free_space.resolution_m() * step;
        const int component = free_space.componentAt(beside);
        if (component >= 0 && scene_.sphere->segment(position, beside).free) return component;
    }
    return -1;
}

std::string whyNotFree(const MappedScene& scene, const Eigen::Vector3d& position) {
    int object_id = 0;
    switch (scene.sphere->verdict(position, object_id)) {
        case Verdict::NoGo:
            return "is in a no-go box";
        case Verdict::HeightBand:
            return "is outside the camera's limits of height";
        case Verdict::OutsideRoom:
            return "is outside the rooms";
        default:
            return object_id > 0 ? fmt::format("is in or too close to '{}'",
                                               scene.scene->object(object_id).name)
                                 : std::string("is in or too close to an obstacle");
    }
}

std::optional<Eigen::Vector3d> nearestFree(const MappedScene& scene,
                                           const Eigen::Vector3d& position) {
    std::vector<std::pair<float, const Eigen::Vector3f*>> by_distance;
    const Eigen::Vector3f from = position.cast<float>();
    for (std::size_t room = 0; room < scene.free_space->rooms().size(); ++room) {
        for (const Eigen::Vector3f& cell : scene.sphere->cells(static_cast<int>(room))) {
            by_distance.emplace_back((cell - from).squaredNorm(), &cell);
        }
    }
    // The exact test is costly, and one of the first cells passes it: a heap sorts only those.
    std::ranges::make_heap(by_distance, std::greater());
    while (!by_distance.empty()) {
        const Eigen::Vector3d place = by_distance.front().second->cast<double>();
        if (scene.sphere->fits(place)) return place;
        std::ranges::pop_heap(by_distance, std::greater());
        by_distance.pop_back();
    }
    return std::nullopt;
}

}  // namespace dollytrack::planning
