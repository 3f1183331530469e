#pragma once

#include "render/dataset/contents/frame_context.h"
#include "render/frames/frame_record.h"
#include "render/truth/visibility_mask.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// Marks pixels without motion: nothing is hit, or the point lies behind the other camera or nearer
/// than its near plane. The value is Middlebury's marker for unknown flow.
inline constexpr float kNoMotion = 1e10F;

/// Optical flow by pixel, row 0 at the top.
struct MotionField {
    std::vector<Eigen::Vector2f> motion;  // px, right and down; kNoMotion in both if unknown
    std::vector<PixelVisibility> sight;   // visibility in the other image
};

/// Optical flow to another frame of the dataset. `other_frame` is an index in the exported frames.
/// Moving objects are taken into account.
[[nodiscard]] MotionField motionField(const FrameContext& context, const FrameRecord& frame,
                                      int other_frame);

/// Scene flow by pixel: the surface point's position in the other frame's camera axes minus that in
/// this frame's (x right, y down, z forward), m. kNoMotion in all three where nothing is hit.
[[nodiscard]] std::vector<Eigen::Vector3f> sceneFlow(const FrameContext& context,
                                                     const FrameRecord& frame, int other_frame);

/// Displacement to another camera with the same intrinsics at the same time, as for stereo.
[[nodiscard]] MotionField parallaxField(const FrameContext& context, const FrameRecord& frame,
                                        const Pose& other_camera);

}  // namespace dollytrack::render
