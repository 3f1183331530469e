#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// The light of a path-traced image before the tone curve, split as in Hypersim (Roberts et al.,
/// ICCV 2021): light = reflectance * (direct + indirect) + residual. Linear RGB, row 0 at the top,
/// exposed as the finished image: the tone curve maps 1 to 228 of 255.
struct PictureLayers {
    std::vector<Eigen::Vector3f> reflectance;  // base colour * (1 - metalness), 0..1
    // Diffuse illumination: diffusely reflected light divided by the reflectance, from light
    // sources directly and from other surfaces. Where the surface reflects nothing: a guess, or 0.
    std::vector<Eigen::Vector3f> direct;
    std::vector<Eigen::Vector3f> indirect;
    std::vector<Eigen::Vector3f>
        residual;  // glossy reflections, visible emission, and the backdrop

    [[nodiscard]] bool empty() const { return reflectance.empty(); }
    [[nodiscard]] std::size_t size() const { return reflectance.size(); }
    /// Appends the pixels [begin, end) of another image.
    void append(const PictureLayers& other, std::size_t begin, std::size_t end) {
        const auto copy = [&](std::vector<Eigen::Vector3f>& to,
                              const std::vector<Eigen::Vector3f>& from) {
            to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
                      from.begin() + static_cast<std::ptrdiff_t>(end));
        };
        copy(reflectance, other.reflectance);
        copy(direct, other.direct);
        copy(indirect, other.indirect);
        copy(residual, other.residual);
    }
    /// The layer that a modality of this name writes ("hdr" is the light itself); empty for another
    /// name.
    [[nodiscard]] std::vector<Eigen::Vector3f> named(std::string_view modality) const {
        if (modality == "diffuse_reflectance") return reflectance;
        if (modality == "direct_illumination") return direct;
        if (modality == "indirect_illumination") return indirect;
        if (modality == "residual") return residual;
        const bool is_light = modality == "hdr";
        if (!is_light && modality != "diffuse_illumination") return {};
        std::vector<Eigen::Vector3f> values(size());
        for (std::size_t i = 0; i < size(); ++i) {
            values[i] = is_light ? light(i) : Eigen::Vector3f(direct[i] + indirect[i]);
        }
        return values;
    }
    /// The light of a pixel.
    [[nodiscard]] Eigen::Vector3f light(std::size_t i) const {
        return reflectance[i].cwiseProduct(direct[i] + indirect[i]) + residual[i];
    }
};

}  // namespace dollytrack::render
