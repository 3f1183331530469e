#include "ui/viewport/adaptive_resolution.h"

#include <algorithm>
#include <tuple>

namespace dollytrack::ui {
namespace {

constexpr double kLongestRest_ms = 600.0;

}  // namespace

AdaptiveResolution::Time AdaptiveResolution::restsAt() const {
    const std::chrono::milliseconds whole(static_cast<int>(std::min(whole_ms_, kLongestRest_ms)));
    return moved_ + std::max(kRest, whole);
}

int AdaptiveResolution::shrinkFor(bool same, Time now) const {
    if (now >= restsAt() || whole_ms_ <= kFluent_ms) return 1;
    if (same) return shrink_;
    constexpr int kCoarsest = 3;
    return whole_ms_ <= 4.0 * kFluent_ms ? 2 : kCoarsest;
}

void AdaptiveResolution::drew(int shrink, bool same, bool scene, double milliseconds, Time now) {
    shrink_ = shrink;
    if (!same) moved_ = now;
    if (shrink == 1 && scene) whole_ms_ = milliseconds;
}

bool samePicture(const render::View& a, const render::View& b) {
    const auto lens = [](const render::View& view) {
        const Intrinsics& i = view.intrinsics;
        return std::tuple(i.width, i.height, i.fx, i.fy, i.cx, i.cy, view.near_m,
                          view.orthographic ? view.orthographic->px_per_m : 0.0);
    };
    const auto cut = [](const render::View& view) {
        const render::StructureCut c = view.structure_cut.value_or(render::StructureCut{});
        return std::tuple(view.structure_cut.has_value(), c.plane.x(), c.plane.y(), c.plane.z(),
                          c.plane.w(), c.keep_below_z, c.ceiling_z);
    };
    const auto box = [](const render::View& view) {
        return view.clip_box.value_or(Eigen::AlignedBox3d());
    };
    return box(a).min() == box(b).min() && box(a).max() == box(b).max() && lens(a) == lens(b) &&
           cut(a) == cut(b) && a.pose.position == b.pose.position &&
           a.pose.rotation.coeffs() == b.pose.rotation.coeffs() && a.hidden == b.hidden &&
           a.backdrop == b.backdrop && a.antialias == b.antialias && a.reflections == b.reflections;
}

render::View shrunk(render::View view, int by) {
    Intrinsics& lens = view.intrinsics;
    const int width = std::max(lens.width / by, 1);
    const int height = std::max(lens.height / by, 1);
    const double x = static_cast<double>(width) / lens.width;
    const double y = static_cast<double>(height) / lens.height;
    lens = {width, height, x * lens.fx, y * lens.fy, x * lens.cx, y * lens.cy};
    if (view.orthographic) view.orthographic->px_per_m *= x;
    return view;
}

}  // namespace dollytrack::ui
