#pragma once

#include "engine/math/pose.h"
#include "engine/scene/scene.h"
#include "render/frames/frame_record.h"

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Visibility of one object in a frame. Structure (walls, floors, ceilings) has no entries.
struct InstanceInFrame {
    int object_id = 0;
    std::uint32_t visible_px = 0;
    std::uint32_t silhouette_px = 0;  // amodal area inside the image
    std::uint64_t whole_px = 0;       // amodal area, including up to 3 image sizes beyond each
                                      // border
    int occluder = 0;                 // id of the object that covers most of the silhouette, 0:
                                      // none
    std::uint32_t occluded_px = 0;    // silhouette pixels that it covers
    std::array<int, 4> box = {0, 0, 0, 0};         // of the visible pixels: x, y, width, height
    std::array<int, 4> amodal_box = {0, 0, 0, 0};  // of the silhouette inside the image

    [[nodiscard]] double visibleFraction() const {
        return whole_px > 0 ? static_cast<double>(visible_px) / static_cast<double>(whole_px) : 0.0;
    }
    /// Share of the amodal area that lies outside the image.
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

/// Visible objects by increasing id. The record must have `instance`, `whole` and `whole_px`.
[[nodiscard]] std::vector<InstanceInFrame> measureInstances(const FrameRecord& frame);

/// Ids of visible non-structure objects, increasing.
[[nodiscard]] std::vector<int> visibleObjects(const Scene& scene, const FrameRecord& frame);

/// An object's box in the camera frame (x right, y down, z forward), m.
struct BoxInCamera {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d size = Eigen::Vector3d::Zero();                // along the box's own axes
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // camera_from_box
};

/// `motion` moves the object from its position in the scene to that in the frame, world frame.
[[nodiscard]] BoxInCamera boxInCamera(const Object& object, const Eigen::Isometry3d& motion,
                                      const Pose& camera);

}  // namespace dollytrack::render
