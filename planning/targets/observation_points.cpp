#include "planning/targets/observation_points.h"

#include "planning/plan_params.h"
#include "planning/targets/supports.h"
#include "planning/visibility/framing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace dollytrack::planning {
namespace {

// Least share of the image of each member's box in a group. Above the 5 % that count as well
// captured, since estimates and rendered images differ slightly.
constexpr double kUsefulShare = 0.1;
constexpr double kGroupFill = 0.9;

/// Applies the offsets M: yaw about the vertical, then pitch upwards.
Eigen::Vector3d turned(const Eigen::Vector3d& direction, const ViewpointParams& params) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    const Eigen::Vector3d unit = direction.normalized();
    const double yaw = std::atan2(unit.y(), unit.x()) + params.yaw_offset_deg * kRadians;
    const double limit = 0.5 * std::numbers::pi;
    const double pitch =
        std::clamp(std::asin(std::clamp(unit.z(), -1.0, 1.0)) + params.pitch_offset_deg * kRadians,
                   -limit, limit);
    return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

/// Direction R before the offsets: mean direction from the supporter to its objects, the
/// supporter's normal, or the object's front.
Eigen::Vector3d viewingDirection(const Scene& scene, const std::vector<SupportRelation>& supports,
                                 const std::vector<int>& objects) {
    const SupportRelation& first = supports[objects.front() - 1];
    if (first.kind == TargetKind::Suspension || first.kind == TargetKind::Shelf) {
        return first.outward;
    }
    if (first.kind == TargetKind::Single) return scene.object(objects.front()).front;
    const Object& supporter = scene.object(first.supporter);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int id : objects) sum += scene.object(id).box.center - supporter.box.center;
    // Add the front of the supporter, so that objects at the back edge of one at a wall do not turn
    // the view into the wall.
    const Eigen::Vector3d mean = sum / static_cast<double>(objects.size());
    return mean + mean.norm() * supporter.front;
}

class Grouping {
  public:
    Grouping(const ViewEstimator& views, const std::vector<SupportRelation>& supports,
             const ViewpointParams& params)
        : views_(views), supports_(supports), params_(params) {}

    /// Adds the objects as one observation point if one view can hold them, else in halves.
    void add(std::vector<int> objects) {
        ObservationPoint point = make(objects);
        if (objects.size() == 1 || holds(point)) {
            points.push_back(std::move(point));
            return;
        }
        const Eigen::Index axis = longerSpread(objects);
        const auto place = [&](int id) {
            return std::pair(views_.scene().object(id).box.center[axis], id);
        };
        std::sort(objects.begin(), objects.end(),
                  [&](int a, int b) { return place(a) < place(b); });
        const auto middle = objects.begin() + static_cast<std::ptrdiff_t>(objects.size() / 2);
        std::vector<int> rest(middle, objects.end());
        objects.erase(middle, objects.end());
        add(std::move(objects));
        add(std::move(rest));
    }

    std::vector<ObservationPoint> points;

  private:
    [[nodiscard]] ObservationPoint make(const std::vector<int>& objects) const {
        const SupportRelation& support = supports_[objects.front() - 1];
        ObservationPoint point;
        point.kind = support.kind;
        point.supporter = support.supporter;
        point.objects = objects;
        point.position = makeSubject(views_, objects).center;
        point.direction = turned(viewingDirection(views_.scene(), supports_, objects), params_);
        return point;
    }

    [[nodiscard]] bool holds(const ObservationPoint& point) const {
        const Subject subject = makeSubject(views_, point.objects);
        const double distance = distanceForFill(views_, subject, point.direction, kGroupFill);
        const Pose pose = lookAt(subject.center + point.direction * distance, subject.center);
        const double image =
            static_cast<double>(views_.intrinsics().width) * views_.intrinsics().height;
        return std::all_of(point.objects.begin(), point.objects.end(), [&](int id) {
            const auto extent = views_.extent(pose, id);
            return extent && extent->sizes().prod() / image >= kUsefulShare;
        });
    }

    /// The horizontal axis (0: x, 1: y) along which the objects are spread out more.
    [[nodiscard]] Eigen::Index longerSpread(const std::vector<int>& objects) const {
        Eigen::AlignedBox3d box;
        for (const int id : objects) box.extend(views_.scene().object(id).box.center);
        return box.sizes().x() >= box.sizes().y() ? 0 : 1;
    }

    const ViewEstimator& views_;
    const std::vector<SupportRelation>& supports_;
    const ViewpointParams& params_;
};

}  // namespace

std::vector<ObservationPoint> setObservationPoints(const ViewEstimator& views,
                                                   const TargetParams& targets,
                                                   const ViewpointParams& viewpoints) {
    const Scene& scene = views.scene();
    const std::vector<SupportRelation> supports = findSupports(scene, views.rays(), targets);

    // Members of a group share supporter and kind; in a shelf also the open side and the board.
    std::map<std::tuple<int, TargetKind, int, int, int>, std::vector<int>> groups;
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        const SupportRelation& support = supports[object.id - 1];
        int side = 0;
        int board = 0;
        if (support.kind == TargetKind::Shelf) {
            const double angle = std::atan2(support.outward.y(), support.outward.x());
            side = static_cast<int>(std::lround(angle / (0.5 * std::numbers::pi)));
            const double bottom = object.box.center.z() - object.box.half_size.z();
            board = static_cast<int>(std::lround(bottom / 0.1));
        }
        const bool shares =
            support.kind == TargetKind::Support || support.kind == TargetKind::Shelf;
        groups[{support.supporter, support.kind, shares ? 0 : object.id, side, board}].push_back(
            object.id);
    }
    Grouping grouping(views, supports, viewpoints);
    for (auto& [key, objects] : groups) grouping.add(std::move(objects));
    return std::move(grouping.points);
}

ObservationPoint alone(const ViewEstimator& views, const ObservationPoint& group, int object_id) {
    ObservationPoint point = group;
    point.objects = {object_id};
    point.position = makeSubject(views, point.objects).center;
    return point;
}

}  // namespace dollytrack::planning
