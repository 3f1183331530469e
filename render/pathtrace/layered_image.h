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

    /// Mean radiance of a pixel.
    [[nodiscard]] Eigen::Vector3f at(int x, int y) const {
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (const auto& set : sets) sum += set[i].sum();
        return sum / static_cast<float>(samples);
    }
};

/// The mean over an image's samples; light is multiplied by `scale`, the exposure times pi.
[[nodiscard]] PictureLayers averaged(const LayeredImage& image, float scale);

/// The same with less noise. Each layer becomes, in small windows, a linear function of the normals
/// and positions of its surfaces (first-order regression, Bitterli et al., Nonlinearly weighted
/// first-order regression for denoising Monte Carlo renderings, 2016). Pixels count by how similar
/// their surfaces are, and their light in relation to the noise. Diffuse light is divided by the
/// reflectance before, so that textures stay sharp. Results do not depend on the number of threads.
/// `image` needs two sets with the same number of samples.
[[nodiscard]] PictureLayers denoised(const LayeredImage& image, float scale);

/// Rows above and below one that its denoised values depend on. Parts of an image whose first row
/// is a multiple of a quarter of it are denoised as in the whole image.
constexpr int kDenoisedRows = 24;

/// The finished image, through the tone curve: sRGB, 3 bytes per pixel.
[[nodiscard]] std::vector<std::uint8_t> developed(const PictureLayers& layers);

}  // namespace dollytrack::render
