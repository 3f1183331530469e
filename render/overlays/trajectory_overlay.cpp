#include "render/overlays/trajectory_overlay.h"

#include "engine/camera/intrinsics.h"

#include <algorithm>
#include <array>

namespace dollytrack::render {

Eigen::Vector4f colorAlong(double share) {
    const Eigen::Vector4f cool(0.10F, 0.45F, 0.92F, 1.0F);
    const Eigen::Vector4f middle(0.72F, 0.22F, 0.74F, 1.0F);
    const Eigen::Vector4f warm(0.98F, 0.45F, 0.08F, 1.0F);
    const auto t = static_cast<float>(2.0 * share);
    return t < 1.0F ? Eigen::Vector4f(cool + t * (middle - cool))
                    : Eigen::Vector4f(middle + (t - 1.0F) * (warm - middle));
}

void addFrustum(Overlay& overlay, const Pose& pose, const CameraParams& camera, double length_m,
                const Eigen::Vector4f& rgba, double width_px) {
    const Intrinsics lens = makeIntrinsics(camera);
    std::array<Eigen::Vector3d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
        const double x = i == 1 || i == 2 ? lens.width : 0.0;
        const double y = i >= 2 ? lens.height : 0.0;
        corners[i] = pose.toWorld(lens.unproject(x, y) * length_m);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        overlay.lines.push_back({pose.position, corners[i], rgba, width_px});
        overlay.lines.push_back({corners[i], corners[(i + 1) % 4], rgba, width_px});
    }
}

Overlay trajectoryOverlay(const Trajectory& trajectory, const CameraParams& camera) {
    Overlay overlay;
    const auto& frames = trajectory.frames;
    const bool has_key_frames =
        std::any_of(frames.begin(), frames.end(),
                    [](const TrajectoryFrame& frame) { return frame.position_point >= 0; });
    double since_last = 1e9;  // m
    int last_key = -1;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double share = frames.size() > 1 ? double(i) / double(frames.size() - 1) : 0.0;
        const Eigen::Vector4f color = colorAlong(share);
        if (i > 0 && frames[i].component == frames[i - 1].component) {
            const Eigen::Vector3d& from = frames[i - 1].pose.position;
            const Eigen::Vector3d& to = frames[i].pose.position;
            since_last += (to - from).norm();
            overlay.lines.push_back({from, to, color, 3.5});
        }
        const int key = frames[i].position_point;
        const bool show = has_key_frames ? key >= 0 && key != last_key : since_last > 0.5;
        if (key >= 0) last_key = key;
        if (!show) continue;
        since_last = 0.0;
        addFrustum(overlay, frames[i].pose, camera, 0.22, color, 1.6);
        overlay.marks.push_back({frames[i].pose.position, OverlayMark::Shape::Dot, color, 8.0});
    }
    return overlay;
}

}  // namespace dollytrack::render
