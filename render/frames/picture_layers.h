#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace dollytrack::render {

/// The light of a path-traced image before the tone curve, split as in Hypersim (Roberts et al.,
/// ICCV 2021): light = reflectance * (direct + indirect) + residual. Linear RGB, row 0 at the top;
/// light 1 is white in the finished image.
struct PictureLayers {
    std::vector<Eigen::Vector3f> reflectance;  // diffuse reflectance of the visible surface, 0..1
    // Diffuse illumination: light that a white surface would reflect, from light sources directly
    // and from other surfaces. Where the surface reflects nothing it is a guess, or 0.
    std::vector<Eigen::Vector3f> direct;
    std::vector<Eigen::Vector3f> indirect;
    std::vector<Eigen::Vector3f>
        residual;  // glossy reflections, visible emission, and the backdrop

    [[nodiscard]] bool empty() const { return reflectance.empty(); }
    [[nodiscard]] std::size_t size() const { return reflectance.size(); }
    /// The light of a pixel.
    [[nodiscard]] Eigen::Vector3f light(std::size_t i) const {
        return reflectance[i].cwiseProduct(direct[i] + indirect[i]) + residual[i];
    }
};

}  // namespace dollytrack::render
