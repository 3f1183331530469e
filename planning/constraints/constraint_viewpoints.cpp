#include "planning/constraints/constraint_viewpoints.h"

#include "engine/core/field_list.h"
#include "planning/constraints/anchors.h"
#include "planning/coverage/surface_views.h"
#include "planning/free_space/free_space.h"
#include "planning/gaze/room_views.h"
#include "planning/path/frame_budget.h"
#include "planning/plan_params.h"
#include "planning/rooms/room_plan.h"
#include "planning/viewpoints/fixed_points.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <set>

namespace dollytrack::planning {
namespace {

std::vector<ExistingView> viewsOf(const std::vector<PositionPoint>& points,
                                  const std::vector<int>& keys) {
    std::vector<ExistingView> views;
    for (const int key : keys) {
        const PositionPoint& point = points[key];
        views.push_back({point.pose, point.fixed});
    }
    return views;
}

/// Number of surface views for a tour of `key_frames`, within the budget of frames.
std::size_t mostSurfaceViews(const PlanParams& params, std::size_t key_frames) {
    constexpr std::size_t kMostWithoutBudget = 400;
    constexpr double kFramesPerSurfaceView = 1.5;  // of a key frame and the path to it
    if (params.timing.max_frames <= 0) return kMostWithoutBudget;
    const double visits =
        std::min<double>(mostVisits(params), params.timing.max_frames / kFramesPerSurfaceView);
    return static_cast<std::size_t>(std::max(0.0, visits - static_cast<double>(key_frames)));
}

/// Chooses surface views beside the key frames, and adds them as position points.
Result<SurfaceGoal> addSurfaceViews(const PlanParams& params,
                                    const PlanningEnvironment& environment, Viewpoints& viewpoints,
                                    const JobContext& job) {
    std::vector<Pose> given;
    for (const int key :
         chooseKeyFrames(viewpoints.position_points, {}, params.coverage.objective)) {
        given.push_back(viewpoints.position_points[key].pose);
    }
    return findSurfaceViews(environment, params, given, mostSurfaceViews(params, given.size()), job)
        .map([&](SurfaceViews&& found) {
            for (const Pose& view : found.views) {
                addFixedPoint(view, environment, viewpoints);
                viewpoints.position_points.back().fixed = false;
                viewpoints.position_points.back().surface_view = true;
            }
            return std::move(found.goal);
        });
}

/// The kind's name in the parameter list.
std::string nameOf(Anchors kind) {
    ConstraintParams params;
    params.anchors = kind;
    FieldCollector fields;
    visitConstraintParams(params, fields);
    for (const Field& field : fields.take()) {
        if (field.name == "anchors") return field.valueText();
    }
    return {};
}

}  // namespace

std::vector<AnchorTally> countAnchors(const ConstraintViewpoints& viewpoints_of_constraints,
                                      const std::vector<SmoothPath>& paths) {
    std::set<int> on_the_way;
    for (const SmoothPath& path : paths) {
        for (const SmoothPath::Key& key : path.keys) on_the_way.insert(key.position_point);
    }
    std::vector<AnchorTally> tallies;
    for (const Anchors kind : anchorKinds(viewpoints_of_constraints.anchors)) {
        AnchorTally tally{nameOf(kind)};
        for (const AnchorViewpoints& anchor : viewpoints_of_constraints.found_anchors) {
            if (anchor.kind != kind) continue;
            ++tally.found;
            tally.visited += std::any_of(anchor.points.begin(), anchor.points.end(),
                                         [&](int point) { return on_the_way.contains(point); })
                                 ? 1
                                 : 0;
        }
        tallies.push_back(std::move(tally));
    }
    return tallies;
}

bool asksForRooms(const ConstraintParams& constraints) {
    return constraints.anchors != Anchors::None || constraints.rooms == RoomTours::Each;
}

Result<ConstraintViewpoints> addConstraintViewpoints(const PlacedPoints& placed,
                                                     const std::vector<Region>& must_see,
                                                     const PlanParams& params,
                                                     const RoomPlan* rooms,
                                                     const PlanningEnvironment& environment,
                                                     VisibilityCache* memo, const JobContext& job) {
    const ConstraintParams& constraints = params.constraints;
    ConstraintViewpoints result;
    result.placed = placed;
    Viewpoints& viewpoints = result.placed.viewpoints;
    std::vector<PositionPoint>& points = viewpoints.position_points;
    const std::size_t before = points.size();
    if (rooms != nullptr) {
        result.anchors = constraints.anchors;
        for (const AnchorViews& anchor : anchorViews(*rooms, constraints.anchors, environment)) {
            AnchorViewpoints& found =
                result.found_anchors.emplace_back(AnchorViewpoints{anchor.kind, {}});
            for (const Pose& view : anchor.views) {
                found.points.push_back(static_cast<int>(points.size()));
                addFixedPoint(view, environment, viewpoints);
            }
        }
    }
    const std::vector<int> keys = must_see.empty()
                                      ? std::vector<int>()
                                      : chooseKeyFrames(points, {}, params.coverage.objective);
    auto found = findMustSee(environment, must_see, viewsOf(points, keys), job);
    if (!found) return tl::unexpected(std::move(found.error()));
    result.must_see = std::move(*found);
    for (const MustSee& region : result.must_see) {
        for (const int kept : region.kept) {
            // Larger indices are views of earlier regions, which are fixed already.
            if (static_cast<std::size_t>(kept) < keys.size()) {
                points[keys[kept]].fixed = true;
            }
        }
        for (const Pose& view : region.views) addFixedPoint(view, environment, viewpoints);
    }
    const std::size_t asked_for = points.size();
    if (asksForRoomViews(params)) addRoomViews(params, environment, viewpoints);
    if (asksForSurface(params)) {
        auto goal = addSurfaceViews(params, environment, viewpoints, job);
        if (!goal) return tl::unexpected(std::move(goal.error()));
        result.surface = std::move(*goal);
    }
    if (constraints.rooms == RoomTours::Each) {
        for (const PlanRoom& room : rooms->rooms()) {
            result.tour_rooms.push_back({room.name, room.box});
        }
        for (PositionPoint& point : points) point.room = rooms->roomAt(point.pose.position);
    }
    if (asked_for > before) findCaptured(environment.views, points, memo);
    for (std::size_t i = before; i < asked_for; ++i) {
        // Like a point placed by hand, it stands for the objects it captures.
        const std::size_t target = points[i].observation_point;
        viewpoints.observation_points[target].objects = points[i].captured;
    }
    return result;
}

}  // namespace dollytrack::planning
