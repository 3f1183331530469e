#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/materials/surface_kind.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// World positions and normals of all vertices while objects have moved, in the order of
/// Scene::positions and Scene::normals.
struct MovedShape {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
};

/// Surface properties at a ray hit.
struct SurfacePoint {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d face = Eigen::Vector3d::UnitZ();    // triangle normal, on the ray's side
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // shading normal, on the ray's side
    Eigen::Vector3f base_color = Eigen::Vector3f::Ones();
    Eigen::Vector3f emission = Eigen::Vector3f::Zero();
    float metallic = 0.0F;
    float roughness = 1.0F;
    double opacity = 1.0;  // of glass; 1: no light passes
    bool hole = false;     // hole of a cut-out: nothing is here
    Surface kind = Surface::Opaque;
};

/// The point moved off its surface, to the side that `way` leads to, by more than float rounding.
[[nodiscard]] Eigen::Vector3d liftedOff(const SurfacePoint& point, const Eigen::Vector3d& way);

/// Looks up the shading properties of a scene's surfaces. Keeps references to the scene and
/// `moved`.
class TracedSurface {
  public:
    TracedSurface(const Scene& scene, const MovedShape* moved);

    /// Properties at a hit along origin + t * way; `way` is a unit vector.
    [[nodiscard]] SurfacePoint at(const Eigen::Vector3d& origin, const Eigen::Vector3d& way,
                                  const RayHit& hit) const;

    [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::uint32_t triangle) const;

    /// Emission at the point corner 0 + v * edge to 1 + w * edge to 2 of a triangle.
    [[nodiscard]] Eigen::Vector3f emissionAt(std::uint32_t triangle, double v, double w) const;
    /// Whether the scene has any glass or cut-outs.
    [[nodiscard]] bool anySeenThrough() const { return any_seen_through_; }

  private:
    /// Bilinear lookup in a texture map; nothing if there is no map.
    [[nodiscard]] std::optional<Eigen::Vector4f> mapAt(int map, const Eigen::Vector2f& uv,
                                                       const std::array<float, 256>& decoded) const;
    [[nodiscard]] Eigen::Vector2f uvAt(const Triangle& triangle, double v, double w) const;
    /// Applies a normal map to the smoothed normal, given on the triangle's front side.
    [[nodiscard]] Eigen::Vector3d mappedNormal(const Material& material, const Triangle& triangle,
                                               const Eigen::Vector2f& uv,
                                               const Eigen::Vector3d& normal) const;

    const Scene& scene_;
    const std::vector<Eigen::Vector3f>& positions_;
    const std::vector<Eigen::Vector3f>& normals_;
    std::vector<Surface> kinds_;
    bool any_seen_through_ = false;
    std::array<float, 256> linear_{};  // linear values of sRGB bytes
    std::array<float, 256> plain_{};   // values of other bytes, 0..1
};

/// Share that a thin glass sheet reflects with both faces, for the cosine between ray and normal
/// (Schlick; index 1.5).
[[nodiscard]] double sheetReflectance(double cosine);

}  // namespace dollytrack::render
