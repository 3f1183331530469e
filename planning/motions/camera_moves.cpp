#include "planning/motions/camera_moves.h"

#include "engine/core/name_hint.h"
#include "engine/document/target_filter.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/motions/object_moves.h"
#include "planning/motions/time_path.h"
#include "planning/rooms/room_plan.h"
#include "planning/timing/motion_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

namespace dollytrack::planning {
namespace {

using Eigen::Vector3d;
using Positions = std::vector<Vector3d>;

struct MoveKind {
    std::string_view name;
    std::string_view text;
    std::vector<std::string> options;
};

const std::array<MoveKind, 5>& kinds() {
    static const std::array<MoveKind, 5> kKinds = {{
        {"orbit",
         "around an object, as far as there is room; radius in m, height in m above the floor, arc "
         "in degrees, time in s",
         {"target", "radius", "height", "arc", "time"}},
        {"arc",
         "a quarter of an orbit (90 degrees by default)",
         {"target", "radius", "height", "arc", "time"}},
        {"dolly",
         "straight towards an object, by distance in m, or between two points x;y;z",
         {"target", "from", "to", "distance", "time"}},
        {"crane",
         "straight up or down beside an object, between two heights in m above the floor",
         {"target", "radius", "from_height", "to_height", "time"}},
        {"walk",
         "looking along the motion, through the doorways of all rooms or between two points x;y;z; "
         "height in m above the floor",
         {"from", "to", "height", "time"}},
    }};
    return kKinds;
}

constexpr double kFill = 0.5;         // share of the image's width or height that an object takes
constexpr double kDollyStart = 0.25;  // the same where a dolly starts
constexpr double kWalkHeight = 1.5;   // above the floor, m
constexpr double kLookAhead = 0.6;    // of a walk: the camera looks at a point this far along it, m
constexpr double kPositionsFound = 0.2;  // progress when the positions of a move are known
constexpr double kRadians = std::numbers::pi / 180.0;

Result<std::optional<double>> numberOf(const MoveRequest& request, const std::string& name) {
    const auto found = request.options.find(name);
    if (found == request.options.end()) return std::optional<double>{};
    double value = 0.0;
    const std::string& text = found->second;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) < 1e4)) {
        return fail(ErrorCode::Usage, fmt::format("'{}' is not a number below 10000.", text), name);
    }
    return std::optional<double>{value};
}

Result<std::optional<Vector3d>> pointOf(const MoveRequest& request, const std::string& name) {
    const auto found = request.options.find(name);
    if (found == request.options.end()) return std::optional<Vector3d>{};
    MoveRequest parts;
    std::string rest = found->second + ";";
    Vector3d point;
    for (int i = 0; i < 3; ++i) {
        const std::size_t cut = rest.find(';');
        if (cut == std::string::npos) {
            return fail(ErrorCode::Usage,
                        fmt::format("'{}' is not a point; write x;y;z.", found->second), name);
        }
        parts.options[name] = rest.substr(0, cut);
        rest = rest.substr(cut + 1);
        const auto value = numberOf(parts, name);
        if (!value) return tl::unexpected(value.error());
        point[i] = **value;
    }
    if (!rest.empty()) {
        return fail(ErrorCode::Usage,
                    fmt::format("'{}' is not a point; write x;y;z.", found->second), name);
    }
    return std::optional<Vector3d>{point};
}

