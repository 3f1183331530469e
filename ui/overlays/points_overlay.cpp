#include "ui/overlays/points_overlay.h"

#include "render/overlays/trajectory_overlay.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <algorithm>

namespace dollytrack::ui {
namespace {

using Mark = render::OverlayMark;
using Shape = LegendEntry::Shape;

class PointsBuilder {
  public:
    PointsBuilder(const Scene& scene, const Plan& plan, const CameraParams& camera,
                  const PointsOverlayOptions& options)
        : scene_(scene),
          plan_(plan),
          camera_(camera),
          options_(options),
          is_key_(plan.position_points.size(), false) {
        for (const int key : plan.key_frames) is_key_[key] = true;
    }

    PlanLayer build() {
        layer_.legend.title = "Points";
        if (options_.position_points) addPositionPoints();
        if (options_.observation_points) addObservationPoints();
        addSelected();
        return std::move(layer_);
    }

  private:
    void addObservationPoints() {
        int large = 0;
        int small = 0;
        int without = 0;
        for (std::size_t i = 0; i < plan_.observation_points.size(); ++i) {
            const ObservationPoint& point = plan_.observation_points[i];
            if (!isShown(static_cast<int>(i))) continue;
            const bool is_large = std::any_of(point.objects.begin(), point.objects.end(),
                                              [&](int id) { return scene_.object(id).large; });
            ++(is_large ? large : small);
            const std::int32_t tag = toTag(Picked::ObservationPoint, static_cast<int>(i));
            if (i < plan_.searches.size() && plan_.searches[i].position_point < 0) {
                ++without;
                layer_.overlay.marks.push_back({point.position,
                                                Mark::Shape::Ring,
                                                kRefusedColor,
                                                is_large ? 19.0 : 15.0,
                                                {0, 0, 0},
                                                tag});
            }
            layer_.overlay.marks.push_back({point.position,
                                            Mark::Shape::Dot,
                                            is_large ? kLargeTargetColor : kSmallTargetColor,
                                            is_large ? 11.0 : 7.0,
                                            {0, 0, 0},
                                            tag});
        }
        auto& entries = layer_.legend.entries;
        entries.push_back({"Observation point, large", Shape::Dot, kLargeTargetColor, large});
        entries.push_back({"Observation point, small", Shape::SmallDot, kSmallTargetColor, small});
        if (without > 0) {
            entries.push_back({"without a position point", Shape::Ring, kRefusedColor, without});
        }
    }

    void addPositionPoints() {
        int spare = 0;
        int keys = 0;
        for (std::size_t i = 0; i < plan_.position_points.size(); ++i) {
            if (is_key_[i] || !isPointShown(static_cast<int>(i))) continue;
            ++spare;
            addPositionPoint(static_cast<int>(i), kSpareColor, 5.0);
        }
        for (const int key : plan_.key_frames) {
            if (!isPointShown(key)) continue;
            ++keys;
            if (options_.frustums) {
                render::addFrustum(layer_.overlay, pose(key), camera_, options_.frustum_m,
                                   withOpacity(kKeyFrameColor, 0.75F), 1.2);
            }
            addPositionPoint(key, kKeyFrameColor, 8.0);
        }
        auto& entries = layer_.legend.entries;
        entries.push_back({"Key frame", Shape::Cross, kKeyFrameColor, keys});
        if (spare > 0) {
            entries.push_back({"Position point not needed", Shape::Cross, kSpareColor, spare});
        }
    }

    void addPositionPoint(int index, const Eigen::Vector4f& rgba, double size_px) {
        const Pose& at = pose(index);
        const std::int32_t tag = toTag(Picked::PositionPoint, index);
        const Eigen::Vector3d tip = at.position + options_.frustum_m * at.forward();
        layer_.overlay.lines.push_back({at.position, tip, rgba, 0.15 * size_px, 0.0, tag});
        layer_.overlay.marks.push_back(
            {tip, Mark::Shape::Arrow, rgba, 0.8 * size_px, at.forward(), tag});
        layer_.overlay.marks.push_back(
            {at.position, Mark::Shape::Cross, rgba, size_px, {0, 0, 0}, tag});
    }

    void addSelected() {
        const int p = options_.selected_position_point;
        if (p >= 0 && p < static_cast<int>(plan_.position_points.size())) {
            const auto& point = plan_.position_points[p];
            const Eigen::Vector3d& target =
                plan_.observation_points[point.observation_point].position;
            const std::int32_t tag = toTag(Picked::PositionPoint, p);
            layer_.overlay.lines.push_back(
                {point.pose.position, target, kSelectedColor, 1.6, 5.0, tag});
            render::addFrustum(layer_.overlay, point.pose, camera_, 1.4 * options_.frustum_m,
                               kSelectedColor, 2.0);
            layer_.overlay.marks.push_back(
                {point.pose.position, Mark::Shape::Ring, kSelectedColor, 20.0, {0, 0, 0}, tag});
            layer_.legend.entries.push_back({"Selected", Shape::Ring, kSelectedColor, 1});
        }
        const int o = options_.selected_observation_point;
        if (o >= 0 && o < static_cast<int>(plan_.observation_points.size())) {
            layer_.overlay.marks.push_back({plan_.observation_points[o].position,
                                            Mark::Shape::Ring,
                                            kSelectedColor,
                                            22.0,
                                            {0, 0, 0},
                                            toTag(Picked::ObservationPoint, o)});
            layer_.legend.entries.push_back({"Selected", Shape::Ring, kSelectedColor, 1});
        }
    }

    [[nodiscard]] bool isShown(int observation_point) const {
        if (options_.objects.empty()) return true;
        const std::vector<int>& objects = plan_.observation_points[observation_point].objects;
        return std::ranges::any_of(objects, [&](int id) {
            return std::ranges::find(options_.objects, id) != options_.objects.end();
        });
    }
    [[nodiscard]] bool isPointShown(int position_point) const {
        return isShown(plan_.position_points[position_point].observation_point);
    }

    [[nodiscard]] const Pose& pose(int index) const { return plan_.position_points[index].pose; }

    const Scene& scene_;
    const Plan& plan_;
    const CameraParams& camera_;
    const PointsOverlayOptions& options_;
    std::vector<bool> is_key_;
    PlanLayer layer_;
};

}  // namespace

PlanLayer pointsLayer(const Scene& scene, const Plan& plan, const CameraParams& camera,
                      const PointsOverlayOptions& options) {
    return PointsBuilder(scene, plan, camera, options).build();
}

}  // namespace dollytrack::ui
