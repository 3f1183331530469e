#include "planning/visibility/image_boxes.h"

#include "planning/visibility/view_estimator.h"

namespace dollytrack::planning {

bool mayCapture(const ViewEstimator& views, const Pose& pose, int object_id) {
    const auto extent = views.extent(pose, object_id);
    if (!extent) return false;
    const Intrinsics& k = views.intrinsics();
    const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(), Eigen::Vector2d(k.width, k.height));
    const Eigen::AlignedBox2d inside = image.intersection(*extent);
    if (inside.isEmpty()) return false;
    const double to_vga = 640.0 * 480.0 / (static_cast<double>(k.width) * k.height);
    return inside.sizes().prod() * to_vga >= CaptureRules{}.min_visible_px &&
           inside.sizes().prod() >= 0.5 * extent->sizes().prod();
}

std::vector<Eigen::AlignedBox2d> imageBoxes(const ViewEstimator& views, const Pose& pose) {
    std::vector<Eigen::AlignedBox2d> boxes;
    for (const Object& object : views.scene().objects) {
        if (object.role != Role::Target || !mayCapture(views, pose, object.id)) continue;
        const auto estimate = views.estimate(pose, object.id, kSparseGrid);
        if (estimate.visible_px > 0.0) boxes.push_back(estimate.visible_box);
    }
    return boxes;
}

}  // namespace dollytrack::planning
