#include "planning/baselines/best_view.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/baselines/delaunay.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kHeight = 1.2;  // m above the floor
constexpr int kViews = 5;        // per scene
constexpr double kApart = 1.0;   // m
constexpr int kHeadings = 24;
constexpr int kRaysPerTurn = 360;

struct BestView {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double yaw = 0.0;
    double area_m2 = 0.0;
};

/// Height of the floor below the room's position of largest clearance, m.
double floorOf(const MappedScene& scene, const Room& room) {
    const RayHit hit = scene.rays->cast(room.sample, -Eigen::Vector3d::UnitZ());
    const double by_box = room.box.min().z();
    return hit.object_id != 0 ? std::min(by_box, room.sample.z() - hit.distance) : by_box;
}

std::vector<Eigen::Vector3d> candidatePlaces(const MappedScene& scene, const Room& room) {
    std::vector<Eigen::Vector2d> corners;
    for (const double x : {room.box.min().x(), room.box.max().x()}) {
        for (const double y : {room.box.min().y(), room.box.max().y()}) corners.emplace_back(x, y);
    }
    for (const Object& object : scene.scene->objects) {
        if (object.structure || !room.box.intersects(Eigen::AlignedBox3d(object.box.center))) {
            continue;
        }
        const auto box = object.box.corners();
        for (const Eigen::Vector3d& corner : box) {
            if (corner.z() < object.box.center.z()) corners.emplace_back(corner.head<2>());
        }
    }
    const double z = floorOf(scene, room) + kHeight;
    std::vector<Eigen::Vector3d> places;
    for (const auto& triangle : delaunay(corners)) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (const int i : triangle) middle += corners[i] / 3.0;
        const Eigen::Vector3d place(middle.x(), middle.y(), z);
        if (scene.free_space->componentAt(place) == room.component && scene.sphere->fits(place)) {
            places.push_back(place);
        }
    }
    return places;
}

/// Distance from a position in the room's box to its side, which stands for the wall: air outside
/// windows and doors is not part of the plan.
double reachInside(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& place,
                   const Eigen::Vector3d& ray) {
    double reach = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
        const double side = ray[axis] > 0.0 ? box.max()[axis] : box.min()[axis];
        if (std::abs(ray[axis]) < 1e-9) continue;
        reach = std::min(reach, (side - place[axis]) / ray[axis]);
    }
    return std::max(0.0, reach);
}

/// The heading with the largest visible area of the plan, at the camera's height.
BestView bestHeading(const MappedScene& scene, const Room& room, const Eigen::Vector3d& place,
                     double hfov) {
    std::array<double, kRaysPerTurn> slices{};  // m2 each
    constexpr double kSlice = 2.0 * std::numbers::pi / kRaysPerTurn;
    for (int i = 0; i < kRaysPerTurn; ++i) {
        const double yaw = (i + 0.5) * kSlice;
        const Eigen::Vector3d ray(std::cos(yaw), std::sin(yaw), 0.0);
        const double to_side = reachInside(room.box, place, ray);
        const RayHit hit = scene.rays->cast(place, ray, to_side);
        const double reach = hit.object_id != 0 ? hit.distance : to_side;
        slices[i] = 0.5 * reach * reach * kSlice;
    }
    const int wedge = std::max(1, static_cast<int>(std::lround(hfov / kSlice)));
    BestView best{place, 0.0, -1.0};
    for (int h = 0; h < kHeadings; ++h) {
        const int middle = h * kRaysPerTurn / kHeadings;
        double area = 0.0;
        for (int i = 0; i < wedge; ++i) {
            const int slice = (middle - wedge / 2 + i + kRaysPerTurn) % kRaysPerTurn;
            area += slices[slice];
        }
        if (area > best.area_m2) best = {place, middle * kSlice, area};
    }
    return best;
}

std::vector<BestView> bestViews(const MappedScene& scene, const Room& room, int count,
                                double hfov) {
    std::vector<Eigen::Vector3d> places = candidatePlaces(scene, room);
    if (places.empty()) places.push_back(room.sample);
    std::vector<BestView> views(places.size());
    parallelFor(places.size(),
                [&](std::size_t i) { views[i] = bestHeading(scene, room, places[i], hfov); });
    std::stable_sort(views.begin(), views.end(),
                     [](const BestView& a, const BestView& b) { return a.area_m2 > b.area_m2; });
    std::vector<BestView> chosen;
    for (const BestView& view : views) {
        const bool near = std::any_of(chosen.begin(), chosen.end(), [&](const BestView& other) {
            return (other.place - view.place).norm() < kApart;
        });
        if (!near && static_cast<int>(chosen.size()) < count) chosen.push_back(view);
    }
    return chosen;
}

}  // namespace

Result<PlannedMotion> planBestView(const MappedScene& scene, const PlanParams& params, int /*seed*/,
                                   const JobContext& job) {
    PlannedMotion motion;
    motion.trajectory.frame_interval_s = 1.0 / params.timing.frame_rate;
    auto& frames = motion.trajectory.frames;
    const auto& rooms = scene.free_space->rooms();
    const int extra = std::max(0, kViews - static_cast<int>(rooms.size()));
    const std::vector<int> shares = shareByRoom(scene, extra, 0);
    const double hfov = params.camera.hfov_deg * std::numbers::pi / 180.0;
    for (std::size_t room = 0; room < rooms.size(); ++room) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        for (const BestView& view : bestViews(scene, rooms[room], 1 + shares[room], hfov)) {
            if (static_cast<int>(frames.size()) == frameBudget(params)) break;
            TrajectoryFrame frame;
            frame.time_s = static_cast<double>(frames.size()) * motion.trajectory.frame_interval_s;
            frame.path = static_cast<int>(frames.size());  // no motion between frames
            frame.component = static_cast<int>(room);
            frame.target_in_world =
                view.place + Eigen::Vector3d(std::cos(view.yaw), std::sin(view.yaw), 0.0);
            frame.pose = lookAt(view.place, frame.target_in_world);
            frames.push_back(frame);
        }
    }
    return motion;
}

}  // namespace dollytrack::planning
