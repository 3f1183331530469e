#pragma once

#include "engine/io/files/png_writer.h"
#include "engine/math/pose.h"
#include "engine/scene/scene.h"
#include "render/amodal/whole_masks.h"

#include <cstddef>
#include <cstdint>
#include <memory>
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
    std::vector<std::uint16_t> semantic;  // ids of the objects' classes, Scene::classes()

    std::shared_ptr<const ClassTable> class_table;  // whose ids `semantic` has; null: NYU40

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

    /// Fills `semantic` from `instance`, and says of which table.
    void labelClasses(const Scene& scene);
    [[nodiscard]] const ClassTable& classes() const {
        return class_table ? *class_table : ClassTable::nyu40();
    }
};

/// The id of each pixel's class, from the object it belongs to, in the scene's table of classes.
[[nodiscard]] std::vector<std::uint16_t> classesOf(const Scene& scene,
                                                   std::span<const std::uint16_t> instance);

/// Ids of classes as files have them: 8 bits each, or 16 where the table needs them.
[[nodiscard]] io::PngFormat classFormat(const ClassTable& table);
[[nodiscard]] std::vector<std::uint8_t> classBytes(const ClassTable& table,
                                                   std::span<const std::uint16_t> classes);

/// Planar depth in whole millimetres, rounded; 0 for none and beyond 65.535 m.
[[nodiscard]] std::vector<std::uint16_t> depthInMillimetres(const std::vector<float>& depth_m);

}  // namespace dollytrack::render
