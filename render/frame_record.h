#pragma once

#include "engine/math/pose.h"
#include "engine/scene/scene.h"
#include "render/whole_masks.h"

#include <cstddef>
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

    // What only some files need; empty where none of them is written.
    std::vector<Eigen::Vector3f> normals_in_world;  // about unit length, on the camera's side
    std::vector<std::uint8_t> albedo;               // 3 bytes a pixel, sRGB
    std::vector<std::uint8_t> rgb_right;            // of the stereo pair
    std::vector<float> depth_right_m;
    std::vector<float> sensor_light;      // 3 a pixel, through SensorLens::drawn()
    std::vector<WholeMask> whole;         // of the things seen, by rising id
    std::vector<std::uint64_t> whole_px;  // of the same, also beyond the image's borders

    std::vector<std::vector<std::uint8_t>> rig_rgb;  // of each camera of the rig, as `rgb`

    /// The memory that its images take, and those that are made of them while they are written.
    [[nodiscard]] std::size_t bytes() const;

    /// Fills `semantic` from `instance`.
    void labelClasses(const Scene& scene);
};

/// The NYU40 class of each pixel, from the object it belongs to.
[[nodiscard]] std::vector<std::uint8_t> classesOf(const Scene& scene,
                                                  std::span<const std::uint16_t> instance);

/// Planar depth in whole millimetres, rounded; 0 for none and beyond 65.535 m.
[[nodiscard]] std::vector<std::uint16_t> depthInMillimetres(const std::vector<float>& depth_m);

}  // namespace dollytrack::render
