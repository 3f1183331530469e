#include "ui/viewport/viewer_camera.h"

#include "engine/camera/camera_params.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadiansPerPixel = 0.006;
constexpr double kSame_rad = 1e-6;  // smaller differences from an axis are rounding

}  // namespace

Eigen::Vector3d ViewerCamera::towardsViewer() const {
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
}

Pose ViewerCamera::pose() const {
    Pose pose;
    pose.position = pivot + distance * towardsViewer();
    // In a view straight down, the right axis is the limit of nearly vertical views.
    const Eigen::Vector3d right(-std::sin(azimuth), std::cos(azimuth), 0.0);
    pose.rotation = lookAlong(-towardsViewer(), right);
    return pose;
}

render::View ViewerCamera::view(int width, int height) const {
    CameraParams camera;
    camera.width_px = std::max(width, 16);
    camera.height_px = std::max(height, 16);
    camera.hfov_deg = hfov_deg;
    render::View view;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = pose();
    view.near_m = std::clamp(0.02 * distance, 0.01, 0.05);
    if (orthographic) {
        // The orthographic view shows as much of the plane through the pivot as the pinhole camera.
        const double shown_m = 2.0 * distance * std::tan(0.5 * hfov_deg * kPi / 180.0);
        view.orthographic = render::Orthographic{camera.width_px / shown_m, 0.0};
        // The image plane moves back so that the whole scene is in front of it.
        constexpr double kBack = 200.0;  // m
        view.pose.position += kBack * towardsViewer();
        view.orthographic->depth_m = kBack + 2.0 * distance + 300.0;
    }
    return view;
}

void ViewerCamera::orbit(double dx, double dy) {
    azimuth -= kRadiansPerPixel * dx;
    elevation = std::clamp(elevation + kRadiansPerPixel * dy, -kPi / 2.0, kPi / 2.0);
}

void ViewerCamera::pan(double dx, double dy, int width) {
    const double metres_per_px =
        2.0 * distance * std::tan(0.5 * hfov_deg * kPi / 180.0) / std::max(width, 1);
    pivot += pose().rotation * Eigen::Vector3d(-dx * metres_per_px, -dy * metres_per_px, 0.0);
}

void ViewerCamera::zoom(double factor, const Eigen::Vector3d& at) {
    constexpr double kNearest = 0.05;
    constexpr double kFarthest = 2000.0;
    const double wanted = std::clamp(factor * distance, kNearest, kFarthest);
    factor = wanted / distance;
    // Scaling about the point under the cursor keeps that point in place.
    const Eigen::Vector3d eye = pivot + distance * towardsViewer();
    const Eigen::Vector3d moved_eye = at + factor * (eye - at);
    distance = wanted;
    pivot = moved_eye - distance * towardsViewer();
}

void ViewerCamera::fly(const Eigen::Vector3d& right_up_forward) {
    const Pose here = pose();
    pivot += here.rotation * Eigen::Vector3d(right_up_forward.x(), 0.0, right_up_forward.z());
    pivot.z() += right_up_forward.y();
}

void ViewerCamera::look(double dx, double dy) {
    const Eigen::Vector3d eye = pivot + distance * towardsViewer();
    azimuth -= 0.5 * kRadiansPerPixel * dx;
    elevation = std::clamp(elevation + 0.5 * kRadiansPerPixel * dy, -kPi / 2.0, kPi / 2.0);
    pivot = eye - distance * towardsViewer();
}

void ViewerCamera::frame(const Eigen::AlignedBox3d& box, double aspect) {
    if (box.isEmpty()) return;
    pivot = box.center();
    const double half_width = std::tan(0.5 * hfov_deg * kPi / 180.0);
    const double half_height = half_width / std::max(aspect, 0.1);
    constexpr double kBorder = 1.05;
    constexpr double kNearest_m = 0.3;
    distance = kNearest_m;
    for (int i = 0; i < 8; ++i) {
        const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
        const Eigen::Vector3d at = pose().rotation.conjugate() * (box.corner(corner) - pivot);
        const double from_pivot =
            kBorder * std::max(std::abs(at.x()) / half_width, std::abs(at.y()) / half_height);
        distance = std::max(distance, orthographic ? from_pivot : from_pivot - at.z());
    }
}

void ViewerCamera::lookFrom(Axis axis) {
    elevation = 0.0;
    switch (axis) {
        case Axis::Front:
            azimuth = -kPi / 2.0;
            break;
        case Axis::Back:
            azimuth = kPi / 2.0;
            break;
        case Axis::Right:
            azimuth = 0.0;
            break;
        case Axis::Left:
            azimuth = kPi;
            break;
        case Axis::Top:
            azimuth = -kPi / 2.0;
            elevation = kPi / 2.0;
            break;
        case Axis::Bottom:
            azimuth = -kPi / 2.0;
            elevation = -kPi / 2.0;
            break;
    }
}

void ViewerCamera::orbitBySteps(int to_the_right, int upwards) {
    constexpr double kStep_rad = kPi / 12.0;
    azimuth += kStep_rad * to_the_right;
    elevation = std::clamp(elevation + kStep_rad * upwards, -kPi / 2.0, kPi / 2.0);
}

void ViewerCamera::lookFromOpposite() {
    if (kPi / 2.0 - std::abs(elevation) < kSame_rad) {
        elevation = -elevation;
    } else {
        azimuth = std::remainder(azimuth + kPi, 2.0 * kPi);
    }
}

const char* ViewerCamera::axisName() const {
    const auto is = [&](double wanted) {
        return std::abs(std::remainder(azimuth - wanted, 2.0 * kPi)) < kSame_rad;
    };
    if (kPi / 2.0 - std::abs(elevation) < kSame_rad && is(-kPi / 2.0)) {
        return elevation > 0.0 ? "Top" : "Bottom";
    }
    if (std::abs(elevation) > kSame_rad) return "User";
    if (is(-kPi / 2.0)) return "Front";
    if (is(kPi / 2.0)) return "Back";
    if (is(0.0)) return "Right";
    return is(kPi) ? "Left" : "User";
}

void ViewerCamera::standAt(const Pose& camera, double pivot_distance) {
    const Eigen::Vector3d back = -camera.forward();
    elevation = std::asin(std::clamp(back.z(), -1.0, 1.0));
    if (back.head<2>().norm() > 1e-6) azimuth = std::atan2(back.y(), back.x());
    distance = std::max(pivot_distance, 0.05);
    pivot = camera.position - distance * back;
}

}  // namespace dollytrack::ui
