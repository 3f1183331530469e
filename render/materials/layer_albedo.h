#pragma once

namespace dollytrack::render {

/// Directional albedo of the GGX layer with F0 = f0 and F90 = 1 is f0 * a + b.
struct LayerAlbedo {
    float a = 0.0F;
    float b = 0.0F;

    [[nodiscard]] float at(float f0) const { return f0 * a + b; }
    [[nodiscard]] float all() const { return a + b; }  // for perfectly reflecting facets
};

/// Albedo for the cosine between direction and normal and for glTF roughness, interpolated in a
/// table that is computed at the first call.
[[nodiscard]] LayerAlbedo layerAlbedo(double cosine, double roughness);

/// Cosine-weighted mean over all directions of the albedo for f0 = 0.04, multiplied by gain().
[[nodiscard]] float meanDielectricAlbedo(double roughness);

/// Factor on single scattering that compensates for the energy lost to multiple scattering.
[[nodiscard]] inline float gain(const LayerAlbedo& albedo, float f0) {
    return 1.0F + f0 * (1.0F - albedo.all()) / albedo.all();
}

constexpr float kDielectricF0 = 0.04F;

/// Width of the GGX distribution for glTF roughness, at least 0.045^2 even for a perfect mirror.
[[nodiscard]] inline double ggxWidth(double roughness) {
    return roughness > 0.045 ? roughness * roughness : 0.045 * 0.045;
}

}  // namespace dollytrack::render
