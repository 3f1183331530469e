#pragma once

#include "engine/scene/scene.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack::planning {

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

}  // namespace dollytrack::planning
