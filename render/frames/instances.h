#pragma once

#include "engine/math/pose.h"
#include "engine/scene/scene.h"
#include "render/frames/frame_record.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// How a frame shows one object. Of structure there is none.
struct InstanceInFrame {
    int object_id = 0;
    std::uint32_t visible_px = 0;
    std::uint32_t silhouette_px = 0;  // inside the image, with nothing before it
    std::uint64_t whole_px = 0;       // also beyond the image's borders, by up to 3 of its sizes
    int occluder = 0;                 // id of the object that hides most of the silhouette
    std::uint32_t occluded_px = 0;    // of the silhouette, by that one
    std::array<int, 4> box = {0, 0, 0, 0};         // of the visible pixels: x, y, width, height
    std::array<int, 4> amodal_box = {0, 0, 0, 0};  // of the silhouette inside the image

    [[nodiscard]] double visibleFraction() const {
        return whole_px > 0 ? static_cast<double>(visible_px) / static_cast<double>(whole_px) : 0.0;
    }
    /// Share of the silhouette that lies outside the image.
    [[nodiscard]] double truncation() const {
        return whole_px > 0
                   ? 1.0 - static_cast<double>(silhouette_px) / static_cast<double>(whole_px)
                   : 0.0;
    }
    [[nodiscard]] double occluderFraction() const {
        return silhouette_px > 0
                   ? static_cast<double>(occluded_px) / static_cast<double>(silhouette_px)
                   : 0.0;
    }
    bool operator==(const InstanceInFrame&) const = default;
};

/// By rising id, of those that are seen. The record has `instance`, `whole` and `whole_px`.
[[nodiscard]] std::vector<InstanceInFrame> measureInstances(const FrameRecord& frame);

/// Ids of the objects that are no structure and show in the id image, by rising id.
[[nodiscard]] std::vector<int> thingsSeen(const Scene& scene, const FrameRecord& frame);

/// An object's box in the camera's frame: x right, y down, z forward; m.
struct BoxInCamera {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d size = Eigen::Vector3d::Zero();                // along its own axes
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // camera_from_box
};

/// `motion`: of the object since the scene was as given.
[[nodiscard]] BoxInCamera boxInCamera(const Object& object, const Eigen::Isometry3d& motion,
                                      const Pose& camera);

}  // namespace dollytrack::render
