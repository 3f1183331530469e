#pragma once

#include "render/verify/compare/check.h"
#include "render/verify/compare/frame_rays.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::verify {

/// Visibility of a pixel's surface point in another image: the values of the masks beside flow and
/// disparity.
enum PixelVisibility : int {
    kSeen = 0,
    kOccluded = 1,
    kOutside = 2,
    kNothing = 255,
};

/// Another image, into which the pixels of a frame are reprojected.
struct OtherView {
    Pose camera;
    const StoredFrame& frame;  // gives the time of the image

    /// Motion of an object from frame `from` to this one, world frame.
    [[nodiscard]] Eigen::Isometry3d motion(const StoredFrame& from, int object_id) const;
};

/// Position of a pixel's surface point in the other image.
struct ReprojectedPixel {
    bool behind = false;         // nearer than the near plane, or behind the camera
    bool may_be_behind = false;  // may be so within the rounding of the depth
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double off_px = 0.0;   // largest shift of `at` due to the rounding of the depth
    double depth_m = 0.0;  // in the other camera
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // world, at the other image's time
};

/// Reprojects one pixel of a frame. `motion` is that of the object it shows.
ReprojectedPixel reproject(const StoredDataset& dataset, const StoredFrame& from, int x, int y,
                           double metres, double rounding_m, const OtherView& to,
                           const Eigen::Isometry3d& motion);

/// A point whose stored visibility is wrong.
struct WrongVisibility {
    enum class Expected { Seen, Occluded, Inside, Outside };
    std::size_t point = 0;
    Expected expected = Expected::Seen;  // Inside: seen or occluded, but not outside
};

/// Compares the visibility of points in a view (kSeen, kOccluded or kOutside; others are skipped)
/// with the borders of its image and, if the subject has a scene, with ray casts.
std::vector<WrongVisibility> wrongVisibilities(const Subject& subject,
                                               std::span<const std::uint8_t> found,
                                               const std::vector<ReprojectedPixel>& points,
                                               double rounding_m, const OtherView& to);

/// The mask file to check, for findings.
struct VisibilityMaskFile {
    std::string name;
    int frame = 0;
};

/// Compares a visibility mask with ray casts or, without a scene, with the other image's depth (may
/// be null). `reprojected` is by pixel; entries of pixels without depth are not read.
void checkVisibilityMask(const Subject& subject, const Image8& mask,
                         const FrameImages::Depth& depth,
                         const std::vector<ReprojectedPixel>& reprojected, const OtherView& to,
                         const FrameImages::Depth* other_depth, const VisibilityMaskFile& file,
                         Findings& findings);

}  // namespace dollytrack::verify
