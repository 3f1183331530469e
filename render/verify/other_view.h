#pragma once

#include "render/verify/check.h"
#include "render/verify/frame_rays.h"

#include <Eigen/Geometry>

#include <vector>

namespace dollytrack::verify {

/// What becomes of a pixel's surface in another picture: the values of the masks beside flow and
/// disparity.
enum Sight : int {
    kSeen = 0,
    kOccluded = 1,
    kOutside = 2,
    kNothing = 255,
};

/// Another picture, into which the pixels of a frame are followed.
struct OtherView {
    Pose camera;
    const StoredFrame& frame;  // when it was taken

    /// How an object has moved from the first frame to this one.
    [[nodiscard]] Eigen::Isometry3d motion(const StoredFrame& from, int object_id) const;
};

/// Where a pixel's surface is in the other picture.
struct Followed {
    bool behind = false;         // nearer than the near plane, or behind the camera
    bool may_be_behind = false;  // within what the depth is rounded by
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double off_px = 0.0;   // the most that the rounding of the depth moves `at`
    double depth_m = 0.0;  // in the other camera
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // world, when the other picture was taken
};

/// Follows one pixel of a frame. `motion` is of what it shows.
Followed follow(const StoredDataset& dataset, const StoredFrame& from, int x, int y, double metres,
                double rounding_m, const OtherView& to, const Eigen::Isometry3d& motion);

/// The file that the masks to check come from, and how findings are reported.
struct SightFile {
    std::string name;
    int frame = 0;
};

/// Compares a mask with what the scene's rays say or, without a scene, with the other picture's
/// depth (may be null). `followed` is by pixel; entries of pixels that show nothing are not read.
void checkSight(const Subject& subject, const Image8& mask, const FrameImages::Depth& depth,
                const std::vector<Followed>& followed, const OtherView& to,
                const FrameImages::Depth* other_depth, const SightFile& file, Findings& findings);

}  // namespace dollytrack::verify
