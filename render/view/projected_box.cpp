#include "render/view/projected_box.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {

PixelRect projectBox(const Eigen::AlignedBox3f& box, const View& view, const PixelRect& limits) {
    Eigen::AlignedBox2d covered;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d in_world =
            box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)).cast<double>();
        const Eigen::Vector3d in_camera = view.pose.toCamera(in_world);
        if (in_camera.z() < view.near_m) return limits;
        covered.extend(view.project(in_camera));
    }
    const auto clip = [](double value, int low, int high) {
        return static_cast<int>(std::clamp(value, double(low), double(high)));
    };
    return {clip(std::floor(covered.min().x()) - 1, limits.x0, limits.x1),
            clip(std::floor(covered.min().y()) - 1, limits.y0, limits.y1),
            clip(std::ceil(covered.max().x()) + 1, limits.x0, limits.x1),
            clip(std::ceil(covered.max().y()) + 1, limits.y0, limits.y1)};
}

View cutOut(const View& view, const PixelRect& rect, int step) {
    View part;
    part.pose = view.pose;
    part.near_m = view.near_m;
    part.orthographic = view.orthographic;
    if (part.orthographic) part.orthographic->px_per_m /= step;
    part.intrinsics = view.intrinsics;
    part.intrinsics.width = rect.width() / step;
    part.intrinsics.height = rect.height() / step;
    part.intrinsics.fx /= step;
    part.intrinsics.fy /= step;
    part.intrinsics.cx = (part.intrinsics.cx - rect.x0) / step;
    part.intrinsics.cy = (part.intrinsics.cy - rect.y0) / step;
    return part;
}

}  // namespace dollytrack::render
