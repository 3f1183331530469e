#include "planning/repair/look_aside.h"

#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/image_boxes.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kReach_m = 5.0;
constexpr std::size_t kTargetsTried = 16;
constexpr double kMostDetour = 0.5 * std::numbers::pi;  // rad, turning in addition to that without
                                                        // the view
constexpr double kDetourCost = 0.2;                     // score per radian

/// Centres of the targets nearest to a position.
std::vector<Eigen::Vector3d> nearestTargets(const Scene& scene, const Eigen::Vector3d& place) {
    std::vector<std::pair<double, const Object*>> near;
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        const double distance = (object.centroid - place).norm();
        if (distance < kReach_m) near.emplace_back(distance, &object);
    }
    const auto count = std::min(kTargetsTried, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
                      [](const auto& a, const auto& b) {
                          return std::pair(a.first, a.second->id) <
                                 std::pair(b.first, b.second->id);
                      });
    std::vector<Eigen::Vector3d> centers;
    for (std::size_t i = 0; i < count; ++i) centers.push_back(near[i].second->centroid);
    return centers;
}

/// Score of an image with these boxes in the run, after the frames before it.
double scoreWithin(const Trajectory& trajectory,
                   const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes, const LowRun& run,
                   std::vector<Eigen::AlignedBox2d> shown, const ScoreWeights& weights) {
    Trajectory part;
    std::vector<std::vector<Eigen::AlignedBox2d>> shows;
    const std::size_t before = std::min(run.first, static_cast<std::size_t>(weights.window));
    for (std::size_t i = run.first - before; i < run.first; ++i) {
        part.frames.push_back(trajectory.frames[i]);
        shows.push_back(boxes[i]);
    }
    part.frames.push_back(trajectory.frames[run.first]);
    shows.push_back(std::move(shown));
    return imageScores(part, shows, weights).back();
}

/// Index of the key frame at which a segment starts; keys.size() if there is none.
std::size_t firstKeyOf(const SmoothPath& path, std::size_t segment) {
    std::size_t met = 0;
    for (std::size_t i = 0; i < path.keys.size(); ++i) {
        if (path.keys[i].position_point >= 0 && met++ == segment) return i;
    }
    return path.keys.size();
}

}  // namespace

std::optional<Eigen::Vector3d> findLookAside(
    const RepairContext& context, const Trajectory& trajectory,
    const std::vector<std::vector<Eigen::AlignedBox2d>>& boxes, const LowRun& run) {
    const PlanningEnvironment& environment = context.environment;
    const auto& frames = trajectory.frames;
    const TrajectoryFrame& middle = frames[run.first + (run.last - run.first) / 2];
    const Pose& before = frames[run.first > 0 ? run.first - 1 : run.first].pose;
    const Pose& after = frames[std::min(run.last + 1, frames.size() - 1)].pose;
    const double turn = angleBetween(before.rotation, after.rotation);
    const Eigen::Vector3d& place = middle.pose.position;
    std::optional<Eigen::Vector3d> best;
    double best_worth = 0.0;
    for (const Eigen::Vector3d& center : nearestTargets(environment.views.scene(), place)) {
        if ((center - place).norm() < environment.views.nearDistance()) continue;
        const Pose pose = aim(place, center, environment.pitch);
        const double detour = angleBetween(before.rotation, pose.rotation) +
                              angleBetween(pose.rotation, after.rotation) - turn;
        if (detour > kMostDetour) continue;
        const double score = scoreWithin(trajectory, boxes, run,
                                         imageBoxes(environment.views, pose), context.weights);
        if (score < context.threshold) continue;
        const double worth = score - kDetourCost * detour;
        if (best && worth <= best_worth) continue;
        best = place + (center - place).norm() * pose.forward();
        best_worth = worth;
    }
    return best;
}

std::vector<SmoothPath> withLookAsides(std::vector<SmoothPath> paths,
                                       const std::vector<LookAside>& look_asides) {
    std::vector<LookAside> ordered = look_asides;
    std::stable_sort(ordered.begin(), ordered.end(), [](const LookAside& a, const LookAside& b) {
        return std::pair(a.segment, a.share) < std::pair(b.segment, b.share);
    });
    for (const LookAside& look_aside : ordered) {
        SmoothPath& path = paths[look_aside.segment.path];
        const std::size_t from = firstKeyOf(path, look_aside.segment.number);
        const std::size_t to = firstKeyOf(path, look_aside.segment.number + 1);
        if (to >= path.keys.size()) continue;
        const double begin = path.keys[from].arc_m;
        const double end = path.keys[to].arc_m;
        SmoothPath::Key key;
        key.arc_m = begin + look_aside.share * (end - begin);
        key.position = end > begin ? path.at(key.arc_m) : path.keys[from].position;
        key.looks_at = look_aside.looks_at;
        // Insert after earlier look-aside views of the segment.
        path.keys.insert(path.keys.begin() + static_cast<std::ptrdiff_t>(to), key);
    }
    return paths;
}

}  // namespace dollytrack::planning
