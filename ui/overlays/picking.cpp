#include "ui/overlays/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace dollytrack::ui {
namespace {

// The same depth bias as in drawing overlays: a line that lies on a floor is not hidden by it.
constexpr double kBias = 0.01;
constexpr double kOrthographicBias = 0.02;  // m
constexpr double kMiss_px = 2.0;            // tolerated by PickedElement::on

class Picker {
  public:
    using Drawn = PickedElement::Drawn;

    Picker(const render::View& view, const Eigen::Vector2d& pixel, double scene_depth_m,
           double radius_px, double scale)
        : view_(view),
          pixel_(pixel),
          scene_depth_m_(scene_depth_m),
          radius_px_(radius_px * scale),
          scale_(scale) {}

    void mark(const render::OverlayMark& mark) {
        const Eigen::Vector3d p = view_.pose.toCamera(mark.at);
        if (mark.tag == render::kNoTag || p.z() < view_.near_m) return;
        if (view_.clip_box && !view_.clip_box->contains(mark.at)) return;
        const double away = (view_.project(p) - pixel_).norm() - 0.5 * scale_ * mark.size_px;
        offer(mark.tag, Drawn::Mark, away, p.z());
    }

    void line(const render::OverlayLine& line) {
        if (line.tag == render::kNoTag) return;
        const Eigen::Vector3d along = line.b - line.a;
        const LineRange shown = insideClip(line.a, along, {0.0, 1.0});
        if (shown.first > shown.last) return;
        Eigen::Vector3d a = view_.pose.toCamera(line.a + shown.first * along);
        Eigen::Vector3d b = view_.pose.toCamera(line.a + shown.last * along);
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
        offer(line.tag, Drawn::Line, (p + t * way - pixel_).norm() - 0.5 * scale_ * line.width_px,
              depth);
    }

    void box(const render::OverlayBox& box) {
        if (box.tag == render::kNoTag) return;
        const render::ViewRay ray = view_.rayThrough(pixel_.x(), pixel_.y());
        const Eigen::AngleAxisd turn(-box.yaw, Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d origin = turn * (ray.origin - box.center);
        const Eigen::Vector3d way = turn * ray.direction;
        const Eigen::AlignedBox3d own(-box.half_size, box.half_size);
        LineRange range = {view_.near_m, std::numeric_limits<double>::infinity()};
        range = insideClip(ray.origin, ray.direction, partInBox(own, origin, way, range));
        if (range.first <= range.last) offer(box.tag, Drawn::Box, 0.0, range.first);
    }

    /// The elements found so far, the best first.
    [[nodiscard]] std::vector<PickedElement> sorted() const {
        std::vector<PickedElement> all;
        for (const auto& [tag, element] : found_) all.push_back(element);
        std::ranges::sort(all, isBetterPick);
        return all;
    }

  private:
    /// The part of a range of a line that the clipping box shows.
    [[nodiscard]] LineRange insideClip(const Eigen::Vector3d& origin, const Eigen::Vector3d& way,
                                       const LineRange& range) const {
        return view_.clip_box ? partInBox(*view_.clip_box, origin, way, range) : range;
    }

    [[nodiscard]] Eigen::Vector3d cutNear(const Eigen::Vector3d& inside,
                                          const Eigen::Vector3d& outside) const {
        const double share = (inside.z() - view_.near_m) / (inside.z() - outside.z());
        return inside + share * (outside - inside);
    }

    void offer(std::int32_t tag, Drawn drawn, double away_px, double depth) {
        if (away_px > radius_px_) return;
        const double nearer =
            view_.orthographic ? depth - kOrthographicBias : depth * (1.0 - kBias);
        const bool visible = scene_depth_m_ <= 0.0 || nearer <= scene_depth_m_;
        const PickedElement element{fromTag(tag), std::max(0.0, away_px),      depth, visible,
                                    drawn,        away_px <= kMiss_px * scale_};
        const auto [known, added] = found_.try_emplace(tag, element);
        if (!added && isBetterPick(element, known->second)) known->second = element;
    }

    const render::View& view_;
    Eigen::Vector2d pixel_;
    double scene_depth_m_;
    double radius_px_;
    double scale_;
    std::map<std::int32_t, PickedElement> found_;  // the best of each tag
};

}  // namespace

std::vector<PickedElement> pickElements(const render::Overlay& overlay, const render::View& view,
                                        const Eigen::Vector2d& pixel, double scene_depth_m,
                                        double radius_px, double pixel_scale) {
    Picker picker(view, pixel, scene_depth_m, radius_px, pixel_scale);
    for (const auto& mark : overlay.marks) picker.mark(mark);
    for (const auto& line : overlay.lines) picker.line(line);
    for (const auto& box : overlay.boxes) picker.box(box);
    return picker.sorted();
}

std::optional<PickedElement> pickElement(const render::Overlay& overlay, const render::View& view,
                                         const Eigen::Vector2d& pixel, double scene_depth_m,
                                         double radius_px, double pixel_scale) {
    const std::vector<PickedElement> all =
        pickElements(overlay, view, pixel, scene_depth_m, radius_px, pixel_scale);
    return all.empty() ? std::nullopt : std::optional(all.front());
}

LineRange partInBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction, LineRange range) {
    constexpr LineRange kEmpty = {1.0, 0.0};
    if (box.isEmpty()) return kEmpty;
    for (int k = 0; k < 3; ++k) {
        if (direction[k] == 0.0) {
            if (origin[k] < box.min()[k] || origin[k] > box.max()[k]) return kEmpty;
            continue;
        }
        const double s = (box.min()[k] - origin[k]) / direction[k];
        const double t = (box.max()[k] - origin[k]) / direction[k];
        range.first = std::max(range.first, std::min(s, t));
        range.last = std::min(range.last, std::max(s, t));
    }
    return range;
}

bool isBetterPick(const PickedElement& a, const PickedElement& b) {
    const auto rank = [](const PickedElement& one) {
        return std::tuple(!one.visible, !one.on, one.drawn, one.distance_px, one.depth_m);
    };
    return rank(a) < rank(b);
}

}  // namespace dollytrack::ui
