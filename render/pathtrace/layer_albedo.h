#pragma once

namespace dollytrack::render {

/// Directional albedo of the GGX layer with F0 = f0 and F90 = 1 is f0 * a + b.
struct LayerAlbedo {
    float a = 0.0F;
    float b = 0.0F;

    [[nodiscard]] float at(float f0) const { return f0 * a + b; }
    [[nodiscard]] float all() const { return a + b; }  // if every facet were a perfect mirror
};

/// For the cosine between direction and normal, and glTF's roughness; from a table that is computed
/// at the first call.
[[nodiscard]] LayerAlbedo layerAlbedo(double cosine, double roughness);

/// The cosine-weighted mean over all directions of the albedo, gain() included, for f0 = 0.04.
[[nodiscard]] float meanDielectricAlbedo(double roughness);

/// What single reflection is multiplied by to make up for reflections from facet to facet.
[[nodiscard]] inline float gain(const LayerAlbedo& albedo, float f0) {
    return 1.0F + f0 * (1.0F - albedo.all()) / albedo.all();
}

constexpr float kDielectricF0 = 0.04F;

/// Width of the GGX distribution; a perfect mirror is left a little wide.
[[nodiscard]] inline double ggxWidth(double roughness) {
    return roughness > 0.045 ? roughness * roughness : 0.045 * 0.045;
}

}  // namespace dollytrack::render
