#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/pointcloud/point_cloud.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace dollytrack::io {

/// Pictures that hold a cloud's colours: each triangle has a square of 4 x 4 texels, half of which
/// it covers.
class CloudTexture {
  public:
    /// Room for this many triangles.
    explicit CloudTexture(std::size_t triangles);

    [[nodiscard]] std::size_t pictures() const { return pictures_; }
    [[nodiscard]] std::size_t pictureOf(std::size_t triangle) const;
    /// Texture coordinates of a triangle's corner (0, 1, 2); v grows upwards.
    [[nodiscard]] Eigen::Vector2f uv(std::size_t triangle, std::size_t corner) const;

    /// The pictures, each texel of the colour that the cloud has nearest to it (within `reach_m`;
    /// else nearest to the triangle's corner).
    /// `corners` has three places for each triangle, in the order of the triangles.
    [[nodiscard]] std::vector<TextureRequest> paint(std::span<const Eigen::Vector3d> corners,
                                                    const PointCloud& cloud_m,
                                                    double reach_m) const;

  private:
    std::size_t triangles_;
    std::size_t per_row_;      // squares
    std::size_t per_picture_;  // squares
    std::size_t pictures_;
};

}  // namespace dollytrack::io
