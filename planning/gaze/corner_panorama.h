#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace dollytrack::planning {

class ViewEstimator;

/// How densely the textures of a scene are covered with corners, at all scales.
class TextureCorners {
  public:
    explicit TextureCorners(const Scene& scene);

    /// Corners per image pixel where a pixel covers `texels` x `texels` texels around `uv`.
    [[nodiscard]] double perPixel(int texture, const Eigen::Vector2f& uv, double texels) const;
    /// Mean sRGB-encoded grey value of a texture, 0 to 1; 1 for -1, no texture.
    [[nodiscard]] double brightness(int texture) const;

  private:
    struct Level {
        int width = 0, height = 0;   // texels
        std::vector<float> density;  // corners per texel, by block
    };
    struct Detail {
        double scale = 1.0;  // texels of the first level per texel of the texture
        double brightness = 1.0;
        std::vector<Level> levels;  // each half as large as the one before
    };
    std::vector<Detail> textures_;
};

/// Estimates how many corners a feature detector finds in views from one position, by rays all
/// around: junctions between surfaces of different brightness, and corners of their textures. The
/// weights are fitted to the corners that ORB (FAST with threshold 20, 8 scales) finds in rendered
/// images. Keeps no references.
class CornerPanorama {
  public:
    CornerPanorama(const ViewEstimator& views, const TextureCorners& textures,
                   const Eigen::Vector3d& position);

    /// Number of corners in the image of a view without roll, scaled to a width of 320 pixels.
    [[nodiscard]] double corners(const Eigen::Vector3d& direction) const;

  private:
    struct Cell {
        Eigen::Vector3f direction;
        float corners = 0.0F;
    };
    Eigen::Vector2f half_size_;  // of the image at depth 1
    std::vector<Cell> cells_;    // those with corners
};

/// Corner panoramas by position, made when first asked for. Thread-safe. Keeps a reference to
/// `views`.
class CornerPanoramas {
  public:
    explicit CornerPanoramas(const ViewEstimator& views);
    [[nodiscard]] std::shared_ptr<const CornerPanorama> at(const Eigen::Vector3d& position);

  private:
    const ViewEstimator& views_;
    TextureCorners textures_;
    std::mutex mutex_;
    std::map<std::array<double, 3>, std::shared_ptr<const CornerPanorama>> made_;
};

}  // namespace dollytrack::planning
