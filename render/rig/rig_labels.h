#pragma once

#include "engine/camera/lens_model.h"
#include "render/frames/frame_context.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// What the exact rays of a lens through pixel centres meet; rows from the top, 0 where a pixel
/// sees nothing and outside of the lens's image circle.
struct LensImages {
    std::vector<float> depth_m;  // as LensRay has it
    std::vector<std::uint16_t> instance;
    std::vector<Eigen::Vector3f> normals_in_world;
};

/// In a frame of the dataset, with things where they are then. From any thread.
[[nodiscard]] LensImages castLens(const LensModel& lens, const Pose& pose,
                                  const FrameContext& context, int frame);

}  // namespace dollytrack::render
