#pragma once

namespace dollytrack {

struct Material;
struct Object;
struct Scene;

/// What is rougher blurs single things beyond recognition.
inline constexpr float kMirrorRoughness = 0.3F;
/// What is less of a metal reflects too little to be looked into.
inline constexpr float kMirrorMetal = 0.5F;

/// Whether it reflects single things somewhere: a map may make parts of it smooth.
[[nodiscard]] bool isSmooth(const Material& material);
/// And so much that one looks at them: smooth metal.
[[nodiscard]] bool isMirror(const Material& material);

[[nodiscard]] bool hasMaterial(const Scene& scene, const Object& object,
                               bool (*that)(const Material& material));

}  // namespace dollytrack
