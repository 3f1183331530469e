#pragma once

#include "engine/math/pose.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// The images of one frame, rows from the top. Depth and labels belong to what each pixel's centre
/// sees; 0 where it sees nothing.
struct FrameRecord {
    int index = 0;  // in the dataset
    double time_s = 0.0;
    Pose pose;  // world_from_camera
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;        // 3 bytes a pixel, sRGB
    std::vector<float> depth_m;           // planar: along the viewing axis
    std::vector<std::uint16_t> instance;  // object ids
    std::vector<std::uint8_t> semantic;   // NYU40 class of the object

    /// Fills `semantic` from `instance`.
    void labelClasses(const Scene& scene);
};

/// The NYU40 class of each pixel, from the object it belongs to.
[[nodiscard]] std::vector<std::uint8_t> classesOf(const Scene& scene,
                                                  std::span<const std::uint16_t> instance);

/// Planar depth in whole millimetres, rounded; 0 for none and beyond 65.535 m.
[[nodiscard]] std::vector<std::uint16_t> depthInMillimetres(const std::vector<float>& depth_m);

}  // namespace dollytrack::render
