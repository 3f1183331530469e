#pragma once

#include <Eigen/Core>

#include <array>

namespace dollytrack::render {

/// BRDF of the metallic-roughness model of glTF 2.0 (appendix B): GGX with Smith's
/// height-correlated masking and Schlick's Fresnel approximation over a diffuse base. Multiple
/// scattering is compensated (Turquin, Practical multiple scattering compensation, 2019). The base
/// receives what the dielectric layer transmits on the way in and out (Kelemen & Szirmay-Kalos
/// 2001), so a white surface reflects all light at any roughness. Directions are unit vectors away
/// from the surface, with z along its normal.
class SurfaceBrdf {
  public:
    SurfaceBrdf(const Eigen::Vector3f& base_color, double metallic, double roughness,
                const Eigen::Vector3d& out);

    /// The BRDF of each layer, 1/sr, without the cosine.
    struct Layers {
        Eigen::Vector3f glossy = Eigen::Vector3f::Zero();
        float diffuse = 0.0F;  // to be multiplied by the base colour
    };
    /// Zero below the surface.
    [[nodiscard]] Layers layers(const Eigen::Vector3d& in) const;
    /// Their sum, base colour included.
    [[nodiscard]] Eigen::Vector3f value(const Eigen::Vector3d& in) const {
        const Layers found = layers(in);
        return found.glossy + base_ * found.diffuse;
    }

    /// Density of sample(), 1/sr.
    [[nodiscard]] double density(const Eigen::Vector3d& in) const;

    /// Samples a direction to incoming light; it may lie below the surface, which means no light.
    /// `which` chooses between the layers.
    [[nodiscard]] Eigen::Vector3d sample(double which, const std::array<double, 2>& where) const;

  private:
    Eigen::Vector3d out_;
    Eigen::Vector3f base_;
    float metallic_;
    double roughness_;
    double alpha_;
    double out_masking_;     // Smith's lambda
    float glossy_share_;     // share of samples for the glossy layer
    float let_out_;          // share that the dielectric layer transmits towards `out`
    float let_in_norm_;      // 1 / mean transmitted share
    float dielectric_gain_;  // compensation of multiple scattering
    Eigen::Vector3f metal_gain_;
};

}  // namespace dollytrack::render
