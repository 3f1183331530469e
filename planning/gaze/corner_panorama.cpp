#include "planning/gaze/corner_panorama.h"

#include "engine/geometry/ray_caster.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::planning {
namespace {

constexpr double kImageWidth = 320.0;

// The grid of rays, by heading and elevation; it ends a step from the poles.
constexpr int kColumns = 180;
constexpr int kRows = 81;
constexpr double kStep = 2.0 * std::numbers::pi / kColumns;

// Corners of a cell, fitted to those that ORB finds in 4,248 rendered views of ten scenes (rank
// correlation 0.87).
constexpr double kPerJunction = 4.4;  // at full contrast
constexpr double kPerTextureCorner = 0.42;
// Differences of brightness (0 to 1) between neighbouring cells.
constexpr double kLeastContrast = 0.03;  // less is the shading of a curved surface
constexpr double kFullContrast = 0.08;   // more does not count for more

constexpr double kBorder_px = 16.0;    // of an image 320 px wide; detectors find no corners in it
constexpr double kLeastInCell = 0.01;  // cells with fewer corners are left out

/// The surface that a ray of the grid hits.
struct Surface {
    double brightness = 0.0;       // 0 to 1
    double texture_corners = 0.0;  // per pixel
};

/// Reads surfaces at the hits of rays from one position.
class SurfaceReader {
  public:
    SurfaceReader(const Scene& scene, const TextureCorners& textures, double focal_px)
        : scene_(scene), textures_(textures), focal_px_(focal_px) {}

    [[nodiscard]] Surface at(const RayHit& hit, const Eigen::Vector3d& position,
                             const Eigen::Vector3d& direction) const {
        if (hit.object_id == 0) return {};
        const Triangle& triangle = scene_.triangles[hit.triangle];
        const Material& material = scene_.materials[scene_.triangle_material[hit.triangle]];
        const auto corner = [&](std::size_t k) {
            return Eigen::Vector3d(scene_.positions[triangle[k]].cast<double>());
        };
        const Eigen::Vector3d a = corner(0);
        const Eigen::Vector3d ab = corner(1) - a;
        const Eigen::Vector3d ac = corner(2) - a;
        const Eigen::Vector3d normal = ab.cross(ac);
        const double twice_area_m2 = normal.norm();
        if (twice_area_m2 <= 0.0) return {};
        const Eigen::Vector3d unit = normal / twice_area_m2;
        // Faint light from above and aside gives three directions different brightness.
        const double lit = 0.92 + 0.08 * std::abs(unit.dot(Eigen::Vector3d(0.3, 0.5, 0.81)));
        const double reflected =
            material.base_color.dot(Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F));
        const double encoded = std::pow(std::clamp(reflected, 0.0, 1.0), 1.0 / 2.2);
        Surface surface{encoded * textures_.brightness(material.texture) * lit};
        if (material.texture < 0) return surface;
        const Eigen::Vector3d from_a = position + hit.distance * direction - a;
        const double v = ab.cross(from_a).dot(unit) / twice_area_m2;
        const double u = from_a.cross(ac).dot(unit) / twice_area_m2;
        const auto uv = [&](std::size_t k) { return scene_.uvs[triangle[k]]; };
        const Eigen::Vector2f b = uv(1) - uv(0);
        const Eigen::Vector2f c = uv(2) - uv(0);
        const Texture& texture = scene_.textures[material.texture];
        const double twice_texels = std::abs(static_cast<double>(b.x() * c.y() - b.y() * c.x())) *
                                    texture.width * texture.height;
        const double texels_per_m = std::sqrt(twice_texels / twice_area_m2);
        const double facing = std::max(0.05, std::abs(unit.dot(direction)));
        const double pixel_m = hit.distance / focal_px_ / std::sqrt(facing);
        // Dark materials lower the contrast of their texture.
        surface.texture_corners =
            textures_.perPixel(material.texture,
                               uv(0) + static_cast<float>(u) * b + static_cast<float>(v) * c,
                               texels_per_m * pixel_m) *
            encoded;
        return surface;
    }

  private:
    const Scene& scene_;
    const TextureCorners& textures_;
    double focal_px_;
};

/// The directions of the grid, row by row from the lowest.
const std::vector<Eigen::Vector3d>& gridDirections() {
    static const std::vector<Eigen::Vector3d> directions = [] {
        std::vector<Eigen::Vector3d> all;
        for (int row = 0; row < kRows; ++row) {
            const double up = (row - 0.5 * (kRows - 1)) * kStep;
            for (int column = 0; column < kColumns; ++column) {
                const double heading = column * kStep;
                all.emplace_back(std::cos(up) * std::cos(heading), std::cos(up) * std::sin(heading),
                                 std::sin(up));
            }
        }
        return all;
    }();
    return directions;
}

