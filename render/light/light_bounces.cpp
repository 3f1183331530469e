#include "render/light/light_bounces.h"

#include "render/light/light_rig.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

std::vector<Eigen::Vector3f> evenly(int count) {
    constexpr double kGoldenAngle = 2.399963229728653;
    std::vector<Eigen::Vector3f> ways;
    for (int k = 0; k < count; ++k) {
        const double z = 1.0 - 2.0 * (k + 0.5) / count;
        const double ring = std::sqrt(1.0 - z * z);
        const double angle = k * kGoldenAngle;
        ways.push_back(
            Eigen::Vector3d(ring * std::cos(angle), ring * std::sin(angle), z).cast<float>());
    }
    return ways;
}

}  // namespace

LightBounces::LightBounces(const Scene& scene, const RayCaster& rays, const IrradianceGrid& cells,
                           int per_cell)
    : scene_(scene),
      rays_(rays),
      cells_(cells),
      outside_(showsOutside(scene)),
      spiral_(evenly(per_cell)),
      turns_(cells.count()),
      bounces_(cells.count() * spiral_.size()) {}

void LightBounces::follow(std::size_t cell, Random& random) {
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    turns_[cell] =
        Eigen::AngleAxisf(static_cast<float>(turn), Eigen::Vector3f::UnitZ()).toRotationMatrix();
    for (std::size_t k = 0; k < perCell(); ++k) {
        bounces_[cell * perCell() + k] = cast(cells_.center(cell), way(cell, k));
    }
}

LightBounce LightBounces::cast(const Eigen::Vector3d& from, const Eigen::Vector3d& way) const {
    LightBounce result;
    const RayHit hit = rays_.cast(from, way);
    if (hit.object_id == 0) return result;
    result.distance_m = std::max(static_cast<float>(hit.distance), 1e-6F);
    if (sendsDaylight(scene_.object(hit.object_id))) return result;
    const Triangle& triangle = scene_.triangles[hit.triangle];
    const Eigen::Vector3f a = scene_.positions[triangle[0]];
    Eigen::Vector3f normal =
        (scene_.positions[triangle[1]] - a).cross(scene_.positions[triangle[2]] - a).normalized();
    if (normal.dot(way.cast<float>()) > 0.0F) normal = -normal;
    for (int axis = 0; axis < 3; ++axis) {
        result.turned[axis] = static_cast<std::int16_t>(std::lround(32767.0F * normal[axis]));
    }
    result.material = static_cast<std::uint32_t>(scene_.triangle_material[hit.triangle]);
    result.outside = outside_[hit.object_id - 1];
    const Eigen::Vector3d at = from + way * hit.distance;
    result.cell = static_cast<std::uint32_t>(
        cells_.cellAt(at + normal.cast<double>() * (0.8 * cells_.size_m())));
    return result;
}

}  // namespace dollytrack::render