/// The object that the move is about: that of `object_id`, else the largest one that the option
/// `target` names.
Result<const Object*> targetOf(const Scene& scene, const MoveRequest& request) {
    if (request.object_id) return &scene.object(*request.object_id);
    const auto named = request.options.find("target");
    if (named == request.options.end()) {
        return fail(ErrorCode::Usage, "The move needs the object that it looks at.", "target");
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

/// The rooms in the order of a walk through their doorways, and back where it branches, as points
/// at one height, from the largest room on. `end` counts the points up to the last new room.
void visitRooms(const RoomPlan& plan, std::size_t room, double z, std::vector<char>& visited,
                Positions& points, std::size_t& end) {
    const auto atHeight = [&](Vector3d point) {
        point.z() = z;
        return point;
    };
    visited[room] = 1;
    const Vector3d middle = atHeight(plan.rooms()[room].box.center());
    points.push_back(middle);
    end = points.size();
    for (const Doorway& door : plan.doorways()) {
        const auto a = static_cast<std::size_t>(door.room_a);
        const auto b = static_cast<std::size_t>(door.room_b);
        if (a != room && b != room) continue;
        const std::size_t next = a == room ? b : a;
        if (visited[next]) continue;
        if (points.back() != middle) points.push_back(middle);
        points.push_back(atHeight(door.center));
        visitRooms(plan, next, z, visited, points, end);
        points.push_back(atHeight(door.center));
    }
}

/// The free position of the camera that is nearest to a wish, in the largest room.
Vector3d nearestFree(const BaselineScene& scene, const Vector3d& wish) {
    Vector3d nearest = wish;
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& cell : scene.sphere->cells(0)) {
        const Vector3d place = cell.cast<double>();
        const double distance = (place - wish).squaredNorm();
        if (distance >= least || !scene.sphere->fits(place)) continue;
        least = distance;
        nearest = place;
    }
    return nearest;
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

class MoveMaker {
  public:
    MoveMaker(const BaselineScene& scene, const PlanParams& params, const MoveRequest& request,
              const JobContext& job)
        : scene_(scene), request_(request), job_(job) {
        timing_.limits = motionLimits(params.timing);
        timing_.frame_interval_s = timing_.smooth_over_s = 1.0 / params.timing.frame_rate;
        timing_.retime_all = true;
        floor_ = scene.scene->room_bounds.min().z();
    }

    Result<RepairedMotion> make() {
        for (const char* name :
             {"radius", "height", "arc", "time", "distance", "from_height", "to_height"}) {
            const auto value = numberOf(request_, name);
            if (!value) return tl::unexpected(value.error());
            if (*value && **value <= 0.0) {
                return fail(ErrorCode::Usage, "The value must be above 0.", name);
            }
            if (*value) numbers_[name] = **value;
        }
        const auto from = pointOf(request_, "from");
        const auto to = pointOf(request_, "to");
        if (!from) return tl::unexpected(from.error());
        if (!to) return tl::unexpected(to.error());
        if (from->has_value() != to->has_value()) {
            return fail(ErrorCode::Usage, "A move between two points needs both.", "from, to");
        }
        if (*from && (**to - **from).norm() < kMoveSpacing) {
            return fail(ErrorCode::Usage, "The two points are the same.", "from, to");
        }
        if (request_.kind == "walk") return walk(*from, *to);
        std::optional<Vector3d> look_at;
        Positions positions;
        if (*from) {
            positions = divided({**from, **to});
            look_at = **to + (**to - **from).normalized();
        }
        if (!*from || request_.options.contains("target")) {
            const auto target = targetOf(*scene_.scene, request_);
            if (!target) return tl::unexpected(target.error());
            const ObjectMoves moves(scene_, **target);
            look_at = moves.center();
            if (!*from) positions = around(moves);
            if (job_.cancelled()) return cancelled();
            if (positions.empty()) {
                return fail(ErrorCode::BadInput,
                            fmt::format("There is no free space for this move around '{}'; choose "
                                        "another radius, height or object.",
                                        (*target)->name),
                            request_.kind);
            }
        }
        timing_.look_at = look_at;
        return repairAndTime(scene_, timing_, trajectoryThrough(positions, number("time", 0.0)),
                             job_.stage(kPositionsFound, 1.0, request_.kind));
    }

  private:
    [[nodiscard]] double number(const std::string& name, double otherwise) const {
        const auto found = numbers_.find(name);
        return found == numbers_.end() ? otherwise : found->second;
    }

    /// A given height above the floor as z in the world.
    [[nodiscard]] double heightOr(const std::string& name, double z) const {
        return numbers_.contains(name) ? floor_ + number(name, 0.0) : z;
    }

    [[nodiscard]] Positions around(const ObjectMoves& moves) const {
        const double near = moves.distanceFor(kFill);
        const double radius = number("radius", near);
        const double level = moves.center().z() + 0.25 * radius;
        if (request_.kind == "dolly") {
            const double start = std::max(near + 0.2, moves.distanceFor(kDollyStart));
            const double first =
                numbers_.contains("distance") ? near + number("distance", 0.0) : start;
            for (const double share : {1.0, 0.75, 0.5, 0.35}) {
                const double from = near + share * (first - near);
                const double z = moves.center().z() + 0.25 * near;
                const Positions ends = moves.straight(from, z, near, z);
                if (!ends.empty()) return divided(ends);
            }
            return {};
        }
        if (request_.kind == "crane") {
            const double low = heightOr("from_height", floor_ + 0.5);
            const double high = heightOr("to_height", floor_ + 2.0);
            for (const double factor : kDistanceFactors) {
                const Positions ends = moves.straight(factor * radius, low, factor * radius, high);
                if (!ends.empty()) return divided(ends);
            }
            return {};
        }
        return moves.orbit(radius, heightOr("height", level),
                           kRadians * number("arc", request_.kind == "arc" ? 90.0 : 360.0),
                           job_.stage(0.0, kPositionsFound, request_.kind));
    }

    /// First the way, then the viewing directions along it.
    Result<RepairedMotion> walk(const std::optional<Vector3d>& from,
                                const std::optional<Vector3d>& to) {
        const double z = floor_ + number("height", kWalkHeight);
        Positions corners;
        if (from) {
            corners = {*from, *to};
        } else {
            job_.report(0.0);
            if (job_.cancelled()) return cancelled();
            const RoomPlan plan(*scene_.scene, *scene_.rays, *scene_.free_space,
                                scene_.sphere->radius());
            std::vector<char> visited(plan.rooms().size(), 0);
            std::size_t end = 0;
            visitRooms(plan, 0, z, visited, corners, end);
            corners.resize(end);
            for (Vector3d& corner : corners) {
                if (job_.cancelled()) return cancelled();
                if (!scene_.sphere->fits(corner)) corner = nearestFree(scene_, corner);
            }
        }
        if (corners.size() < 2) {
            return fail(ErrorCode::BadInput,
                        "The scene has no doorways to walk through; pass from= and to=.", "walk");
        }
        auto way = repairAndTime(scene_, timing_, trajectoryThrough(divided(corners), 0.0),
                                 job_.stage(0.2, 0.6, request_.kind));
        if (!way) return way;
        lookAhead(way->trajectory);
        const double duration = way->trajectory.frames.back().time_s;
        const double slower = number("time", duration) / std::max(duration, 1e-9);
        for (TrajectoryFrame& frame : way->trajectory.frames) {
            frame.time_s *= std::max(1.0, slower);
        }
        return repairAndTime(scene_, timing_, way->trajectory, job_.stage(0.6, 1.0, request_.kind));
    }

    [[nodiscard]] static Result<RepairedMotion> cancelled() {
        return fail(ErrorCode::Cancelled, "Making the camera move was cancelled.");
    }

    const BaselineScene& scene_;
    const MoveRequest& request_;
    const JobContext& job_;
    PathTiming timing_;
    double floor_ = 0.0;
    std::map<std::string, double> numbers_;
};

}  // namespace

Result<MoveRequest> parseMove(const std::string& text) {
    MoveRequest request;
    const std::size_t colon = text.find(':');
    request.kind = text.substr(0, colon);
    std::vector<std::string> names;
    const MoveKind* kind = nullptr;
    for (const MoveKind& one : kinds()) {
        names.emplace_back(one.name);
        if (one.name == request.kind) kind = &one;
    }
    if (!kind) {
        return fail(ErrorCode::Usage, fmt::format("The kind of move '{}' is unknown{}",
                                                  request.kind, nameHint(request.kind, names)));
    }
    std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string option = rest.substr(0, comma);
        rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
        const std::size_t equals = option.find('=');
        const std::string name = option.substr(0, equals);
        if (std::find(kind->options.begin(), kind->options.end(), name) == kind->options.end()) {
            return fail(ErrorCode::Usage, fmt::format("The option '{}' of {} is unknown{}", name,
                                                      kind->name, nameHint(name, kind->options)));
        }
        if (equals == std::string::npos || equals + 1 == option.size()) {
            return fail(ErrorCode::Usage,
                        fmt::format("The option '{}' has no value; write {}=VALUE.", name, name));
        }
        request.options[name] = option.substr(equals + 1);
    }
    return request;
}

Result<RepairedMotion> makeMove(const BaselineScene& scene, const PlanParams& params,
                                const MoveRequest& request, const JobContext& job) {
    auto made = MoveMaker(scene, params, request, job).make();
    if (made) made->change = {};  // of the ideal motion, which nobody gave
    return made;
}

std::string moveHelp() {
    std::string help;
    for (const MoveKind& kind : kinds()) {
        help += fmt::format("{}: {}; {}=\n", kind.name, kind.text, fmt::join(kind.options, "=, "));
    }
    return help;
}

}  // namespace dollytrack::planning