/// Computes the Sobel gradients of the brightness in rows `first_row` to `last_row` of the grid,
/// clipped, in units of kFullContrast; those of other rows become zero.
void findGradients(const std::vector<Surface>& surfaces, int first_row, int last_row,
                   std::vector<Eigen::Vector2d>& found) {
    found.assign(surfaces.size(), Eigen::Vector2d::Zero());
    for (int row = std::max(1, first_row); row <= std::min(kRows - 2, last_row); ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const auto at = [&](int down, int right) {
                const int x = (column + right + kColumns) % kColumns;
                return surfaces[(row + down) * kColumns + x].brightness;
            };
            const Eigen::Vector2d gradient(
                at(-1, 1) - at(-1, -1) + 2.0 * (at(0, 1) - at(0, -1)) + at(1, 1) - at(1, -1),
                at(1, -1) - at(-1, -1) + 2.0 * (at(1, 0) - at(-1, 0)) + at(1, 1) - at(-1, 1));
            const double contrast = 0.25 * gradient.norm();
            if (contrast < kLeastContrast) continue;
            found[row * kColumns + column] = 0.25 * gradient / std::max(contrast, kFullContrast);
        }
    }
}

/// How much the brightness around a cell changes in all directions (Shi and Tomasi, 1994), 0 to 1.
double junction(const std::vector<Eigen::Vector2d>& gradients, int row, int column) {
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (int down = -1; down <= 1; ++down) {
        for (int right = -1; right <= 1; ++right) {
            const int x = (column + right + kColumns) % kColumns;
            const Eigen::Vector2d& gradient = gradients[(row + down) * kColumns + x];
            xx += gradient.x() * gradient.x() / 9.0;
            xy += gradient.x() * gradient.y() / 9.0;
            yy += gradient.y() * gradient.y() / 9.0;
        }
    }
    const double least = 0.5 * (xx + yy - std::hypot(xx - yy, 2.0 * xy));
    return std::sqrt(std::max(0.0, least));
}

}  // namespace

CornerPanorama::CornerPanorama(const ViewEstimator& views, const TextureCorners& textures,
                               const Eigen::Vector3d& position)
    : position_(position) {
    constexpr double kAllDirections = -2.0;
    cast(views, textures, position, Eigen::Vector3d::UnitX(), kAllDirections);
}

CornerPanorama::CornerPanorama(const ViewEstimator& views, const TextureCorners& textures,
                               const Eigen::Vector3d& position, const Eigen::Vector3d& direction)
    : position_(position) {
    const Intrinsics& lens = views.intrinsics();
    // A cell's corners depend on cells up to two rows and columns away, 2.83 steps diagonally.
    constexpr double kMargin = 3.0 * kStep;
    const double diagonal = std::atan(std::hypot(lens.cx / lens.fx, lens.cy / lens.fy));
    cast(views, textures, position, direction.normalized(), std::cos(diagonal + kMargin));
}

void CornerPanorama::cast(const ViewEstimator& views, const TextureCorners& textures,
                          const Eigen::Vector3d& position, const Eigen::Vector3d& direction,
                          double least_cosine) {
    const Intrinsics& lens = views.intrinsics();
    const double focal_px = lens.fx * kImageWidth / lens.width;
    const double border = kBorder_px / focal_px;
    half_size_ = Eigen::Vector2d(lens.cx / lens.fx - border, lens.cy / lens.fy - border)
                     .cwiseMax(0.0)
                     .cast<float>();
    std::vector<RayCaster::BundleRay> rays;
    std::vector<int> cells;  // of the rays, row by row
    const std::vector<Eigen::Vector3d>& grid = gridDirections();
    for (std::size_t i = 0; i < grid.size(); ++i) {
        if (grid[i].dot(direction) < least_cosine) continue;
        rays.push_back({grid[i]});
        cells.push_back(static_cast<int>(i));
    }
    if (cells.empty()) return;
    // Kept between calls, because allocating buffers of this size each time is slow.
    thread_local std::vector<RayHit> hits;
    thread_local std::vector<Surface> surfaces;
    thread_local std::vector<Eigen::Vector2d> changes;
    views.rays().castBundle(position, rays, 0.0, hits);
    const SurfaceReader reader(views.scene(), textures, focal_px);
    surfaces.assign(static_cast<std::size_t>(kRows) * kColumns, {});
    for (std::size_t i = 0; i < rays.size(); ++i) {
        surfaces[cells[i]] = reader.at(hits[i], position, rays[i].direction);
    }
    findGradients(surfaces, cells.front() / kColumns, cells.back() / kColumns, changes);
    const double side_px = kStep * focal_px;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const int row = cells[i] / kColumns;
        const int column = cells[i] % kColumns;
        if (row == 0 || row + 1 == kRows) continue;
        const double narrow = std::cos((row - 0.5 * (kRows - 1)) * kStep);
        const Surface& here = surfaces[cells[i]];
        const double corners =
            narrow * (kPerJunction * junction(changes, row, column) +
                      kPerTextureCorner * here.texture_corners * side_px * side_px);
        if (corners < kLeastInCell) continue;
        constexpr double kFarAway_m = 1e3;  // where a ray hits nothing
        const double distance_m = hits[i].object_id == 0 ? kFarAway_m : hits[i].distance;
        cells_.push_back({rays[i].direction.cast<float>(), static_cast<float>(distance_m),
                          static_cast<float>(corners)});
    }
    cells_.shrink_to_fit();
}

