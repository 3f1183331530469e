#pragma once

#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/light/irradiance_grid.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Hit of a ray from a grid cell. Millions are stored while baking, so they are small.
struct LightBounce {
    static constexpr std::uint32_t kSky = 0xFFFFFFFF;

    float distance_m = 0.0F;               // 0: nothing was hit
    std::uint32_t cell = 0;                // cell whose light falls on the hit point
    std::uint32_t material = kSky;         // index in Scene::materials; kSky for windows
    std::array<std::int16_t, 3> turned{};  // normal as 16-bit integers, see normal()
    bool outside = false;                  // the object shows the outside, see showsOutside()

    [[nodiscard]] bool isSky() const { return material == kSky; }
    /// Unit normal on the ray's side; zero for the sky.
    [[nodiscard]] Eigen::Vector3f normal() const {
        constexpr float kUnit = 1.0F / 32767.0F;
        return {kUnit * turned[0], kUnit * turned[1], kUnit * turned[2]};
    }
};

/// Rays from the centres of all grid cells, evenly distributed over the sphere, and their hits.
/// Each cell's set of rays is randomly rotated about z, so that cells do not all miss the same
/// detail.
class LightBounces {
  public:
    LightBounces(const Scene& scene, const RayCaster& rays, const IrradianceGrid& cells,
                 int per_cell);

    /// Casts a cell's rays. Different cells may be processed on different threads.
    void follow(std::size_t cell, Random& random);

    [[nodiscard]] std::size_t perCell() const { return spiral_.size(); }
    [[nodiscard]] const LightBounce& of(std::size_t cell, std::size_t ray) const {
        return bounces_[cell * perCell() + ray];
    }
    /// Unit direction of a ray.
    [[nodiscard]] Eigen::Vector3d way(std::size_t cell, std::size_t ray) const {
        return (turns_[cell] * spiral_[ray]).cast<double>().normalized();
    }
    /// Direction before the cell's rotation, and that rotation, for sums over rays.
    [[nodiscard]] const Eigen::Vector3f& unturned(std::size_t ray) const { return spiral_[ray]; }
    [[nodiscard]] const Eigen::Matrix3f& turn(std::size_t cell) const { return turns_[cell]; }

  private:
    [[nodiscard]] LightBounce cast(const Eigen::Vector3d& from, const Eigen::Vector3d& way) const;

    const Scene& scene_;
    const RayCaster& rays_;
    const IrradianceGrid& cells_;
    std::vector<bool> outside_;            // by object's id - 1
    std::vector<Eigen::Vector3f> spiral_;  // by ray
    std::vector<Eigen::Matrix3f> turns_;   // by cell
    std::vector<LightBounce> bounces_;     // by cell, then ray
};

}  // namespace dollytrack::render
