#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"
#include "engine/math/pose.h"
#include "engine/plan/capture.h"
#include "engine/scene/scene.h"
#include "planning/visibility/bounding_dop.h"
#include "planning/visibility/scanned_surfaces.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// Estimates by ray casting how an object appears in a view, without rendering. Keeps references to
/// scene and rays. Immutable; safe to call from many threads.
class ViewEstimator {
  public:
    ViewEstimator(const Scene& scene, const RayCaster& rays, const CameraParams& camera);

    struct Estimate {
        double visible_fraction = 0.0;  // see ObjectView
        double visible_px = 0.0;        // scaled to an image of 640 x 480
        double box_share = 0.0;
        double mask_share = 0.0;
        Eigen::AlignedBox2d visible_box;  // around the visible part, px; empty if nothing is
                                          // visible
        int rays_on_silhouette = 0;
        bool cropped = false;         // whether part of the silhouette lies outside the image
        int occluder = 0;             // id of the object that hides the largest part; 0: none
        double occluder_share = 0.0;  // share of the silhouette hidden by that object

        /// Whether enough rays hit the silhouette (6) for the visible fraction to be meaningful.
        [[nodiscard]] bool tells() const { return rays_on_silhouette >= 6; }
    };

    /// Samples the object's extent in the image with rays on a regular grid of about `grid` x
    /// `grid` square cells, never denser than pixels. Zero if part of the object is nearer than the
    /// near plane; `cropped` if it lies outside the image. Targets only.
    [[nodiscard]] Estimate estimate(const Pose& pose, int object_id, int grid) const;

    /// The grid that decides whether an object is captured; a denser one does not change the
    /// result.
    static constexpr int kExactGrid = 72;
    [[nodiscard]] Estimate estimateExactly(const Pose& pose, int object_id) const {
        return estimate(pose, object_id, kExactGrid);
    }

    /// The same as estimate(), but repeated with a denser grid if fewer than about `least_rays`
    /// rays hit the silhouette, as for a thin object seen obliquely.
    [[nodiscard]] Estimate estimateClosely(const Pose& pose, int object_id, int grid,
                                           int least_rays = 200) const;

    /// For a scan, the share of the image that shows the front of scanned surface, by 16 x 12 rays;
    /// the rest is unobserved or shows backs. 1 for a modelled scene.
    [[nodiscard]] double scannedShare(const Pose& pose) const;

    /// Bounding box of the object's silhouette on the unbounded image, px, at most a few per cent
    /// too large. Empty if part of the object is nearer than the near plane. Targets only.
    [[nodiscard]] std::optional<Eigen::AlignedBox2d> extent(const Pose& pose, int object_id) const;

    /// Up to 26 extreme points of a target, world, m; their convex hull is close to the object's.
    /// Empty for other objects.
    [[nodiscard]] const std::vector<Eigen::Vector3d>& extremes(int object_id) const {
        return extremes_[object_id - 1];
    }

    /// Whether the point lies in the image and beyond the near plane, hidden or not.
    [[nodiscard]] bool inImage(const Pose& pose, const Eigen::Vector3d& point) const;

    [[nodiscard]] const Intrinsics& intrinsics() const { return intrinsics_; }
    [[nodiscard]] const RayCaster& rays() const { return *rays_; }
    [[nodiscard]] const ScannedSurfaces& surfaces() const { return surfaces_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] double nearDistance() const { return near_m_; }

  private:
    struct Scratch;
    /// Creates one ray per cell that meets the object's bounding polytope.
    Scratch& aimRays(const Pose& pose, const Eigen::AlignedBox2d& area, double cell,
                     const BoundingDop::FromOrigin& bounds) const;
    [[nodiscard]] Estimate trace(const Pose& pose, int object_id, double cell,
                                 Scratch& scratch) const;

    const Scene* scene_;
    const RayCaster* rays_;
    ScannedSurfaces surfaces_;
    Intrinsics intrinsics_;
    double near_m_;
    std::vector<std::vector<Eigen::Vector3d>> extremes_;
    std::vector<BoundingDop> bounds_;
};

/// Converts an estimate to the view of an object in a frame.
ObjectView makeView(const ViewEstimator::Estimate& estimate, int object_id, int frame);

}  // namespace dollytrack::planning