double CornerPanorama::corners(const Eigen::Vector3d& direction) const {
    return corners(lookAlong(direction));
}

bool CornerPanorama::inImage(const Eigen::Vector3f& in_camera) const {
    return in_camera.z() > 0.0F && std::abs(in_camera.x()) < half_size_.x() * in_camera.z() &&
           std::abs(in_camera.y()) < half_size_.y() * in_camera.z();
}

template <typename Visit>
void CornerPanorama::visitImage(const Eigen::Quaterniond& world_from_camera, Visit&& visit) const {
    const Eigen::Matrix3f camera_from_world =
        world_from_camera.conjugate().toRotationMatrix().cast<float>();
    // Cells are sorted by elevation; only those in the image's range are looked at.
    constexpr float kRounding = 1e-3F;  // rad
    const float reach = std::atan(half_size_.norm()) + kRounding;
    const float elevation = std::asin(std::clamp(camera_from_world(2, 2), -1.0F, 1.0F));
    const auto sineOf = [](float angle) {
        return std::sin(
            std::clamp(angle, -0.5F * std::numbers::pi_v<float>, 0.5F * std::numbers::pi_v<float>));
    };
    const float lowest = sineOf(elevation - reach);
    const float highest = sineOf(elevation + reach);
    const auto first = std::ranges::lower_bound(
        cells_, lowest, {}, [](const Cell& cell) { return cell.direction.z(); });
    for (auto cell = first; cell != cells_.end() && cell->direction.z() <= highest; ++cell) {
        if (inImage(camera_from_world * cell->direction)) visit(*cell);
    }
}

double CornerPanorama::corners(const Eigen::Quaterniond& world_from_camera) const {
    float sum = 0.0F;
    visitImage(world_from_camera, [&](const Cell& cell) { sum += cell.corners; });
    return sum;
}

double CornerPanorama::cornersAlsoIn(const Pose& other,
                                     const Eigen::Quaterniond& world_from_camera) const {
    const Eigen::Matrix3f other_from_world =
        other.rotation.conjugate().toRotationMatrix().cast<float>();
    const Eigen::Vector3f moved = (position_ - other.position).cast<float>();
    float sum = 0.0F;
    visitImage(world_from_camera, [&](const Cell& cell) {
        const Eigen::Vector3f from_other = moved + cell.distance_m * cell.direction;
        if (inImage(other_from_world * from_other)) sum += cell.corners;
    });
    return sum;
}

CornerPanoramas::CornerPanoramas(const ViewEstimator& views)
    : views_(views), textures_(views.scene()) {}

std::shared_ptr<const CornerPanorama> CornerPanoramas::at(const Eigen::Vector3d& position) {
    constexpr std::size_t kMostKept = 500;  // up to 290 KB each
    const std::array<double, 3> key{position.x(), position.y(), position.z()};
    {
        const std::scoped_lock lock(mutex_);
        if (const auto found = made_.find(key); found != made_.end()) return found->second;
    }
    auto made = std::make_shared<const CornerPanorama>(views_, textures_, position);
    const std::scoped_lock lock(mutex_);
    if (made_.size() >= kMostKept) made_.clear();
    made_.emplace(key, made);
    return made;
}

}  // namespace dollytrack::planning
