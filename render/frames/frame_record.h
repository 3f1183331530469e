#pragma once

#include "engine/io/files/png_writer.h"
#include "engine/math/pose.h"
#include "engine/scene/scene.h"
#include "render/frames/amodal_mask.h"
#include "render/frames/picture_layers.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dollytrack::render {

/// The images of one frame, row 0 at the top. Depth and labels belong to the surface at each
/// pixel's centre; 0 where nothing is hit.
struct FrameRecord {
    int index = 0;  // in the dataset, not the trajectory
    double time_s = 0.0;
    Pose pose;  // world_from_camera
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;        // sRGB, 3 bytes per pixel
    std::vector<float> depth_m;           // planar depth
    std::vector<std::uint16_t> instance;  // object ids
    std::vector<std::uint16_t> semantic;  // class ids, Scene::classes()

    std::shared_ptr<const ClassTable> class_table;  // table of the ids in `semantic`; null: NYU40

    // Optional images; empty unless a file needs them.
    std::vector<Eigen::Vector3f> normals_in_world;  // about unit length, on the camera's side
    std::vector<std::uint8_t> albedo;               // sRGB, 3 bytes per pixel
    std::vector<std::uint8_t> rgb_right;            // right camera of the stereo pair
    std::vector<float> depth_right_m;
    std::vector<float> sensor_light;        // linear, 3 values per pixel, image of
                                            // SensorLens::drawn()
    std::vector<RenderedAmodalMask> whole;  // amodal masks of visible objects, by increasing id
    std::vector<std::uint64_t> whole_px;    // silhouette areas in the same order, including parts
                                            // outside the image

    std::vector<std::vector<std::uint8_t>> rig_rgb;  // by camera of the rig, as `rgb`
    PictureLayers layers;                            // of a path-traced `rgb`

    /// Memory of the images, including those that are derived from them while files are written.
    [[nodiscard]] std::size_t bytes() const;

    /// Fills `semantic` and `class_table` from `instance`.
    void labelClasses(const Scene& scene);
    [[nodiscard]] const ClassTable& classes() const {
        return class_table ? *class_table : ClassTable::nyu40();
    }
};

/// Class id of each pixel's object, in the scene's class table.
[[nodiscard]] std::vector<std::uint16_t> classesOf(const Scene& scene,
                                                   std::span<const std::uint16_t> instance);

/// File format of class ids: 8 bits per pixel, or 16 if the table needs them.
[[nodiscard]] PngFormat classFormat(const ClassTable& table);
[[nodiscard]] std::vector<std::uint8_t> classBytes(const ClassTable& table,
                                                   std::span<const std::uint16_t> classes);

/// Planar depth in millimetres, rounded; 0 for no surface and beyond 65.535 m.
[[nodiscard]] std::vector<std::uint16_t> depthInMillimetres(const std::vector<float>& depth_m);

}  // namespace dollytrack::render
