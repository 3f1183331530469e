#include "planning/visibility/view_estimator.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace dollytrack::planning {
namespace {

/// The 26 directions to the neighbours of a cube.
std::vector<Eigen::Vector3f> neighbourDirections() {
    std::vector<Eigen::Vector3f> directions;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
            }
        }
    }
    return directions;
}

std::vector<Eigen::Vector3d> extremePoints(const Scene& scene, const Object& object) {
    static const std::vector<Eigen::Vector3f> directions = neighbourDirections();
    std::vector<float> furthest(directions.size(), -std::numeric_limits<float>::infinity());
    std::vector<std::uint32_t> chosen(directions.size(), object.first_vertex);
    for (std::uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count;
         ++v) {
        for (std::size_t d = 0; d < directions.size(); ++d) {
            const float reach = directions[d].dot(scene.positions[v]);
            if (reach <= furthest[d]) continue;
            furthest[d] = reach;
            chosen[d] = v;
        }
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<Eigen::Vector3d> points;
    for (const std::uint32_t v : chosen) points.emplace_back(scene.positions[v].cast<double>());
    return points;
}

Eigen::AlignedBox2d imageOf(const Intrinsics& k) {
    return {Eigen::Vector2d::Zero(), Eigen::Vector2d(k.width, k.height)};
}

ViewEstimator::Estimate outsideImage() {
    ViewEstimator::Estimate estimate;
    estimate.cropped = true;
    return estimate;
}

/// Edge of square cells, px, so that thin objects get enough rays along their length.
double cellFor(const Eigen::AlignedBox2d& area, double grid) {
    return std::max(1.0, std::sqrt(area.sizes().prod()) / grid);
}

}  // namespace

/// Buffers of one estimate, reused by each thread to avoid allocations.
struct ViewEstimator::Scratch {
    std::vector<Eigen::Vector2d> pixels;
    std::vector<RayCaster::BundleRay> rays;  // one per pixel
    std::vector<RayHit> hits;
};

ViewEstimator::Scratch& ViewEstimator::aimRays(const Pose& pose, const Eigen::AlignedBox2d& area,
                                               double cell,
                                               const BoundingDop::FromOrigin& bounds) const {
    const int columns = std::max(1, static_cast<int>(std::ceil(area.sizes().x() / cell)));
    const int rows = std::max(1, static_cast<int>(std::ceil(area.sizes().y() / cell)));
    const Eigen::Matrix3d world_from_camera = pose.rotation.toRotationMatrix();

    // Skip rays that miss the bounds, and end the others behind them. Work in blocks, so that
    // neighbours in the list are neighbours in the image.
    constexpr int kBlock = BoundingDop::FromOrigin::kAtOnce;
    BoundingDop::FromOrigin::Directions directions;
    std::array<Eigen::Vector2d, kBlock> asked;
    std::array<Eigen::Vector3d, kBlock> ways;
    thread_local Scratch scratch;
    auto& [pixels, rays, hits] = scratch;
    pixels.clear();
    rays.clear();
    for (int block = 0; block < rows; block += kBlock) {
        for (int column = 0; column < columns; ++column) {
            for (int lane = 0; lane < kBlock; ++lane) {
                asked[lane] = area.min() + cell * Eigen::Vector2d(column + 0.5, block + lane + 0.5);
                ways[lane] =
                    world_from_camera * intrinsics_.unproject(asked[lane].x(), asked[lane].y());
                for (unsigned axis = 0; axis < 3; ++axis) {
                    directions[axis][lane] = static_cast<float>(ways[lane][axis]);
                }
            }
            const auto exits = bounds.exits(directions);
            for (int lane = 0; lane < std::min(kBlock, rows - block); ++lane) {
                if (exits[lane] <= 0.0F) continue;
                pixels.push_back(asked[lane]);
                rays.push_back({ways[lane], exits[lane]});
            }
        }
    }
    return scratch;
}

ViewEstimator::ViewEstimator(const Scene& scene, const RayCaster& rays, const CameraParams& camera)
    : scene_(&scene),
      rays_(&rays),
      surfaces_(scene),
      intrinsics_(makeIntrinsics(camera)),
      near_m_(camera.near_m),
      extremes_(scene.objects.size()),
      bounds_(scene.objects.size()) {
    parallelFor(scene.objects.size(), [&](std::size_t i) {
        if (scene.objects[i].role == Role::Target) {
            extremes_[i] = extremePoints(scene, scene.objects[i]);
            bounds_[i] = BoundingDop(scene, scene.objects[i]);
        }
    });
}

bool ViewEstimator::inImage(const Pose& pose, const Eigen::Vector3d& point) const {
    const Eigen::Vector3d p = pose.toCamera(point);
    if (p.z() < near_m_) return false;
    const Eigen::Vector2d px = intrinsics_.project(p);
    return px.x() >= 0.0 && px.y() >= 0.0 && px.x() < intrinsics_.width &&
           px.y() < intrinsics_.height;
}

double ViewEstimator::scannedShare(const Pose& pose) const {
    if (!surfaces_.isScan()) return 1.0;
    constexpr int kAcross = 16;
    constexpr int kDown = 12;
    int shown = 0;
    for (int i = 0; i < kAcross * kDown; ++i) {
        const double x = (i % kAcross + 0.5) * intrinsics_.width / kAcross;
        const double y = (i / kAcross + 0.5) * intrinsics_.height / kDown;
        const Eigen::Vector3d direction = pose.rotation * intrinsics_.unproject(x, y);
        const RayHit hit =
            rays_->cast(pose.position, direction, std::numeric_limits<double>::infinity(), near_m_);
        shown += surfaces_.hitSide(hit, direction) == ScannedSurfaces::HitSide::Front ? 1 : 0;
    }
    return static_cast<double>(shown) / (kAcross * kDown);
}

