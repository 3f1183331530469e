#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/geometry/ray_caster.h"
#include "engine/math/pose.h"
#include "engine/plan/capture.h"
#include "engine/scene/scene.h"
#include "planning/visibility/scanned_surfaces.h"
#include "planning/visibility/slab_hull.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace dollytrack::planning {

/// Answers "how does this object show from here?" by rays, without drawing anything.
/// Keeps references: scene and rays must outlive it. Const, usable from many threads.
class ViewEstimator {
  public:
    ViewEstimator(const Scene& scene, const RayCaster& rays, const CameraParams& camera);

    struct Estimate {
        double visible_fraction = 0.0;  // as ObjectView defines it
        double visible_px = 0.0;        // as if the image were 640 x 480
        double box_share = 0.0;
        double mask_share = 0.0;
        Eigen::AlignedBox2d visible_box;  // around the visible part, px; empty without one
        int rays_on_silhouette = 0;
        bool cropped = false;         // part of the silhouette lies outside the image
        int occluder = 0;             // id of the object that hides most of it
        double occluder_share = 0.0;  // of the silhouette, hidden by that object

        /// Whether enough rays met the silhouette for its visible fraction to say anything.
        [[nodiscard]] bool tells() const { return rays_on_silhouette >= 6; }
    };

    /// Rays through the middles of an even grid of about `grid` x `grid` cells over the object's
    /// extent in the image; never denser than the pixels.
    [[nodiscard]] Estimate estimate(const Pose& pose, int object_id, int grid) const;

    /// The grid by which is decided what counts as captured: a denser one changes no answer.
    static constexpr int kExactGrid = 72;
    [[nodiscard]] Estimate estimateExactly(const Pose& pose, int object_id) const {
        return estimate(pose, object_id, kExactGrid);
    }

    /// As estimate(); where the silhouette is but a small part of its extent, as of a thin thing
    /// seen aslant, with as many cells more as `least_rays` on it ask for.
    [[nodiscard]] Estimate estimateClosely(const Pose& pose, int object_id, int grid,
                                           int least_rays = 200) const;

    /// Of a scan: the share of the image that shows the front of scanned surface, by few rays; the
    /// rest shows what was not scanned, or the backs of walls. 1 for a modelled scene.
    [[nodiscard]] double scannedShare(const Pose& pose) const;

    /// Extent of the object's silhouette on the unbounded image, px; nothing when part of it is
    /// behind the near plane. At most a few per cent too large.
    [[nodiscard]] std::optional<Eigen::AlignedBox2d> extent(const Pose& pose, int object_id) const;

    /// Extreme points of the object, world: their convex hull is nearly the object's own.
    [[nodiscard]] const std::vector<Eigen::Vector3d>& extremes(int object_id) const {
        return extremes_[static_cast<std::size_t>(object_id) - 1];
    }

    [[nodiscard]] const Intrinsics& intrinsics() const { return intrinsics_; }
    [[nodiscard]] const RayCaster& rays() const { return *rays_; }
    [[nodiscard]] const ScannedSurfaces& surfaces() const { return surfaces_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] double nearDistance() const { return near_m_; }

  private:
    struct Scratch;
    /// One ray a cell that meets the object's hull.
    Scratch& aimRays(const Pose& pose, const Eigen::AlignedBox2d& area, double cell,
                     const SlabHull::From& hull) const;
    [[nodiscard]] Estimate trace(const Pose& pose, int object_id, double cell,
                                 Scratch& scratch) const;

    const Scene* scene_;
    const RayCaster* rays_;
    ScannedSurfaces surfaces_;
    Intrinsics intrinsics_;
    double near_m_;
    std::vector<std::vector<Eigen::Vector3d>> extremes_;
    std::vector<SlabHull> hulls_;
};

/// How the object shows in a frame of a trajectory.
ObjectView makeView(const ViewEstimator::Estimate& estimate, int object_id, int frame);

}  // namespace dollytrack::planning
