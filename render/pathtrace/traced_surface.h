#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/draw/surface_kind.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// Corners and normals where they differ from the scene's: things that move. World; as
/// Scene::positions and Scene::normals.
struct MovedShape {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;
};

/// What a ray finds.
struct SurfacePoint {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d face = Eigen::Vector3d::UnitZ();    // the triangle's normal, towards the viewer
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // the smoothed one, likewise
    Eigen::Vector3f base_color = Eigen::Vector3f::Ones();
    Eigen::Vector3f emission = Eigen::Vector3f::Zero();
    float metallic = 0.0F;
    float roughness = 1.0F;
    double opacity = 1.0;  // of glass
    bool hole = false;     // of a cut-out: nothing is here
    Surface kind = Surface::Opaque;
};

/// A point just off a surface, on the side the ray goes to: farther than floats round there.
[[nodiscard]] Eigen::Vector3d liftedOff(const SurfacePoint& point, const Eigen::Vector3d& way);

/// A scene's surfaces with all that shading asks of them. Keeps a reference to the scene.
class TracedSurface {
  public:
    TracedSurface(const Scene& scene, const MovedShape* moved);

    /// The point of a hit along origin + t * way; `way` is a unit vector.
    [[nodiscard]] SurfacePoint at(const Eigen::Vector3d& origin, const Eigen::Vector3d& way,
                                  const RayHit& hit) const;

    [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::uint32_t triangle) const;

    /// What a place on a triangle shines with: corner 0 + v * edge to 1 + w * edge to 2.
    [[nodiscard]] Eigen::Vector3f emissionAt(std::uint32_t triangle, double v, double w) const;
    /// Whether light may pass somewhere.
    [[nodiscard]] bool anySeenThrough() const { return any_seen_through_; }

  private:
    /// What a map says, if there is one.
    [[nodiscard]] std::optional<Eigen::Vector4f> mapAt(int map, const Eigen::Vector2f& uv,
                                                       const std::array<float, 256>& decoded) const;
    [[nodiscard]] Eigen::Vector2f uvAt(const Triangle& triangle, double v, double w) const;
    /// The normal that a map makes of the smoothed one, which points out of the file's front.
    [[nodiscard]] Eigen::Vector3d mappedNormal(const Material& material, const Triangle& triangle,
                                               const Eigen::Vector2f& uv,
                                               const Eigen::Vector3d& normal) const;

    const Scene& scene_;
    const std::vector<Eigen::Vector3f>& positions_;
    const std::vector<Eigen::Vector3f>& normals_;
    std::vector<Surface> kinds_;
    bool any_seen_through_ = false;
    std::array<float, 256> linear_{};  // of sRGB bytes
    std::array<float, 256> plain_{};   // of others
};

/// What a thin sheet of glass throws back, on both its faces together, for the cosine between ray
/// and normal (Schlick; index 1.5).
[[nodiscard]] double sheetReflectance(double cosine);

}  // namespace dollytrack::render
