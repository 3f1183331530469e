#include "render/light/traced_reflections.h"

#include "engine/jobs/parallel.h"
#include "engine/scene/mirror.h"
#include "render/light/light_sample.h"
#include "render/light/tone_curve.h"
#include "render/view/projected_box.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace dollytrack::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Above kRough, reflections are blurred so much that ambient light serves; below kSmooth they are
// fully traced; in between both are blended.
constexpr float kRough = kMirrorRoughness;  // as in light.frag
constexpr float kSmooth = 0.15F;
constexpr int kMostSurfaces = 16;  // glass sheets, holes and mirrors along one ray
constexpr int kMostMirrors = 4;
constexpr float kBrightest = 1e4F;

auto* thatReflects(Reflections which) {
    return which == Reflections::All ? isSmooth : isMirror;
}

/// Share of the ambient reflection that a traced reflection replaces.
float share(const SurfacePoint& point, Reflections which) {
    if (which == Reflections::Mirrors && point.metallic <= kMirrorMetal) return 0.0F;
    return std::clamp((kRough - point.roughness) / (kRough - kSmooth), 0.0F, 1.0F);
}

Eigen::AlignedBox3f boxOf(const Object& object, const std::vector<Eigen::Vector3f>& positions) {
    Eigen::AlignedBox3f box;
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        box.extend(positions[object.first_vertex + i]);
    }
    return box;
}

}  // namespace

TracedReflections::TracedReflections(const Scene& scene, const RayCaster& rays,
                                     const LightVolume& light, const MovedShape* moved)
    : scene_(scene),
      rays_(rays),
      light_(light),
      surface_(scene, moved),
      sun_rays_(scene, rays, surface_, light.sun),
      outside_(showsOutside(scene)) {
    const std::vector<Eigen::Vector3f>& positions = moved ? moved->positions : scene.positions;
    for (const Object& object : scene.objects) {
        if (!hasMaterial(scene, object, isSmooth)) continue;
        smooth_.push_back(
            {object.id, hasMaterial(scene, object, isMirror), boxOf(object, positions)});
    }
}

bool TracedReflections::any(const Scene& scene, Reflections which) {
    return which != Reflections::Blurred &&
           std::ranges::any_of(scene.materials, thatReflects(which));
}

bool TracedReflections::trace(const View& view, int first_row, int last_row,
                              std::vector<Eigen::Vector4f>& image) const {
    if (view.reflections == Reflections::Blurred) return false;
    const int width = view.intrinsics.width;
    const PixelRect rows{0, first_row, width, last_row};
    std::vector<PixelRect> rects;
    for (const Smooth& object : smooth_) {
        if (view.reflections == Reflections::Mirrors && !object.mirrors) continue;
        const bool hidden =
            static_cast<std::size_t>(object.id) < view.hidden.size() && view.hidden[object.id];
        const PixelRect rect = projectBox(object.box, view, rows);
        if (!hidden && rect.width() > 0 && rect.height() > 0) rects.push_back(rect);
    }
    if (rects.empty()) return false;
    const auto pixels = static_cast<std::size_t>(width) * view.intrinsics.height;
    if (image.size() != pixels) image.assign(pixels, Eigen::Vector4f::Zero());
    const auto begin_of = image.begin() + static_cast<std::ptrdiff_t>(first_row) * width;
    const auto end_of = image.begin() + static_cast<std::ptrdiff_t>(last_row) * width;
    std::fill(begin_of, end_of, Eigen::Vector4f::Zero());
    const auto rowAt = [&](std::size_t y) {
        int from = width;
        int to = 0;
        for (const PixelRect& rect : rects) {
            if (static_cast<int>(y) < rect.y0 || static_cast<int>(y) >= rect.y1) continue;
            from = std::min(from, rect.x0);
            to = std::max(to, rect.x1);
        }
        for (int x = from; x < to; ++x) {
            image[y * static_cast<std::size_t>(width) + x] =
                seenIn(view, x + 0.5, static_cast<double>(y) + 0.5);
        }
    };
    parallelRanges(static_cast<std::size_t>(last_row - first_row), 8,
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t y = begin; y < end; ++y) {
                           rowAt(y + static_cast<std::size_t>(first_row));
                       }
                   });
    return std::any_of(begin_of, end_of,
                       [](const Eigen::Vector4f& pixel) { return pixel[3] > 0.0F; });
}

