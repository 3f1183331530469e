#pragma once

#include <Eigen/Core>

#include <array>

namespace dollytrack::render {

/// What a surface does with light, in the metallic-roughness model of glTF 2.0 (appendix B): GGX
/// with Smith's height-correlated masking and Schlick's Fresnel over a diffuse base. What single
/// reflections on the microfacets lose is given back (Turquin, Practical multiple scattering
/// compensation, 2019), and the base gets what the dielectric layer lets through on the way in and
/// out (Kelemen & Szirmay-Kalos 2001): a white surface reflects all light, at any roughness.
/// Directions are unit vectors away from the surface, with z along its normal.
class SurfaceBrdf {
  public:
    SurfaceBrdf(const Eigen::Vector3f& base_color, double metallic, double roughness,
                const Eigen::Vector3d& out);

    /// The BRDF, 1/sr; without the cosine. Zero below the surface.
    [[nodiscard]] Eigen::Vector3f value(const Eigen::Vector3d& in) const;

    /// Density with which sample() takes a direction, 1/sr.
    [[nodiscard]] double density(const Eigen::Vector3d& in) const;

    /// A direction where light may come from; below the surface where the choice failed. `which`
    /// chooses between the layers.
    [[nodiscard]] Eigen::Vector3d sample(double which, const std::array<double, 2>& where) const;

  private:
    Eigen::Vector3d out_;
    Eigen::Vector3f base_;
    float metallic_;
    double roughness_;
    double alpha_;
    double out_masking_;     // Smith's lambda
    float glossy_share_;     // of the samples
    float let_out_;          // by the dielectric layer, towards `out`
    float let_in_norm_;      // 1 / what it lets through on average
    float dielectric_gain_;  // compensation of lost light
    Eigen::Vector3f metal_gain_;
};

}  // namespace dollytrack::render
