#include "render/overlays/plan_overlay.h"

#include "render/overlays/trajectory_overlay.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

const Eigen::Vector4f kLargeTarget(0.98F, 0.80F, 0.10F, 1.0F);
const Eigen::Vector4f kSmallTarget(0.90F, 0.12F, 0.12F, 1.0F);
constexpr double kStep = 0.05;          // m between points of a drawn curve
constexpr double kMostSteps = 100'000;  // fewer, longer ones on a path of many kilometres

void addTargets(Overlay& overlay, const Scene& scene, const Plan& plan) {
    for (const ObservationPoint& point : plan.observation_points) {
        const bool large = std::any_of(point.objects.begin(), point.objects.end(),
                                       [&](int id) { return scene.object(id).large; });
        overlay.marks.push_back({point.position, OverlayMark::Shape::Dot,
                                 large ? kLargeTarget : kSmallTarget, large ? 9.0 : 6.0});
    }
}

void addPath(Overlay& overlay, const SmoothPath& path, const Plan& plan,
             const CameraParams& camera) {
    const auto share = [&](double arc) { return path.length_m > 0.0 ? arc / path.length_m : 0.0; };
    const int steps = static_cast<int>(std::ceil(std::min(kMostSteps, path.length_m / kStep)));
    Eigen::Vector3d last = path.at(0.0);
    for (int i = 1; i <= steps; ++i) {
        const double arc = path.length_m * i / steps;
        const Eigen::Vector3d point = path.at(arc);
        overlay.lines.push_back({last, point, colorAlong(share(arc)), 3.0});
        last = point;
    }
    for (const SmoothPath::Key& key : path.keys) {
        if (key.position_point < 0) continue;
        const auto& position_point = plan.position_points[key.position_point];
        const auto& target = plan.observation_points[position_point.observation_point];
        const Eigen::Vector4f color = colorAlong(share(key.arc_m));
        addFrustum(overlay, lookAt(key.position, target.position), camera, 0.16, color, 1.3);
        overlay.marks.push_back({key.position, OverlayMark::Shape::Cross, color, 7.0});
    }
}

}  // namespace

Overlay planOverlay(const Scene& scene, const Plan& plan, const CameraParams& camera) {
    Overlay overlay;
    addTargets(overlay, scene, plan);
    for (const SmoothPath& path : plan.smooth_paths) {
        if (!path.pieces.empty()) addPath(overlay, path, plan, camera);
    }
    return overlay;
}

}  // namespace dollytrack::render
