#include "planning/motions/camera_moves.h"

#include "engine/core/name_hint.h"
#include "engine/document/target_filter.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/floor_heights.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/motion_check.h"
#include "planning/motions/object_moves.h"
#include "planning/motions/time_path.h"
#include "planning/motions/walked_rooms.h"
#include "planning/rooms/room_plan.h"
#include "planning/timing/motion_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace dollytrack::planning {
namespace {

using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

constexpr double kFill = 0.5;         // share of the image's width or height that an object takes
constexpr double kDollyStart = 0.25;  // the same where a dolly starts
constexpr double kWalkHeight = 1.5;   // above the floor, m
constexpr double kRoomMiddle = 1.2;   // height above the floor of a room's point to look at, m
constexpr double kAround = 0.3;       // the floor is looked for this far around an object, m
constexpr double kAboveRugs = 0.1;    // added to an object's middle: a rug is above its floor, m
constexpr double kRoomShare = 0.35;   // radius of an orbit in a room, as a share of its width
constexpr double kFull = 0.85;        // largest share of the image that an orbited object takes
constexpr double kSameRadius = 0.95;  // a smaller share of the wanted radius is reported
constexpr double kSameHeight = 0.02;  // a larger difference in height is reported, m
constexpr double kWholeArc = 0.97;    // a smaller share of the wanted arc is reported
constexpr double kLookAhead = 0.6;    // of a walk: the camera looks at a point this far along it, m
constexpr double kPositionsFound = 0.2;  // progress when the positions of a move are known
constexpr double kRadians = std::numbers::pi / 180.0;

/// The object that the move is about: the largest one that the option `target` names, else that of
/// `object_id`; null: none is named.
Result<const Object*> targetOf(const Scene& scene, const MoveRequest& request) {
    const auto named = request.options.find("target");
    if (named == request.options.end()) {
        return request.object_id ? &scene.object(*request.object_id) : nullptr;
    }
    const Object* largest = nullptr;
    std::vector<std::string> names;
    for (const Object& object : scene.objects) {
        names.push_back(object.name);
        if (!isNamedBy(object, named->second)) continue;
        if (!largest || object.box.volume() > largest->box.volume()) largest = &object;
    }
    if (largest) return largest;
    return fail(ErrorCode::BadInput,
                fmt::format("No object has the name or class '{}'{}", named->second,
                            nameHint(named->second, names)),
                "target");
}

/// Frames along the positions, without times unless `time_s`.
Trajectory trajectoryThrough(const Positions& positions, double time_s) {
    double length = 0.0;
    for (std::size_t i = 1; i < positions.size(); ++i) {
        length += (positions[i] - positions[i - 1]).norm();
    }
    Trajectory trajectory;
    double walked = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (i > 0) walked += (positions[i] - positions[i - 1]).norm();
        TrajectoryFrame frame;
        frame.pose.position = positions[i];
        frame.time_s = length > 0.0 ? time_s * walked / length : 0.0;
        trajectory.frames.push_back(frame);
    }
    return trajectory;
}

/// Points at most kMoveSpacing apart along the polyline.
Positions divided(const Positions& corners) {
    Positions points = {corners.front()};
    for (std::size_t i = 1; i < corners.size(); ++i) {
        const Vector3d move = corners[i] - corners[i - 1];
        const double parts = std::max(1.0, std::ceil(move.norm() / kMoveSpacing));
        for (double k = 1.0; k <= parts; k += 1.0)
            points.push_back(corners[i - 1] + k / parts * move);
    }
    return points;
}

/// Turns each frame towards the motion ahead.
void lookAhead(Trajectory& trajectory) {
    auto& frames = trajectory.frames;
    Vector3d direction = Vector3d::UnitX();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        std::size_t ahead = i;
        double walked = 0.0;
        while (ahead + 1 < frames.size() && frames[ahead + 1].path == frames[i].path &&
               walked < kLookAhead) {
            walked += (frames[ahead + 1].pose.position - frames[ahead].pose.position).norm();
            ++ahead;
        }
        Vector3d way = frames[ahead].pose.position - frames[i].pose.position;
        way.z() = 0.0;
        if (walked >= 0.5 * kLookAhead && way.norm() > 0.1 * kLookAhead) direction = way;
        frames[i].pose.rotation = lookAlong(direction);
        frames[i].target_in_world = frames[i].pose.position + direction;
    }
}

