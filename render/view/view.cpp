#include "render/view/view.h"

namespace dollytrack::render {

Eigen::Vector2d View::project(const Eigen::Vector3d& in_camera) const {
    if (!orthographic) return intrinsics.project(in_camera);
    return {orthographic->px_per_m * in_camera.x() + intrinsics.cx,
            orthographic->px_per_m * in_camera.y() + intrinsics.cy};
}

ViewRay View::rayThrough(double x, double y) const {
    if (!orthographic) return {pose.position, pose.rotation * intrinsics.unproject(x, y)};
    const Eigen::Vector3d aside((x - intrinsics.cx) / orthographic->px_per_m,
                                (y - intrinsics.cy) / orthographic->px_per_m, 0.0);
    return {pose.toWorld(aside), pose.forward()};
}

View makeView(const CameraParams& camera, const Pose& pose) {
    View view;
    view.intrinsics = makeIntrinsics(camera);
    view.pose = pose;
    view.near_m = camera.near_m;
    return view;
}

Pose rightOf(const Pose& left, double baseline_m) {
    return {left.toWorld({baseline_m, 0.0, 0.0}), left.rotation};
}

}  // namespace dollytrack::render
