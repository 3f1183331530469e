#include "render/truth/motion_field.h"

#include "engine/camera/intrinsics.h"
#include "render/scene/moving_objects.h"

#include <Eigen/Geometry>

namespace dollytrack::render {
namespace {

/// World positions of the pixels' surface points at the other image's time.
struct MovedPoints {
    std::vector<Eigen::Vector3d> positions;
    std::vector<bool> nothing;  // pixels that hit nothing
};

/// `motions` move each object, by id, from the frame's time to the other image's; empty if nothing
/// moves.
MovedPoints movedPoints(const FrameRecord& frame, const Intrinsics& lens,
                        const std::vector<Eigen::Isometry3d>& motions) {
    const std::size_t count = frame.depth_m.size();
    MovedPoints points{std::vector<Eigen::Vector3d>(count, Eigen::Vector3d::Zero()),
                       std::vector<bool>(count, false)};
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, ++i) {
            const auto depth = static_cast<double>(frame.depth_m[i]);
            if (!(depth > 0.0)) {
                points.nothing[i] = true;
                continue;
            }
            Eigen::Vector3d& position = points.positions[i];
            position = frame.pose.toWorld(depth * lens.unproject(x + 0.5, y + 0.5));
            if (!motions.empty()) position = motions[frame.instance[i]] * position;
        }
    }
    return points;
}

MotionField fieldTo(const FrameContext& context, const FrameRecord& frame, const Pose& other,
                    const RayCaster& rays, const std::vector<Eigen::Isometry3d>& motions) {
    const Intrinsics lens = makeIntrinsics(context.contents.camera);
    const double near_m = context.contents.camera.near_m;
    const MovedPoints points = movedPoints(frame, lens, motions);
    MotionField field;
    field.motion.assign(points.positions.size(), Eigen::Vector2f::Constant(kNoMotion));
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, ++i) {
            if (points.nothing[i]) continue;
            const Eigen::Vector3d there = other.toCamera(points.positions[i]);
            if (there.z() < near_m) continue;
            field.motion[i] =
                (lens.project(there) - Eigen::Vector2d(x + 0.5, y + 0.5)).cast<float>();
        }
    }
    field.sight = visibilityFrom(rays, other, lens, near_m, points.positions, points.nothing);
    return field;
}

}  // namespace

MotionField motionField(const FrameContext& context, const FrameRecord& frame, int other_frame) {
    const Pose& other = context.contents.frames[other_frame].camera.pose;
    return fieldTo(context, frame, other, *context.moving.raysAt(other_frame),
                   context.moving.between(frame.index, other_frame));
}

std::vector<Eigen::Vector3f> sceneFlow(const FrameContext& context, const FrameRecord& frame,
                                       int other_frame) {
    const Intrinsics lens = makeIntrinsics(context.contents.camera);
    const Pose& other = context.contents.frames[other_frame].camera.pose;
    const MovedPoints points =
        movedPoints(frame, lens, context.moving.between(frame.index, other_frame));
    std::vector<Eigen::Vector3f> flow(points.positions.size(),
                                      Eigen::Vector3f::Constant(kNoMotion));
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x, ++i) {
            if (points.nothing[i]) continue;
            const Eigen::Vector3d here = frame.depth_m[i] * lens.unproject(x + 0.5, y + 0.5);
            flow[i] = (other.toCamera(points.positions[i]) - here).cast<float>();
        }
    }
    return flow;
}

MotionField parallaxField(const FrameContext& context, const FrameRecord& frame,
                          const Pose& other_camera) {
    return fieldTo(context, frame, other_camera, *context.moving.raysAt(frame.index), {});
}

}  // namespace dollytrack::render