/// A radius and a height to try for an orbit.
struct OrbitShape {
    double radius_m = 0.0;
    double z = 0.0;     // of the camera, in the world, m
    double cost = 0.0;  // 0..1: how much it differs from the shape that was asked for
};

/// The shapes to try, most similar to the given one first. Reduced radii are at least `least_m`,
/// the distance at which the object fills the image.
std::vector<OrbitShape> orbitShapes(double radius_m, double z, double least_m) {
    constexpr std::array kRadii = {1.0, 0.8, 0.6, 0.4, 0.25};
    constexpr std::array kHeights_m = {0.0, 0.3, 0.6, -0.3, 1.0, -0.6};
    std::vector<OrbitShape> shapes;
    for (const double factor : kRadii) {
        if (factor < 1.0 && factor * radius_m < least_m) break;
        for (const double higher : kHeights_m) {
            const double cost = 0.5 * (1.0 - factor) + 0.2 * std::abs(higher);
            shapes.push_back({factor * radius_m, z + higher, cost});
        }
    }
    std::ranges::stable_sort(shapes, {}, &OrbitShape::cost);
    return shapes;
}

class MoveMaker {
  public:
    MoveMaker(const MappedScene& scene, const PlanParams& params, const MoveRequest& request,
              const JobContext& job)
        : scene_(scene), request_(request), job_(job) {
        timing_.limits = motionLimits(params.timing);
        timing_.frame_interval_s = timing_.smooth_over_s = 1.0 / params.timing.frame_rate;
        timing_.retime_all = true;
    }

    Result<CameraMove> make() {
        auto values = readMove(request_);
        if (!values) return tl::unexpected(std::move(values.error()));
        values_ = std::move(*values);
        const auto from = values_.point("from");
        const auto to = values_.point("to");
        if (from.has_value() != to.has_value()) {
            return fail(ErrorCode::Usage, "A move between two points needs both.", "from, to");
        }
        if (from && (*to - *from).norm() < kMoveSpacing) {
            return fail(ErrorCode::Usage, "The two points are the same.", "from, to");
        }
        floors_.emplace(*scene_.scene, *scene_.rays, *scene_.free_space, scene_.sphere->radius());
        floor_ = walkedFloor(scene_, *floors_, kWalkHeight);
        if (job_.cancelled()) return cancelled();
        if (request_.kind == "walk") return walk(from, to);
        std::optional<Vector3d> look_at;
        Positions positions;
        if (from) {
            positions = divided({*from, *to});
            look_at = *to + (*to - *from).normalized();
        }
        const bool names_one =
            request_.options.contains("target") || values_.point("center").has_value();
        if (!from || names_one) {
            const auto moves = subject();
            if (!moves) return tl::unexpected(moves.error());
            look_at = moves->center();
            if (!from) positions = around(*moves);
            if (job_.cancelled()) return cancelled();
            if (positions.empty()) {
                return fail(ErrorCode::BadInput,
                            fmt::format("There is no free space for this move around {}; "
                                        "change its settings, or choose another object.",
                                        subject_name_),
                            request_.kind);
            }
        }
        timing_.look_at = look_at;
        return finished(repairAndTime(scene_, timing_,
                                      trajectoryThrough(positions, values_.number("time", 0.0)),
                                      job_.stage(kPositionsFound, 1.0, request_.kind)));
    }

