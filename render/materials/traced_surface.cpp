#include "render/materials/traced_surface.h"

#include "engine/scene/srgb.h"
#include "render/materials/ggx.h"
#include "render/materials/layer_albedo.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

/// Bilinear texture lookup with repeat; `decoded` converts colour bytes, alpha is linear.
Eigen::Vector4f texelAt(const Texture& texture, const Eigen::Vector2f& uv,
                        const std::array<float, 256>& decoded) {
    const auto wrapped = [](float value, int size, int& low, int& high) {
        if (!std::isfinite(value)) value = 0.0F;
        const float place = (value - std::floor(value)) * static_cast<float>(size) - 0.5F;
        const float base = std::floor(place);
        low = (static_cast<int>(base) % size + size) % size;
        high = (low + 1) % size;
        return place - base;
    };
    int x[2];
    int y[2];
    const float right = wrapped(uv.x(), texture.width, x[0], x[1]);
    const float down = wrapped(1.0F - uv.y(), texture.height, y[0], y[1]);
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    for (int k = 0; k < 4; ++k) {
        const float weight =
            ((k & 1) != 0 ? right : 1.0F - right) * ((k & 2) != 0 ? down : 1.0F - down);
        const std::size_t at = 4 * (static_cast<std::size_t>(y[k >> 1]) * texture.width + x[k & 1]);
        sum += weight * Eigen::Vector4f(decoded[texture.rgba[at]], decoded[texture.rgba[at + 1]],
                                        decoded[texture.rgba[at + 2]],
                                        static_cast<float>(texture.rgba[at + 3]) / 255.0F);
    }
    return sum;
}

}  // namespace

TracedSurface::TracedSurface(const Scene& scene, const MovedShape* moved)
    : scene_(scene),
      positions_(moved ? moved->positions : scene.positions),
      normals_(moved ? moved->normals : scene.normals),
      kinds_(surfaceKinds(scene)) {
    any_seen_through_ =
        std::ranges::any_of(kinds_, [](Surface kind) { return kind != Surface::Opaque; });
    for (std::size_t i = 0; i < linear_.size(); ++i) {
        plain_[i] = static_cast<float>(i) / 255.0F;
        linear_[i] = linearFromSrgb(plain_[i]);
    }
}

std::array<Eigen::Vector3d, 3> TracedSurface::corners(std::uint32_t triangle) const {
    const Triangle& t = scene_.triangles[triangle];
    return {positions_[t[0]].cast<double>(), positions_[t[1]].cast<double>(),
            positions_[t[2]].cast<double>()};
}

SurfacePoint TracedSurface::at(const Eigen::Vector3d& origin, const Eigen::Vector3d& way,
                               const RayHit& hit) const {
    const auto [a, b, c] = corners(hit.triangle);
    const Eigen::Vector3d ab = b - a;
    const Eigen::Vector3d ac = c - a;
    const Eigen::Vector3d across = ab.cross(ac);
    const double squared = across.squaredNorm();
    // Recomputed from the triangle, because the ray's distance is a float; degenerate triangles
    // keep the ray's point.
    double v = 0.0;
    double w = 0.0;
    Eigen::Vector3d guess = origin + way * hit.distance;
    if (squared > 0.0) {
        v = (guess - a).cross(ac).dot(across) / squared;
        w = ab.cross(guess - a).dot(across) / squared;
        v = std::clamp(v, 0.0, 1.0);
        w = std::clamp(w, 0.0, 1.0 - v);
        guess = a + v * ab + w * ac;
    }
    SurfacePoint point;
    point.position = guess;
    point.face = squared > 0.0 ? Eigen::Vector3d(across / std::sqrt(squared)) : -way;
    if (point.face.dot(way) > 0.0) point.face = -point.face;

    const Triangle& t = scene_.triangles[hit.triangle];
    const double u = 1.0 - v - w;
    Eigen::Vector3d n = u * normals_[t[0]].cast<double>() + v * normals_[t[1]].cast<double>() +
                        w * normals_[t[2]].cast<double>();
    n = n.squaredNorm() > 1e-12 ? Eigen::Vector3d(n.normalized()) : point.face;
    const std::uint32_t index = scene_.triangle_material[hit.triangle];
    const Material& material = scene_.materials[index];
    const Eigen::Vector2f uv = uvAt(t, v, w);
    const double side = n.dot(point.face) < 0.0 ? -1.0 : 1.0;
    if (hasMap(scene_, material.normal_map)) n = mappedNormal(material, t, uv, n);
    n *= side;
    // A visible surface does not face away; see surface.frag.
    n -= std::max(n.dot(way) + 1e-3, 0.0) * way;
    point.normal = n.normalized();

    point.kind = kinds_[index];
    point.base_color = material.base_color;
    float alpha = 1.0F;
    if (const auto color = mapAt(material.texture, uv, linear_)) {
        point.base_color = point.base_color.cwiseProduct(color->head<3>());
        alpha = (*color)[3];
    }
    point.roughness = material.roughness;
    point.metallic = plainMetallic(scene_, material);
    point.emission = plainEmission(material);
    if (material.hasMaps()) {
        if (const auto map = mapAt(material.roughness_map, uv, plain_))
            point.roughness *= (*map)[1];
        if (const auto map = mapAt(material.metallic_map, uv, plain_)) point.metallic *= (*map)[2];
        if (const auto map = mapAt(material.emission_map, uv, linear_)) {
            point.emission = material.emission.cwiseProduct(map->head<3>());
        }
    }
    point.hole = point.kind == Surface::CutOut && alpha < kHoleBelow;
    if (point.kind == Surface::Glass) point.opacity = material.opacity * alpha;
    return point;
}

