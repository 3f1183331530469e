#include "render/draw/overview.h"

#include "engine/math/angle.h"
#include "render/draw/offscreen_renderer.h"
#include "render/draw/storey_cutaway.h"
#include "render/light/light_cache.h"
#include "render/overlays/overlay_painter.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

Picture shrink(const std::vector<std::uint8_t>& rgb, int width, int height, int factor) {
    Picture small{width / factor, height / factor, {}};
    small.rgb.resize(3UL * small.width * small.height);
    const int samples = factor * factor;
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                int sum = 0;
                for (int k = 0; k < samples; ++k) {
                    const std::size_t from_y = static_cast<std::size_t>(y) * factor + k / factor;
                    const std::size_t from_x = static_cast<std::size_t>(x) * factor + k % factor;
                    sum += rgb[3 * (from_y * width + from_x) + c];
                }
                small.rgb[3 * (static_cast<std::size_t>(y) * small.width + x) + c] =
                    static_cast<std::uint8_t>((sum + samples / 2) / samples);
            }
        }
    }
    return small;
}

}  // namespace

View overviewOf(const Scene& scene, const OverviewSettings& settings,
                std::span<const Eigen::AlignedBox3d> rooms) {
    View view;
    CameraParams camera;
    camera.width_px = settings.width_px * settings.supersampling;
    camera.height_px = settings.height_px * settings.supersampling;
    camera.hfov_deg = settings.hfov_deg;
    view.intrinsics = makeIntrinsics(camera);
    const std::vector<StoreyView> storeys = storeysOf(scene, rooms);
    const std::size_t asked =
        settings.storey > 0 ? static_cast<std::size_t>(settings.storey) : storeys.size();
    const StoreyView storey = storeys[std::min(asked, storeys.size()) - 1];
    view.hidden = hiddenFor(scene, storey);
    view.backdrop = Eigen::Vector3f(0.955F, 0.955F, 0.95F);
    Eigen::AlignedBox3d bounds = buildingOf(scene, rooms);
    if (bounds.isEmpty()) bounds.extend(Eigen::Vector3d::Zero());
    // The floor itself must not be cut; a room's box begins just above it.
    double floor = bounds.min().z();
    if (!rooms.empty()) floor = bounds.min().z() + 0.25;
    if (storeys.size() > 1) {
        bounds = withinStorey(bounds, storey);
        floor = storey.floor_z;
    }

    const double azimuth = settings.azimuth_deg * kDegree;
    const double elevation = settings.elevation_deg * kDegree;
    const Eigen::Vector3d aside(std::cos(azimuth), std::sin(azimuth), 0.0);
    const Eigen::Vector3d way =
        std::cos(elevation) * aside + Eigen::Vector3d(0, 0, std::sin(elevation));
    // The image must contain the floor's corners and the tops of the walls that stay.
    std::vector<Eigen::Vector3d> corners;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d corner =
            bounds.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
        const bool top = corner.z() > bounds.center().z();
        if (!top || aside.dot(corner - bounds.center()) < 0.0) corners.push_back(corner);
    }
    const auto coveredFrom = [&](double distance) {
        view.pose = lookAt(bounds.center() + distance * way, bounds.center());
        Eigen::AlignedBox2d covered;
        for (const Eigen::Vector3d& corner : corners) {
            const Eigen::Vector3d p = view.pose.toCamera(corner);
            covered.extend(p.z() > 0.1 ? view.intrinsics.project(p) : Eigen::Vector2d(1e9, 1e9));
        }
        return covered;
    };
    // Bisection for the nearest distance at which everything fits: the extent shrinks with
    // distance.
    double near = 0.0;
    double far = 20.0 * bounds.sizes().norm() + 1.0;
    const Eigen::Vector2d allowed(0.92 * camera.width_px, 0.90 * camera.height_px);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (near + far);
        const bool fits = (coveredFrom(middle).sizes().array() <= allowed.array()).all();
        (fits ? far : near) = middle;
    }
    // A lens shift centres the building without turning the camera.
    const Eigen::Vector2d off = coveredFrom(far).center();
    view.intrinsics.cx += 0.5 * camera.width_px - off.x();
    view.intrinsics.cy += 0.5 * camera.height_px - off.y();

    view.structure_cut = cutTowards(bounds, floor, storey.ceiling_z, aside);
    return view;
}

Result<Picture> renderOverview(std::unique_ptr<gl::Context> context, const Scene& scene,
                               const RayCaster& rays, const Overlay& overlay,
                               const OverviewSettings& settings,
                               std::span<const Eigen::AlignedBox3d> rooms, const JobContext& job) {
    const View view = overviewOf(scene, settings, rooms);
    const LightVolume light = lightVolumeOf(scene, rays, makeLightRig(scene, rays, rooms), {},
                                            job.stage(0.0, 0.9, "light"));
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Rendering the picture was cancelled.");
    Result<OffscreenRenderer> renderer = OffscreenRenderer::create(
        std::move(context), scene, light, view.intrinsics.width, view.intrinsics.height);
    if (!renderer) return tl::unexpected(renderer.error());
    Result<FrameRecord> frame = renderer->render(view);
    if (!frame) return tl::unexpected(frame.error());
    paintOverlay(overlay, view, frame->depth_m, settings.supersampling, frame->rgb);
    return shrink(frame->rgb, frame->width, frame->height, settings.supersampling);
}

}  // namespace dollytrack::render
