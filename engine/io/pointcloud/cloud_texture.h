#pragma once

#include "engine/io/pointcloud/files/point_cloud.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace dollytrack {

/// Textures with a cloud's colours: each triangle covers half of a square of 4 x 4 texels.
/// They keep the colours at the density of the scan, because a Scene has no vertex colours.
class CloudTexture {
  public:
    /// Lays out the textures for this number of triangles.
    explicit CloudTexture(std::size_t triangles);

    [[nodiscard]] std::size_t pictures() const { return pictures_; }
    [[nodiscard]] std::size_t pictureOf(std::size_t triangle) const;
    /// Texture coordinates of a triangle's corner (0, 1, 2); v points up.
    [[nodiscard]] Eigen::Vector2f uv(std::size_t triangle, std::size_t corner) const;

    /// Paints the textures: each texel has the colour of the nearest point within `reach_m`,
    /// otherwise of the point nearest to a corner of the triangle, otherwise grey. `corners` has
    /// three positions per triangle.
    [[nodiscard]] std::vector<TextureRequest> paint(std::span<const Eigen::Vector3d> corners,
                                                    const PointCloud& cloud_m,
                                                    double reach_m) const;

  private:
    std::size_t triangles_;
    std::size_t per_row_;      // squares
    std::size_t per_picture_;  // squares
    std::size_t pictures_;
};

}  // namespace dollytrack
