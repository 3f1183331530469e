#pragma once

#include "render/frames/frame_context.h"
#include "render/frames/frame_record.h"
#include "render/truth/sight_mask.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::render {

/// Where nothing is seen, or what is seen lies behind the other camera; Middlebury's sign for it.
inline constexpr float kNoMotion = 1e10F;

/// By pixel, rows from the top.
struct MotionField {
    std::vector<Eigen::Vector2f> motion;  // px, right and down; or kNoMotion, both
    std::vector<Sight> sight;             // in the other picture
};

/// Where what each pixel's centre shows lies in another frame of the dataset.
[[nodiscard]] MotionField motionField(const FrameContext& context, const FrameRecord& frame,
                                      int other_frame);

/// The same in the picture of another camera at the same time.
[[nodiscard]] MotionField parallaxField(const FrameContext& context, const FrameRecord& frame,
                                        const Pose& other_camera);

}  // namespace dollytrack::render
