#pragma once

#include "render/frames/picture_layers.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Light of one path, or the sum over several, split by what the first visible surface does, and
/// that surface itself. Radiance is linear RGB.
struct LayeredLight {
    // Light that the surface reflects diffusely: from light sources, and from other surfaces.
    Eigen::Vector3f direct = Eigen::Vector3f::Zero();
    Eigen::Vector3f indirect = Eigen::Vector3f::Zero();
    Eigen::Vector3f glossy = Eigen::Vector3f::Zero();  // all other reflected light
    Eigen::Vector3f shown = Eigen::Vector3f::Zero();   // visible emission and backdrop

    Eigen::Vector3f reflectance = Eigen::Vector3f::Zero();  // diffuse, without the glossy layer
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f position = Eigen::Vector3f::Zero();  // m, world frame
    float distance = 0.0F;                               // m, from the camera
    float hits = 0.0F;                                   // number of paths that met a surface

    [[nodiscard]] Eigen::Vector3f sum() const { return direct + indirect + glossy + shown; }
    LayeredLight& operator+=(const LayeredLight& other) {
        direct += other.direct;
        indirect += other.indirect;
        glossy += other.glossy;
        shown += other.shown;
        reflectance += other.reflectance;
        normal += other.normal;
        position += other.position;
        distance += other.distance;
        hits += other.hits;
        return *this;
    }
    bool operator==(const LayeredLight&) const = default;
};

/// The layers of an accumulated image: sums over `samples` paths per pixel, row 0 at the top. It
/// may be a part of a whole image, `height` rows from row `first_row` on. With two `sets`, samples
/// alternate between independent sets of random numbers, whose difference shows the noise.
struct LayeredImage {
    int width = 0;
    int height = 0;
    int first_row = 0;
    int first_sample = 0;  // number of the first sample, for its random numbers
    int samples = 0;
    std::vector<std::vector<LayeredLight>> sets = std::vector<std::vector<LayeredLight>>(1);

    /// Sum over all samples of a pixel.
    [[nodiscard]] LayeredLight total(std::size_t pixel) const {
        LayeredLight sum;
        for (const auto& set : sets) sum += set[pixel];
        return sum;
    }
    /// Mean radiance of a pixel.
    [[nodiscard]] Eigen::Vector3f at(int x, int y) const {
        return total(static_cast<std::size_t>(y) * width + x).sum() / static_cast<float>(samples);
    }
};

/// Mean of a layer over all samples, times `scale`.
[[nodiscard]] std::vector<Eigen::Vector3f> meanOf(const LayeredImage& image,
                                                  Eigen::Vector3f LayeredLight::*layer,
                                                  float scale);

/// Channels of a lower reflectance are black: they show no illumination.
constexpr float kBlack = 1e-3F;

/// Diffuse light divided by the reflectance. Black channels get the mean of the other channels, so
/// that neighbours are not darkened by them.
[[nodiscard]] std::vector<Eigen::Vector3f> illumination(
    const std::vector<Eigen::Vector3f>& light, const std::vector<Eigen::Vector3f>& reflectance);

/// The mean over an image's samples; light is multiplied by `scale`, the exposure times pi.
[[nodiscard]] PictureLayers averaged(const LayeredImage& image, float scale);

/// The finished image, through the tone curve: sRGB, 3 bytes per pixel.
[[nodiscard]] std::vector<std::uint8_t> developed(const PictureLayers& layers);

}  // namespace dollytrack::render
