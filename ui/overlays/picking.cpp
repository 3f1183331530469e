#include "ui/overlays/picking.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace dollytrack::ui {
namespace {

// The same depth bias as in drawing overlays: a line that lies on a floor is not hidden by it.
constexpr double kBias = 0.01;
constexpr double kOrthographicBias = 0.02;  // m

class Picker {
  public:
    Picker(const render::View& view, const Eigen::Vector2d& pixel, double scene_depth_m,
           double radius_px)
        : view_(view), pixel_(pixel), scene_depth_m_(scene_depth_m), radius_px_(radius_px) {}

    void mark(const render::OverlayMark& mark, double scale) {
        const Eigen::Vector3d p = view_.pose.toCamera(mark.at);
        if (mark.tag == render::kNoTag || p.z() < view_.near_m) return;
        const double away = (view_.project(p) - pixel_).norm() - 0.5 * scale * mark.size_px;
        offer(mark.tag, away, p.z());
    }

    void line(const render::OverlayLine& line, double scale) {
        if (line.tag == render::kNoTag) return;
        Eigen::Vector3d a = view_.pose.toCamera(line.a);
        Eigen::Vector3d b = view_.pose.toCamera(line.b);
        if (a.z() < view_.near_m && b.z() < view_.near_m) return;
        if (a.z() < view_.near_m) a = cutNear(b, a);
        if (b.z() < view_.near_m) b = cutNear(a, b);
        const Eigen::Vector2d p = view_.project(a);
        const Eigen::Vector2d way = view_.project(b) - p;
        const double squared = way.squaredNorm();
        const double t =
            squared > 0.0 ? std::clamp((pixel_ - p).dot(way) / squared, 0.0, 1.0) : 0.0;
        const double depth = view_.orthographic
                                 ? a.z() + t * (b.z() - a.z())
                                 : 1.0 / (1.0 / a.z() + t * (1.0 / b.z() - 1.0 / a.z()));
        offer(line.tag, (p + t * way - pixel_).norm() - 0.5 * scale * line.width_px, depth);
    }

    void box(const render::OverlayBox& box) {
        if (box.tag == render::kNoTag) return;
        const render::ViewRay ray = view_.rayThrough(pixel_.x(), pixel_.y());
        const Eigen::AngleAxisd turn(-box.yaw, Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d origin = turn * (ray.origin - box.center);
        const Eigen::Vector3d way = turn * ray.direction;
        double enter = view_.near_m;
        double leave = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            if (way[k] == 0.0) {
                if (std::abs(origin[k]) > box.half_size[k]) return;
                continue;
            }
            const double s = (-box.half_size[k] - origin[k]) / way[k];
            const double t = (box.half_size[k] - origin[k]) / way[k];
            enter = std::max(enter, std::min(s, t));
            leave = std::min(leave, std::max(s, t));
        }
        if (enter <= leave) offer(box.tag, 0.0, enter);
    }

    /// The best element offered so far.
    [[nodiscard]] const std::optional<PickedElement>& best() const { return best_; }

  private:
    [[nodiscard]] Eigen::Vector3d cutNear(const Eigen::Vector3d& inside,
                                          const Eigen::Vector3d& outside) const {
        const double share = (inside.z() - view_.near_m) / (inside.z() - outside.z());
        return inside + share * (outside - inside);
    }

    void offer(std::int32_t tag, double away_px, double depth) {
        if (away_px > radius_px_) return;
        const double nearer =
            view_.orthographic ? depth - kOrthographicBias : depth * (1.0 - kBias);
        PickedElement element{fromTag(tag), std::max(0.0, away_px), depth,
                              scene_depth_m_ <= 0.0 || nearer <= scene_depth_m_};
        if (!best_ || isBetterPick(element, *best_)) best_ = element;
    }

    const render::View& view_;
    Eigen::Vector2d pixel_;
    double scene_depth_m_;
    double radius_px_;
    std::optional<PickedElement> best_;
};

}  // namespace

std::optional<PickedElement> pickElement(const render::Overlay& overlay, const render::View& view,
                                         const Eigen::Vector2d& pixel, double scene_depth_m,
                                         double radius_px, double pixel_scale) {
    std::optional<PickedElement> hidden;
    // Marks, lines, boxes: the order from top to bottom in which overlays are drawn.
    for (int kind = 0; kind < 3; ++kind) {
        Picker picker(view, pixel, scene_depth_m, radius_px * pixel_scale);
        if (kind == 0) {
            for (const auto& mark : overlay.marks) picker.mark(mark, pixel_scale);
        } else if (kind == 1) {
            for (const auto& line : overlay.lines) picker.line(line, pixel_scale);
        } else {
            for (const auto& box : overlay.boxes) picker.box(box);
        }
        if (picker.best() && picker.best()->visible) return picker.best();
        if (!hidden) hidden = picker.best();
    }
    return hidden;
}

bool isBetterPick(const PickedElement& a, const PickedElement& b) {
    return std::tuple(!a.visible, a.distance_px, a.depth_m) <
           std::tuple(!b.visible, b.distance_px, b.depth_m);
}

}  // namespace dollytrack::ui
