#include "planning/viewpoints/hand_placed.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/viewpoints/candidate_evaluator.h"
#include "planning/viewpoints/fixed_points.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/visibility/framing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace dollytrack::planning {
namespace {

constexpr int kFirstGrid = 8;
constexpr double kLeastVisibleByHand = 0.6;  // visible fraction in a coarse estimate

std::vector<int> idsOf(const std::vector<ObjectRef>& objects, const Scene& scene) {
    std::vector<int> ids;
    for (const ObjectRef& ref : objects) {
        if (ref.id >= 1 && ref.id <= static_cast<int>(scene.objects.size())) ids.push_back(ref.id);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

std::vector<int> sorted(std::vector<int> ids) {
    std::sort(ids.begin(), ids.end());
    return ids;
}

std::string metres(double value) {
    return fmt::format("{:.2f} m", value);
}

/// Elevation in words: "35.0 degrees down".
std::string upOrDown(const Eigen::Vector3d& forward) {
    const double degrees = elevationOf(forward) * 180.0 / std::numbers::pi;
    return fmt::format("{:.1f} degrees {}", std::abs(degrees), degrees < 0.0 ? "down" : "up");
}

/// The object that encloses a position, or 0: at least five of six axis-parallel rays hit it. (An
/// object on the floor may share its underside with it.)
int enclosing(const RayCaster& rays, const Eigen::Vector3d& place) {
    std::map<int, int> met;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            ++met[rays.cast(place, sign * Eigen::Vector3d::Unit(axis)).object_id];
        }
    }
    for (const auto& [object_id, count] : met) {
        if (count >= 5) return object_id;
    }
    return 0;
}

/// Why a pinned point is not legal, as a sentence; empty if it is.
std::optional<RefusedPin> refuse(const PinnedPoint& pin, int index,
                                 const PlanningEnvironment& environment) {
    RefusedPin refused;
    const Eigen::Vector3d& place = pin.pose.position;
    refused.verdict = environment.sphere.verdict(place, refused.object_id);
    refused.pin = index;
    refused.name = pin.name;
    if (refused.verdict == Verdict::Legal) {
        if (environment.pitch.holds(pin.pose.rotation)) return std::nullopt;
        refused.verdict = Verdict::PitchBand;
        refused.reason = "outside the pitch band, looks " + upOrDown(pin.pose.forward());
        return refused;
    }
    const Scene& scene = environment.views.scene();
    const AllowedRegion* region = environment.sphere.region();
    if (refused.verdict == Verdict::OutsideRoom) {
        const int inside = enclosing(environment.views.rays(), place);
        if (inside != 0 && !scene.object(inside).structure) {
            refused.verdict = Verdict::InObstacle;
            refused.object_id = inside;
            refused.reason = "inside " + scene.object(inside).name;
            return refused;
        }
    }
    switch (refused.verdict) {
        case Verdict::NoGo: {
            const NoGoBox* box =
                region->boxAt(place, environment.sphere.radius() + SweptSphere::kMargin);
            refused.reason = "in the no-go box " + (box ? box->name : std::string());
            break;
        }
        case Verdict::HeightBand:
            refused.reason = std::string(region->hasLevels() ? "not at the camera's exact height, "
                                                             : "outside the height band, ") +
                             metres(region->heightOf(place)) + " above the floor";
            break;
        case Verdict::OutsideRoom:
            refused.reason = "outside the free space of the rooms";
            break;
        default:
            refused.reason =
                "too close to " + (refused.object_id > 0 ? scene.object(refused.object_id).name
                                                         : std::string("a surface"));
            break;
    }
    return refused;
}

class HandPlacing {
  public:
    HandPlacing(const Viewpoints& found, const PlanEdits& edits,
                const PlanningEnvironment& environment)
        : found_(found),
          edits_(edits),
          environment_(environment),
          scene_(environment.views.scene()) {}

    PlacedPoints run(VisibilityCache* memo) {
        pins_.resize(edits_.pinned.size());
        for (std::size_t i = 0; i < pins_.size(); ++i) {
            const auto index = static_cast<int>(i);
            pins_[i].objects = idsOf(edits_.pinned[i].objects, scene_);
            if (auto refused = refuse(edits_.pinned[i], index, environment_)) {
                placed_.refused.push_back(std::move(*refused));
                pins_[i].done = true;
            }
        }
        for (std::size_t o = 0; o < found_.observation_points.size(); ++o) takeOver(o);
        for (std::size_t i = 0; i < pins_.size(); ++i) {
            if (!pins_[i].done) addPin(static_cast<int>(i));
        }
        Viewpoints& points = placed_.viewpoints;
        findCaptured(environment_.views, points.position_points, memo);
        for (const PositionPoint& point : points.position_points) {
            auto& target = points.observation_points[point.observation_point];
            if (point.pin >= 0 && target.objects.empty()) target.objects = point.captured;
        }
        return std::move(placed_);
    }

