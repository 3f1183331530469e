#include "render/materials/surface_brdf.h"

#include "render/materials/ggx.h"
#include "render/materials/layer_albedo.h"

namespace dollytrack::render {
namespace {

constexpr double kPiF = std::numbers::pi;

}  // namespace

SurfaceBrdf::SurfaceBrdf(const Eigen::Vector3f& base_color, double metallic, double roughness,
                         const Eigen::Vector3d& out)
    : out_(out),
      base_(base_color.cwiseMax(0.0F).cwiseMin(1.0F)),
      metallic_(static_cast<float>(std::clamp(metallic, 0.0, 1.0))),
      roughness_(std::clamp(roughness, 0.0, 1.0)),
      alpha_(ggxWidth(roughness_)),
      out_masking_(ggxLambda(out, alpha_)) {
    const LayerAlbedo albedo = layerAlbedo(out.z(), roughness_);
    dielectric_gain_ = gain(albedo, kDielectricF0);
    for (int c = 0; c < 3; ++c) metal_gain_[c] = gain(albedo, base_[c]);
    const float layer = albedo.at(kDielectricF0) * dielectric_gain_;
    let_out_ = std::max(0.0F, 1.0F - layer);
    let_in_norm_ = 1.0F / std::max(1e-3F, 1.0F - meanDielectricAlbedo(roughness_));
    float metal = 0.0F;
    for (int c = 0; c < 3; ++c) metal += albedo.at(base_[c]) * metal_gain_[c] / 3.0F;
    const float glossy = (1.0F - metallic_) * layer + metallic_ * metal;
    const float diffuse = (1.0F - metallic_) * let_out_ * base_.mean();
    glossy_share_ = diffuse > 0.0F ? std::clamp(glossy / (glossy + diffuse), 0.1F, 0.9F) : 1.0F;
}

SurfaceBrdf::Layers SurfaceBrdf::layers(const Eigen::Vector3d& in) const {
    if (in.z() <= 0.0 || out_.z() <= 0.0) return {};
    const Eigen::Vector3d facet = (in + out_).normalized();
    const double shape = ggxDensity(facet, alpha_) /
                         (4.0 * in.z() * out_.z() * (1.0 + out_masking_ + ggxLambda(in, alpha_)));
    const auto grazing = static_cast<float>(schlick(in.dot(facet)));
    const float dielectric = dielectric_gain_ * (kDielectricF0 + (1.0F - kDielectricF0) * grazing);
    Eigen::Vector3f glossy;
    for (int c = 0; c < 3; ++c) {
        const float metal = metal_gain_[c] * (base_[c] + (1.0F - base_[c]) * grazing);
        glossy[c] = (1.0F - metallic_) * dielectric + metallic_ * metal;
    }
    const LayerAlbedo albedo = layerAlbedo(in.z(), roughness_);
    const float let_in =
        std::max(0.0F, 1.0F - albedo.at(kDielectricF0) * gain(albedo, kDielectricF0));
    const float diffuse = (1.0F - metallic_) * let_out_ * let_in * let_in_norm_;
    return {static_cast<float>(shape) * glossy, diffuse / static_cast<float>(kPiF)};
}

double SurfaceBrdf::density(const Eigen::Vector3d& in) const {
    if (in.z() <= 0.0 || out_.z() <= 0.0) return 0.0;
    const Eigen::Vector3d facet = (in + out_).normalized();
    const double glossy = ggxDensity(facet, alpha_) / (4.0 * out_.z() * (1.0 + out_masking_));
    return glossy_share_ * glossy + (1.0 - glossy_share_) * in.z() / kPiF;
}

Eigen::Vector3d SurfaceBrdf::sample(double which, const std::array<double, 2>& where) const {
    if (which < glossy_share_) {
        const Eigen::Vector3d facet = ggxVisibleFacet(out_, alpha_, where);
        return 2.0 * out_.dot(facet) * facet - out_;
    }
    const double radius = std::sqrt(where[0]);
    const double angle = 2.0 * kPiF * where[1];
    return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - where[0])};
}

}  // namespace dollytrack::render
