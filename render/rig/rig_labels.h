#pragma once

#include "engine/camera/lens_model.h"
#include "render/dataset/contents/frame_context.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Images cast through a lens's exact rays at pixel centres, row 0 at the top. Pixels that hit
/// nothing or lie outside the lens's image circle are 0.
struct LensImages {
    std::vector<float> depth_m;  // planar depth or range, depending on the lens; see LensRay
    std::vector<std::uint16_t> instance;
    std::vector<Eigen::Vector3f> normals_in_world;
};

/// Casts one frame of the dataset, with moving objects at that frame's time. Thread-safe.
[[nodiscard]] LensImages castLens(const LensModel& lens, const Pose& pose,
                                  const FrameContext& context, int frame);

}  // namespace dollytrack::render