  private:
    /// The subject of the move: an object, a point, or the middle of the largest room.
    [[nodiscard]] Result<ObjectMoves> subject() {
        const auto target = targetOf(*scene_.scene, request_);
        if (!target) return tl::unexpected(target.error());
        const auto center = values_.point("center");
        if (center && request_.options.contains("target")) {
            return fail(ErrorCode::Usage, "Give an object or a point to look at, not both.",
                        "target, center");
        }
        if (*target && !center) {
            subject_name_ = "'" + (*target)->name + "'";
            floor_ = floorAround((*target)->box);
            return ObjectMoves(scene_, **target);
        }
        subject_name_ = center ? "this point" : "the middle of the room";
        if (center) floor_ = floors_->below(*center);
        const RoomPlan plan(*scene_.scene, *scene_.rays, *scene_.free_space,
                            scene_.sphere->radius());
        const auto room = center ? static_cast<std::size_t>(plan.roomAt(*center)) : 0;
        const Eigen::AlignedBox3d box =
            plan.rooms().empty() ? scene_.free_space->rooms().front().box : plan.rooms()[room].box;
        const double reach = std::max(0.4, kRoomShare * box.sizes().head<2>().minCoeff());
        Vector3d middle = box.center();
        middle.z() = floor_ + kRoomMiddle;
        return ObjectMoves(scene_, center.value_or(middle), reach);
    }

    /// The floor that an object stands on or hangs over: the most common level around it. Floors
    /// often have holes under objects.
    [[nodiscard]] double floorAround(const OrientedBox& object) const {
        Eigen::AlignedBox3d around;
        for (const Vector3d& corner : object.corners()) around.extend(corner);
        const Eigen::Vector2d low = around.min().head<2>().array() - kAround;
        const Eigen::Vector2d high = around.max().head<2>().array() + kAround;
        constexpr double kMostSteps = 200.0;  // along x or y, for an object as large as a terrain
        const double step = std::max(floors_->grid().cell_m, (high - low).maxCoeff() / kMostSteps);
        std::vector<double> heights;
        for (double x = low.x(); x <= high.x(); x += step) {
            for (double y = low.y(); y <= high.y(); y += step) {
                heights.push_back(floors_->below(Vector3d(x, y, object.center.z() + kAboveRugs)));
            }
        }
        return commonLevel(std::move(heights), 1.0);
    }

    /// A given height above the floor as z in the world.
    [[nodiscard]] double heightOr(const std::string& name, double z) const {
        return values_.has(name) ? floor_ + values_.number(name, 0.0) : z;
    }

    [[nodiscard]] Positions around(const ObjectMoves& moves) {
        const double near = moves.distanceFor(kFill);
        const double radius = values_.number("radius", near);
        if (request_.kind == "dolly") {
            const double start = std::max(near + 0.2, moves.distanceFor(kDollyStart));
            const double first =
                values_.has("distance") ? near + values_.number("distance", 0.0) : start;
            return straightAround(moves, near, first, moves.center().z() + 0.25 * near);
        }
        if (request_.kind == "crane") return craneBeside(moves, radius);
        return orbitAround(moves, radius, heightOr("height", moves.center().z() + 0.25 * radius));
    }

    [[nodiscard]] static Positions straightAround(const ObjectMoves& moves, double near,
                                                  double first, double level) {
        for (const double share : {1.0, 0.75, 0.5, 0.35}) {
            for (const double higher : {0.0, 0.4, 0.8}) {
                const double from = near + share * (first - near);
                const double z = level + higher;
                const Positions ends = moves.straight(from, z, near, z);
                if (!ends.empty()) return divided(ends);
            }
        }
        return {};
    }

    [[nodiscard]] Positions craneBeside(const ObjectMoves& moves, double radius) const {
        const double low = heightOr("from_height", floor_ + 0.5);
        const double high = heightOr("to_height", floor_ + 2.0);
        for (const double share : {1.0, 0.8, 0.6, 0.4}) {  // of the height; the upper end stays
            for (const double factor : kDistanceFactors) {
                const double from = high + share * (low - high);
                const Positions ends = moves.straight(factor * radius, from, factor * radius, high);
                if (!ends.empty()) return divided(ends);
            }
        }
        return {};
    }

