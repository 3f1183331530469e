#pragma once

#include "engine/math/pose.h"
#include "planning/gaze/texture_corners.h"

#include <Eigen/Geometry>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// Estimates how many corners a feature detector finds in views from one position, by rays all
/// around: junctions between surfaces of different brightness, and corners of their textures. The
/// weights are fitted to the corners that ORB (FAST with threshold 20, 8 scales) finds in rendered
/// images. Keeps no references.
class CornerPanorama {
  public:
    CornerPanorama(const ViewEstimator& views, const TextureCorners& textures,
                   const Eigen::Vector3d& position);
    /// Casts only the rays that views in this direction need; corners() of others are too few.
    CornerPanorama(const ViewEstimator& views, const TextureCorners& textures,
                   const Eigen::Vector3d& position, const Eigen::Vector3d& direction);

    /// Number of corners in the image of a view, scaled to a width of 320 pixels, without those
    /// within 16 pixels of its edge; with a direction, of the view without roll.
    [[nodiscard]] double corners(const Eigen::Quaterniond& world_from_camera) const;
    [[nodiscard]] double corners(const Eigen::Vector3d& direction) const;
    /// Number of the corners in the image of the view `world_from_camera` from this position that
    /// also lie in the image of `other`. Occlusion in `other` is ignored.
    [[nodiscard]] double cornersAlsoIn(const Pose& other,
                                       const Eigen::Quaterniond& world_from_camera) const;

  private:
    struct Cell {
        Eigen::Vector3f direction;  // unit, world frame
        float distance_m = 0.0F;
        float corners = 0.0F;
    };
    [[nodiscard]] bool inImage(const Eigen::Vector3f& in_camera) const;
    /// Calls visit(cell) for every cell in the image of a view.
    template <typename Visit>
    void visitImage(const Eigen::Quaterniond& world_from_camera, Visit&& visit) const;
    /// Casts the rays whose cosine with `direction` is at least `least_cosine`.
    void cast(const ViewEstimator& views, const TextureCorners& textures,
              const Eigen::Vector3d& position, const Eigen::Vector3d& direction,
              double least_cosine);

    Eigen::Vector3d position_;   // of the rays, world frame, m
    Eigen::Vector2f half_size_;  // of the image without its border, at depth 1
    std::vector<Cell> cells_;    // those with corners, by rising elevation
};

/// Corner panoramas by position, made when first asked for. Thread-safe. Keeps a reference to
/// `views`.
class CornerPanoramas {
  public:
    explicit CornerPanoramas(const ViewEstimator& views);
    [[nodiscard]] std::shared_ptr<const CornerPanorama> at(const Eigen::Vector3d& position);
    [[nodiscard]] const TextureCorners& textures() const { return textures_; }

  private:
    const ViewEstimator& views_;
    TextureCorners textures_;
    std::mutex mutex_;
    std::map<std::array<double, 3>, std::shared_ptr<const CornerPanorama>> made_;
};

}  // namespace dollytrack::planning