Eigen::Vector2f TracedSurface::uvAt(const Triangle& t, double v, double w) const {
    if (scene_.uvs.size() != scene_.positions.size()) return Eigen::Vector2f::Zero();
    return static_cast<float>(1.0 - v - w) * scene_.uvs[t[0]] +
           static_cast<float>(v) * scene_.uvs[t[1]] + static_cast<float>(w) * scene_.uvs[t[2]];
}

std::optional<Eigen::Vector4f> TracedSurface::mapAt(int map, const Eigen::Vector2f& uv,
                                                    const std::array<float, 256>& decoded) const {
    if (!hasMap(scene_, map) || scene_.uvs.size() != scene_.positions.size()) return std::nullopt;
    return texelAt(scene_.textures[map], uv, decoded);
}

Eigen::Vector3f TracedSurface::emissionAt(std::uint32_t triangle, double v, double w) const {
    const Material& material = scene_.materials[scene_.triangle_material[triangle]];
    const auto map = mapAt(material.emission_map, uvAt(scene_.triangles[triangle], v, w), linear_);
    return map ? Eigen::Vector3f(material.emission.cwiseProduct(map->head<3>()))
               : plainEmission(material);
}

// As in surface.frag.
Eigen::Vector3d TracedSurface::mappedNormal(const Material& material, const Triangle& t,
                                            const Eigen::Vector2f& uv,
                                            const Eigen::Vector3d& normal) const {
    const auto map = mapAt(material.normal_map, uv, plain_);
    if (!map) return normal;
    const Eigen::Vector3d ab = (positions_[t[1]] - positions_[t[0]]).cast<double>();
    const Eigen::Vector3d ac = (positions_[t[2]] - positions_[t[0]]).cast<double>();
    const Eigen::Vector2d uv_ab = (scene_.uvs[t[1]] - scene_.uvs[t[0]]).cast<double>();
    const Eigen::Vector2d uv_ac = (scene_.uvs[t[2]] - scene_.uvs[t[0]]).cast<double>();
    const double turn = uv_ab.x() * uv_ac.y() - uv_ab.y() * uv_ac.x();
    Eigen::Vector3d along_u = (ab * uv_ac.y() - ac * uv_ab.y()) * turn;
    along_u -= along_u.dot(normal) * normal;
    if (!(along_u.squaredNorm() > 0.0)) return normal;
    along_u.normalize();
    const Eigen::Vector3d along_v = (ac * uv_ab.x() - ab * uv_ac.x()) * turn;
    Eigen::Vector3d across = normal.cross(along_u);
    if (across.dot(along_v) < 0.0) across = -across;
    const Eigen::Vector3d said = 2.0 * map->head<3>().cast<double>() - Eigen::Vector3d::Ones();
    const double scale = material.normal_scale;
    return (scale * said.x() * along_u + scale * said.y() * across +
            std::max(said.z(), 0.01) * normal)
        .normalized();
}

Eigen::Vector3d liftedOff(const SurfacePoint& point, const Eigen::Vector3d& way) {
    const double lift = 2e-5 * (1.0 + point.position.cwiseAbs().maxCoeff());
    return point.position + (way.dot(point.face) >= 0.0 ? lift : -lift) * point.face;
}

double sheetReflectance(double cosine) {
    const double face = kDielectricF0 + (1.0 - kDielectricF0) * schlick(cosine);
    return 2.0 * face / (1.0 + face);
}

}  // namespace dollytrack::render
