#include "render/truth/motion_field.h"

#include "engine/camera/intrinsics.h"
#include "render/scene/moving_objects.h"

#include <Eigen/Geometry>

namespace dollytrack::render {
namespace {

/// `motions` move each object, by id, from the frame's time to the other image's; empty if nothing
/// moves.
MotionField fieldTo(const FrameContext& context, const FrameRecord& frame, const Pose& other,
                    const RayCaster& rays, const std::vector<Eigen::Isometry3d>& motions) {
    const Intrinsics lens = makeIntrinsics(context.contents.camera);
    const std::size_t count = frame.depth_m.size();
    std::vector<Eigen::Vector3d> places(count, Eigen::Vector3d::Zero());
    std::vector<bool> nothing(count, false);
    MotionField field;
    field.motion.assign(count, Eigen::Vector2f::Constant(kNoMotion));
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, ++i) {
            const auto depth = static_cast<double>(frame.depth_m[i]);
            if (!(depth > 0.0)) {
                nothing[i] = true;
                continue;
            }
            const Eigen::Vector2d at(x + 0.5, y + 0.5);
            places[i] = frame.pose.toWorld(depth * lens.unproject(at.x(), at.y()));
            if (!motions.empty()) places[i] = motions[frame.instance[i]] * places[i];
            const Eigen::Vector3d there = other.toCamera(places[i]);
            if (there.z() < context.contents.camera.near_m) continue;
            field.motion[i] = (lens.project(there) - at).cast<float>();
        }
    }
    field.sight =
        visibilityFrom(rays, other, lens, context.contents.camera.near_m, places, nothing);
    return field;
}

}  // namespace

MotionField motionField(const FrameContext& context, const FrameRecord& frame, int other_frame) {
    const Pose& other = context.contents.frames[other_frame].camera.pose;
    return fieldTo(context, frame, other, *context.moving.raysAt(other_frame),
                   context.moving.between(frame.index, other_frame));
}

MotionField parallaxField(const FrameContext& context, const FrameRecord& frame,
                          const Pose& other_camera) {
    return fieldTo(context, frame, other_camera, *context.moving.raysAt(frame.index), {});
}

}  // namespace dollytrack::render