  private:
    struct Pin {
        std::vector<int> objects;
        bool done = false;  // placed or refused
    };

    /// Copies an observation point, with the position point found for it or the pinned one instead.
    void takeOver(std::size_t index) {
        Viewpoints& points = placed_.viewpoints;
        const ObservationPoint& target = found_.observation_points[index];
        points.observation_points.push_back(target);
        points.searches.push_back(found_.searches[index]);
        ViewpointSearch& search = points.searches.back();
        const int searched = search.position_point;
        search.position_point = -1;
        const std::vector<int> objects = sorted(target.objects);
        bool pinned = false;
        for (std::size_t i = 0; i < pins_.size(); ++i) {
            if (pins_[i].done || pins_[i].objects != objects) continue;
            pins_[i].done = true;
            pinned = true;
            addPoint(static_cast<int>(i), index);
        }
        if (pinned) return;
        search.removed = std::any_of(
            edits_.removed.begin(), edits_.removed.end(),
            [&](const auto& removed) { return idsOf(removed.objects, scene_) == objects; });
        if (search.removed || searched < 0) return;
        search.position_point = static_cast<int>(points.position_points.size());
        points.position_points.push_back(found_.position_points[searched]);
    }

    /// Adds a position point at a pin, for an existing observation point.
    void addPoint(int pin, std::size_t target_index) {
        Viewpoints& points = placed_.viewpoints;
        const ObservationPoint& target = points.observation_points[target_index];
        PositionPoint point;
        point.observation_point = static_cast<int>(target_index);
        point.pose = edits_.pinned[pin].pose;
        point.component = environment_.free_space.componentAt(point.pose.position);
        point.pin = pin;
        point.fixed = true;
        if (!target.objects.empty()) {
            const double fill =
                fillFrom(environment_.views, makeSubject(environment_.views, target.objects),
                         point.pose.position);
            point.fill = std::isfinite(fill) ? fill : 0.0;
        }
        if (target.objects.empty()) {
            for (const Object& object : scene_.objects) {
                const auto coarse = [&] { return estimate(point.pose, object.id, kFirstGrid); };
                if (object.role != Role::Target || coarse().visible_fraction < kLeastVisibleByHand)
                    continue;
                addCaptured(point, object.id);
            }
        } else {
            for (const int id : target.objects) addCaptured(point, id);
        }
        points.searches[target_index].position_point =
            static_cast<int>(points.position_points.size());
        points.position_points.push_back(std::move(point));
    }

    [[nodiscard]] ViewEstimator::Estimate estimate(const Pose& pose, int id, int grid) const {
        return environment_.views.estimate(pose, id, grid);
    }

    void addCaptured(PositionPoint& point, int id) const {
        const ObjectView view =
            makeView(estimate(point.pose, id, ViewEstimator::kExactGrid), id, 0);
        if (isWellCaptured(view)) point.well_captured.push_back(id);
        if (isCaptured(view)) point.captured.push_back(id);
    }

    /// Adds an observation point for a pin that matches none, and its position point.
    void addPin(int pin) {
        const Pose& pose = edits_.pinned[pin].pose;
        ObservationPoint target;
        for (const int id : pins_[pin].objects) {
            if (scene_.object(id).role == Role::Target) target.objects.push_back(id);
        }
        if (target.objects.empty()) {
            target.position = lookedAt(pose, environment_.views);
        } else {
            target.position = makeSubject(environment_.views, target.objects).center;
        }
        const Eigen::Vector3d back = pose.position - target.position;
        target.direction = back.norm() > 1e-6 ? Eigen::Vector3d(back.normalized())
                                              : Eigen::Vector3d(-pose.forward());
        placed_.viewpoints.observation_points.push_back(std::move(target));
        placed_.viewpoints.searches.emplace_back();
        addPoint(pin, placed_.viewpoints.observation_points.size() - 1);
    }

    const Viewpoints& found_;
    const PlanEdits& edits_;
    const PlanningEnvironment& environment_;
    const Scene& scene_;
    std::vector<Pin> pins_;
    PlacedPoints placed_;
};

}  // namespace

PlacedPoints placeByHand(const Viewpoints& found, const PlanEdits& edits,
                         const PlanningEnvironment& environment, VisibilityCache* memo) {
    return HandPlacing(found, edits, environment).run(memo);
}

}  // namespace dollytrack::planning
