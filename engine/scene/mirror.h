#pragma once

namespace dollytrack {

struct Material;
struct Object;
struct Scene;

/// Surfaces rougher than this blur reflected objects beyond recognition.
inline constexpr float kMirrorRoughness = 0.3F;
/// Surfaces less metallic than this reflect too little to show objects.
inline constexpr float kMirrorMetal = 0.5F;

/// Whether reflections in it show objects, at least in places: a roughness map may make parts
/// smooth.
[[nodiscard]] bool isSmooth(const Material& material);
/// Whether it is a mirror: smooth and metallic.
[[nodiscard]] bool isMirror(const Material& material);

[[nodiscard]] bool hasMaterial(const Scene& scene, const Object& object,
                               bool (*that)(const Material& material));

}  // namespace dollytrack
