#pragma once

#include "engine/geometry/ray_caster.h"
#include "planning/visibility/view_estimator.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace dollytrack::planning {

/// Sample points on each target's surface; rays to them estimate its visible share.
class TargetSamples {
  public:
    static constexpr int kPerObject = 4;

    explicit TargetSamples(const ViewEstimator& views);

    struct Target {
        int object_id = 0;
        std::array<Eigen::Vector3d, kPerObject> points;  // world, m
    };
    [[nodiscard]] const std::vector<Target>& targets() const { return targets_; }

  private:
    std::vector<Target> targets_;
};

/// The targets visible from one position, and how well each viewing direction shows them. Four
/// rays per target: enough to rank directions, not to decide what is captured.
class Panorama {
  public:
    Panorama(const ViewEstimator& views, const TargetSamples& samples,
             const Eigen::Vector3d& place);

    /// Calls visit(target, share) for each target that a view in this direction shows; `target` is
    /// its index in the samples, `share` grows from 0 to 1 with its size in the image.
    template <class Visitor>
    void visitShown(const Eigen::Vector3d& direction, Visitor&& visit) const {
        const Eigen::Matrix3d camera_from_world =
            lookAlong(direction).conjugate().toRotationMatrix();
        for (const VisibleTarget& seen : visible_targets_) {
            if (direction.dot(seen.axis) < seen.least_cosine) continue;
            const double share = shownShare(camera_from_world, seen);
            if (share > 0.0) visit(seen.target, share);
        }
    }

  private:
    struct VisibleTarget {
        std::size_t target = 0;
        double pixels = 0.0;                   // silhouette area at the centre of a 640 x 480 image
        std::vector<Eigen::Vector3d> visible;  // from the camera position to visible
                                               // sample points
        Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // to the centre of those points
        double least_cosine = -1.0;  // smallest cosine between axis and view at which the image can
                                     // show a sample
    };
    void boundDirections(VisibleTarget& seen) const;
    [[nodiscard]] double shownShare(const Eigen::Matrix3d& camera_from_world,
                                    const VisibleTarget& seen) const;

    Eigen::Vector2d half_size_;  // of the image at depth 1
    std::vector<VisibleTarget> visible_targets_;
};

}  // namespace dollytrack::planning