std::optional<Eigen::AlignedBox2d> ViewEstimator::extent(const Pose& pose, int object_id) const {
    const Eigen::Matrix3d camera_from_world = pose.rotation.toRotationMatrix().transpose();
    Eigen::AlignedBox2d inner;
    for (const Eigen::Vector3d& point : extremes(object_id)) {
        const Eigen::Vector3d p = camera_from_world * (point - pose.position);
        if (p.z() < near_m_) return std::nullopt;
        inner.extend(intrinsics_.project(p));
    }
    // 26 directions leave up to 4 % of a sphere's radius uncovered on each side. Round to whole
    // pixels, so that with cells of one pixel the rays go through pixel centres.
    const Eigen::Vector2d margin = 0.05 * inner.sizes() + Eigen::Vector2d::Constant(1.0);
    return Eigen::AlignedBox2d((inner.min() - margin).array().floor().matrix(),
                               (inner.max() + margin).array().ceil().matrix());
}

ViewEstimator::Estimate ViewEstimator::trace(const Pose& pose, int object_id, double cell,
                                             Scratch& scratch) const {
    auto& [pixels, rays, hits] = scratch;
    rays_->castBundle(pose.position, rays, near_m_, hits);

    Estimate result;
    const Eigen::AlignedBox2d image = imageOf(intrinsics_);
    int silhouette = 0;
    int visible = 0;
    Eigen::AlignedBox2d visible_box;
    std::map<int, int> hidden_by;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const int met = hits[i].object_id;
        if (met == 0) continue;
        const bool hidden = met != object_id;
        if (hidden && !rays_->meetsObject(object_id, pose.position, rays[i].direction,
                                          rays[i].max_distance)) {
            continue;
        }
        ++silhouette;
        if (!image.contains(pixels[i])) {
            result.cropped = true;
        } else if (hidden) {
            ++hidden_by[met];
        } else {
            ++visible;
            visible_box.extend(pixels[i]);
        }
    }
    result.rays_on_silhouette = silhouette;
    if (silhouette == 0) return result;

    const double image_area = static_cast<double>(intrinsics_.width) * intrinsics_.height;
    result.visible_fraction = static_cast<double>(visible) / silhouette;
    result.mask_share = visible * cell * cell / image_area;
    result.visible_px = result.mask_share * 640.0 * 480.0;
    if (visible > 0) {
        // Half a cell on each side: the outermost rays stand for their whole cells.
        const Eigen::Vector2d size =
            (visible_box.sizes().array() + cell)
                .min(Eigen::Array2d(intrinsics_.width, intrinsics_.height));
        result.box_share = size.prod() / image_area;
        const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * cell);
        result.visible_box =
            image.intersection({visible_box.min() - half, visible_box.max() + half});
    }
    int most = 0;
    for (const auto& [id, count] : hidden_by) {
        if (count <= most) continue;
        most = count;
        result.occluder = id;
        result.occluder_share = static_cast<double>(count) / silhouette;
    }
    return result;
}

ViewEstimator::Estimate ViewEstimator::estimate(const Pose& pose, int object_id, int grid) const {
    const auto area = extent(pose, object_id);
    if (!area) return {};
    if (!imageOf(intrinsics_).intersects(*area)) return outsideImage();
    const double cell = cellFor(*area, grid);
    const BoundingDop::FromOrigin bounds(bounds_[object_id - 1], pose.position);
    return trace(pose, object_id, cell, aimRays(pose, *area, cell, bounds));
}

ViewEstimator::Estimate ViewEstimator::estimateClosely(const Pose& pose, int object_id, int grid,
                                                       int least_rays) const {
    static constexpr double kDensest = 72.0;
    constexpr double kOverBounds = 1.2;
    constexpr double kEnough = 0.75;
    const auto area = extent(pose, object_id);
    if (!area) return {};
    if (!imageOf(intrinsics_).intersects(*area)) return outsideImage();
    const BoundingDop::FromOrigin bounds(bounds_[object_id - 1], pose.position);
    const auto aim = [&](double sides) -> Scratch& {
        return aimRays(pose, *area, cellFor(*area, sides), bounds);
    };
    const auto denser = [](double sides, double wanted, std::size_t rays) {
        return std::min(sides * std::sqrt(wanted / static_cast<double>(rays)), kDensest);
    };
    // Slightly fewer rays hit the object than its bounds, the hits on which are known without
    // tracing.
    const double wanted = kOverBounds * least_rays;
    double sides = grid;
    Scratch* scratch = &aim(sides);
    if (const std::size_t rays = scratch->rays.size(); rays > 0 && rays < wanted) {
        sides = denser(sides, wanted, rays);
        scratch = &aim(sides);
    }
    const Estimate first = trace(pose, object_id, cellFor(*area, sides), *scratch);
    const int rays = first.rays_on_silhouette;
    if (rays == 0 || rays >= kEnough * least_rays || cellFor(*area, sides) <= 1.0) return first;
    sides = denser(sides, least_rays, static_cast<std::size_t>(rays));
    return trace(pose, object_id, cellFor(*area, sides), aim(sides));
}

ObjectView makeView(const ViewEstimator::Estimate& estimate, int object_id, int frame) {
    return {object_id,
            frame,
            estimate.visible_fraction,
            estimate.visible_px,
            estimate.box_share,
            estimate.mask_share};
}

}  // namespace dollytrack::planning