Eigen::Vector4f TracedReflections::seenIn(const View& view, double x, double y) const {
    const ViewRay ray = view.rayThrough(x, y);
    const double length = ray.direction.norm();
    const Eigen::Vector3d way = ray.direction / length;
    Eigen::Vector3d origin = ray.origin;
    double nearest = view.near_m * length;
    for (int step = 0; step < kMostSurfaces; ++step) {
        const RayHit hit = rays_.cast(origin, way, kInfinity, nearest);
        nearest = 0.0;
        if (hit.object_id == 0) break;
        const SurfacePoint point = surface_.at(origin, way, hit);
        if (point.hole || point.kind == Surface::Glass) {
            origin = liftedOff(point, way);
            continue;
        }
        const float part = share(point, view.reflections);
        if (part <= 0.0F) break;
        const Eigen::Vector3d mirrored = way - 2.0 * way.dot(point.normal) * point.normal;
        // With a smoothed normal the mirrored ray may pass through its own triangle.
        if (mirrored.dot(point.face) <= 0.0) break;
        // Files use any unit for emission; clamped values are white in any image.
        const Eigen::Vector3f light =
            lightAlong(liftedOff(point, mirrored), mirrored).cwiseMin(kBrightest);
        if (!light.allFinite()) break;
        return {light.x(), light.y(), light.z(), part};
    }
    return Eigen::Vector4f::Zero();
}

Eigen::Vector3f TracedReflections::lightAlong(Eigen::Vector3d origin, Eigen::Vector3d way) const {
    Eigen::Vector3f light = Eigen::Vector3f::Zero();
    Eigen::Vector3f carried = Eigen::Vector3f::Ones();
    int mirrors = 0;
    for (int step = 0; step < kMostSurfaces; ++step) {
        const RayHit hit = rays_.cast(origin, way, kInfinity);
        if (hit.object_id == 0) {
            const Eigen::Vector3f shown =
                decoded(skyBackdrop(static_cast<float>(way.z()), light_.backdrop_grey))
                    .cwiseProduct(light_.backdrop_factor);
            return light + carried.cwiseProduct(inverseToneCurve(shown)) / light_.exposure;
        }
        const SurfacePoint point = surface_.at(origin, way, hit);
        if (point.hole) {
            origin = liftedOff(point, way);
            continue;
        }
        const Eigen::Vector3f own = lightOf(point, hit.object_id);
        if (point.kind == Surface::Glass) {
            const auto opacity = static_cast<float>(point.opacity);
            light += carried.cwiseProduct(own) * opacity;
            carried *= 1.0F - opacity;
            origin = liftedOff(point, way);
            continue;
        }
        light += carried.cwiseProduct(own);
        const Eigen::Vector3d mirrored = way - 2.0 * way.dot(point.normal) * point.normal;
        carried = carried.cwiseProduct(point.base_color) * point.metallic;
        if (carried.maxCoeff() < 0.01F) break;
        if (share(point, Reflections::Mirrors) < 0.5F || ++mirrors == kMostMirrors ||
            mirrored.dot(point.face) <= 0.0) {
            light += carried.cwiseProduct(lightFrom(light_, point.position, mirrored));
            break;
        }
        origin = liftedOff(point, mirrored);
        way = mirrored;
    }
    return light;
}

Eigen::Vector3f TracedReflections::lightOf(const SurfacePoint& point, int object_id) const {
    Eigen::Vector3f irradiance = irradianceAt(light_, point.position, point.normal);
    const double slant = point.normal.dot(light_.sun.way);
    if (light_.sun.shines() && slant > 0.0 && light_.sun.way.dot(point.face) > 0.0) {
        const double sun = sun_rays_.share(liftedOff(point, light_.sun.way), light_.sun.way);
        irradiance += light_.sun.irradiance * static_cast<float>(sun * slant);
    }
    const bool outside = outside_[object_id - 1];
    const float shines = outside ? light_.outside_shines : light_.lamps_shine;
    Eigen::Vector3f color = point.base_color;
    // Surfaces that emit daylight turn dark without it.
    if (outside && !point.emission.isZero(0.0F)) color *= std::min(light_.outside_shines, 1.0F);
    return color.cwiseProduct(irradiance) * (1.0F - point.metallic) +
           point.emission * (std::numbers::pi_v<float> * light_.dimmed * shines);
}

}  // namespace dollytrack::render