    /// The best orbit among shapes near the one asked for. A long arc with a smaller radius or
    /// another height is better than a short arc.
    [[nodiscard]] Positions orbitAround(const ObjectMoves& moves, double radius, double z) {
        const double arc_deg = values_.number("arc", request_.kind == "arc" ? 90.0 : 360.0);
        const std::vector<OrbitShape> shapes = orbitShapes(radius, z, moves.distanceFor(kFull));
        Orbit best;
        double best_score = -1.0;
        double best_radius = radius;
        for (std::size_t i = 0; i < shapes.size() && best_score < 1.0 - shapes[i].cost; ++i) {
            const double part = kPositionsFound / static_cast<double>(shapes.size());
            const double before = part * static_cast<double>(i);
            Orbit orbit = moves.orbit(shapes[i].radius_m, shapes[i].z, arc_deg * kRadians,
                                      job_.stage(before, before + part, request_.kind));
            if (job_.cancelled()) return {};
            const double score = orbit.share - shapes[i].cost;
            if (orbit.positions.empty() || score <= best_score) continue;
            best_score = score;
            best_radius = shapes[i].radius_m;
            best = std::move(orbit);
        }
        if (best.positions.empty()) return {};
        moves.smoothRadius(best, best_radius, job_);
        std::string changes;
        double nearest = radius;
        for (const Vector3d& position : best.positions) {
            const double here = (position - moves.center()).head<2>().norm();
            nearest = std::min(nearest, here);
        }
        if (nearest < kSameRadius * radius) {
            changes += fmt::format(" a radius down to {:.2f} m,", nearest);
        }
        const double reached_z = best.positions.front().z();
        if (std::abs(reached_z - z) > kSameHeight) {
            changes += fmt::format(" a height of {:.2f} m,", reached_z - floor_);
        }
        if (best.share < kWholeArc) {
            changes += fmt::format(" an arc of {:.0f}\u00b0,", best.share * arc_deg);
        }
        if (!changes.empty()) {
            changes.pop_back();
            note_ = "Because of obstacles and limits, the orbit has" + changes + ".";
        }
        return std::move(best.positions);
    }

    /// First the way, then the viewing directions along it.
    Result<CameraMove> walk(const std::optional<Vector3d>& from,
                            const std::optional<Vector3d>& to) {
        const double z = floor_ + values_.number("height", kWalkHeight);
        Positions corners;
        if (from) {
            corners = {*from, *to};
        } else {
            job_.report(0.0);
            if (job_.cancelled()) return cancelled();
            corners = walkedRooms(scene_, z, job_);
            if (job_.cancelled()) return cancelled();
        }
        if (corners.size() < 2 || (corners.back() - corners.front()).norm() < kMoveSpacing) {
            return fail(
                ErrorCode::BadInput,
                "The rooms are too small for a walk; give the points where it begins and ends.",
                "from, to");
        }
        auto way = repairAndTime(scene_, timing_, trajectoryThrough(divided(corners), 0.0),
                                 job_.stage(0.2, 0.6, request_.kind));
        if (!way) return tl::unexpected(std::move(way.error()));
        if (const int cuts = way->change.paths_cut; cuts > 0) {
            note_ =
                fmt::format("The walk is cut at {} place{} where no collision-free path exists.",
                            cuts, cuts == 1 ? "" : "s");
        }
        lookAhead(way->trajectory);
        const double duration = way->trajectory.frames.back().time_s;
        const double slower = values_.number("time", duration) / std::max(duration, 1e-9);
        for (TrajectoryFrame& frame : way->trajectory.frames) {
            frame.time_s *= std::max(1.0, slower);
        }
        return finished(
            repairAndTime(scene_, timing_, way->trajectory, job_.stage(0.6, 1.0, request_.kind)));
    }

    [[nodiscard]] Result<CameraMove> finished(Result<RepairedMotion> made) const {
        if (!made) return tl::unexpected(std::move(made.error()));
        return CameraMove{std::move(made->trajectory), timing_.look_at, floor_, note_};
    }

    [[nodiscard]] static Result<CameraMove> cancelled() {
        return fail(ErrorCode::Cancelled, "Making the camera move was cancelled.");
    }

    const MappedScene& scene_;
    const MoveRequest& request_;
    const JobContext& job_;
    std::optional<FloorHeights> floors_;
    PathTiming timing_;
    double floor_ = 0.0;  // z in the world that height settings are measured from, m
    MoveValues values_;
    std::string subject_name_;  // for messages
    std::string note_;          // how obstacles changed the move
};

}  // namespace

Result<CameraMove> makeMove(const MappedScene& scene, const PlanParams& params,
                            const MoveRequest& request, const JobContext& job) {
    return MoveMaker(scene, params, request, job).make();
}

}  // namespace dollytrack::planning
