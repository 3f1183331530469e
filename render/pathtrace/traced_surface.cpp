#include "render/pathtrace/traced_surface.h"

#include "engine/scene/srgb.h"
#include "render/pathtrace/ggx.h"
#include "render/pathtrace/layer_albedo.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {

TracedSurface::TracedSurface(const Scene& scene, const MovedShape* moved)
    : scene_(scene),
      positions_(moved ? moved->positions : scene.positions),
      normals_(moved ? moved->normals : scene.normals),
      kinds_(surfaceKinds(scene)) {
    any_seen_through_ =
        std::ranges::any_of(kinds_, [](Surface kind) { return kind != Surface::Opaque; });
    for (std::size_t i = 0; i < linear_.size(); ++i) {
        linear_[i] = linearFromSrgb(static_cast<float>(i) / 255.0F);
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
    // Exact where the ray's own distance is rounded to float; slivers keep what the ray says.
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
    if (n.dot(point.face) < 0.0) n = -n;
    // What is seen does not face away; see surface.frag.
    n -= std::max(n.dot(way) + 1e-3, 0.0) * way;
    point.normal = n.normalized();

    const std::uint32_t index = scene_.triangle_material[hit.triangle];
    const Material& material = scene_.materials[index];
    point.material = &material;
    point.kind = kinds_[index];
    point.base_color = material.base_color;
    float alpha = 1.0F;
    if (isTextured(scene_, material) && scene_.uvs.size() == scene_.positions.size()) {
        const Eigen::Vector2f uv = static_cast<float>(u) * scene_.uvs[t[0]] +
                                   static_cast<float>(v) * scene_.uvs[t[1]] +
                                   static_cast<float>(w) * scene_.uvs[t[2]];
        const Eigen::Vector4f color = texel(scene_.textures[material.texture], uv);
        point.base_color = point.base_color.cwiseProduct(color.head<3>());
        alpha = color[3];
    }
    point.hole = point.kind == Surface::CutOut && alpha < kHoleBelow;
    if (point.kind == Surface::Glass) point.opacity = material.opacity * alpha;
    return point;
}

Eigen::Vector4f TracedSurface::texel(const Texture& texture, const Eigen::Vector2f& uv) const {
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
        sum += weight * Eigen::Vector4f(linear_[texture.rgba[at]], linear_[texture.rgba[at + 1]],
                                        linear_[texture.rgba[at + 2]],
                                        static_cast<float>(texture.rgba[at + 3]) / 255.0F);
    }
    return sum;
}

double sheetReflectance(double cosine) {
    const double face = kDielectricF0 + (1.0 - kDielectricF0) * schlick(cosine);
    return 2.0 * face / (1.0 + face);
}

}  // namespace dollytrack::render
