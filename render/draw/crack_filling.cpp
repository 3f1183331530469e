#include "render/draw/crack_filling.h"

#include "render/draw/shading_normal.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace dollytrack::render {
namespace {

constexpr double kNudge_px = 0.01;  // rasterisation may place an edge this far from its true
                                    // position

struct Neighbours {
    int inside = 0;                   // neighbours inside the image
    std::vector<std::size_t> pixels;  // neighbours with a label
};

Neighbours neighboursOf(std::size_t pixel, const Intrinsics& image,
                        std::span<const std::uint16_t> labels) {
    Neighbours found;
    const int x = static_cast<int>(pixel) % image.width;
    const int y = static_cast<int>(pixel) / image.width;
    for (int row = std::max(0, y - 1); row <= std::min(image.height - 1, y + 1); ++row) {
        for (int column = std::max(0, x - 1); column <= std::min(image.width - 1, x + 1);
             ++column) {
            if (row == y && column == x) continue;
            const std::size_t other =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(column);
            ++found.inside;
            if (labels[other] != 0) found.pixels.push_back(other);
        }
    }
    return found;
}

/// The ray through the pixel's centre, shifted by an offset.
ViewRay rayThrough(const View& view, std::size_t pixel, double right_px = 0.0,
                   double down_px = 0.0) {
    const std::size_t width = view.intrinsics.width;
    return view.rayThrough(static_cast<double>(pixel % width) + 0.5 + right_px,
                           static_cast<double>(pixel / width) + 0.5 + down_px);
}

/// Ray-cast results at the centres of these pixels.
std::vector<RayHit> castPixels(const View& view, std::span<const std::size_t> pixels,
                               const RayCaster& rays) {
    std::vector<RayCaster::BundleRay> bundle;
    for (const std::size_t pixel : pixels) bundle.push_back({rayThrough(view, pixel).direction});
    std::vector<RayHit> hits;
    rays.castBundle(view.pose.position, bundle, view.near_m, hits);
    return hits;
}

/// The first hit among rays at and around the pixel's centre. A single ray along a surface may slip
/// through the joint between two triangles.
RayHit castAround(const View& view, std::size_t pixel, const RayCaster& rays) {
    RayHit hit;
    for (const double down : {0.0, -kNudge_px, kNudge_px}) {
        for (const double right : {0.0, -kNudge_px, kNudge_px}) {
            const ViewRay ray = rayThrough(view, pixel, right, down);
            hit = rays.cast(ray.origin, ray.direction, std::numeric_limits<double>::infinity(),
                            view.near_m);
            if (hit.object_id != 0) return hit;
        }
    }
    return hit;
}

/// Largest error of a depth in single precision, m.
double roundingError(double depth_m) {
    return 5e-5 * (1.0 + depth_m);
}

/// Whether the object also has a surface at the hit point. Of two coincident surfaces the ray hits
/// either one; the rasteriser has already chosen.
bool isInSamePlace(const View& view, std::size_t pixel, int object_id, const RayHit& hit,
                   const RayCaster& rays) {
    const double slack = roundingError(hit.distance);
    const ViewRay ray = rayThrough(view, pixel);
    return rays.meetsObject(object_id, ray.origin + (hit.distance - slack) * ray.direction,
                            ray.direction, 2.0 * slack);
}

CrackPixel crackAt(std::size_t pixel, const View& view, std::span<const std::uint16_t> labels,
                   const RayHit& hit, const RayCaster& rays) {
    CrackPixel crack{pixel, labels[pixel] != 0, pixel, static_cast<std::uint16_t>(hit.object_id),
                     hit};
    if (hit.object_id == labels[pixel]) return crack;
    if (crack.drawn && hit.object_id != 0 && isInSamePlace(view, pixel, labels[pixel], hit, rays)) {
        crack.object_id = labels[pixel];
        return crack;
    }
    const Neighbours around = neighboursOf(pixel, view.intrinsics, labels);
    const auto same =
        std::find_if(around.pixels.begin(), around.pixels.end(),
                     [&](std::size_t other) { return labels[other] == hit.object_id; });
    if (same != around.pixels.end()) {
        crack.like = *same;
    } else if (!crack.drawn) {
        crack.like = around.pixels.front();
    }
    return crack;
}

bool isUnreliable(float drawn_depth_m) {
    return !(drawn_depth_m > 0.0F && std::isfinite(drawn_depth_m));
}

/// Largest error of a drawn depth that is not marked as unreliable, m.
double drawingError(double depth_m) {
    constexpr double kSteep = 0.05;  // m per px: surface.frag marks the depth of steeper surfaces
    return kNudge_px * kSteep + roundingError(depth_m);
}

/// Finds the pixels of a rasterised image whose depth or label may be wrong.
class DrawnImage {
  public:
    DrawnImage(int width, std::span<const std::uint16_t> labels,
               std::span<const float> drawn_depth_m)
        : columns_(width), labels_(labels), inverse_depth_(drawn_depth_m.size()) {
        std::transform(drawn_depth_m.begin(), drawn_depth_m.end(), inverse_depth_.begin(),
                       [](float depth) { return 1.0F / std::abs(depth); });
    }

    /// The pixels whose depth or label is doubtful: those on either side of the outlines of objects
    /// and of steps in depth on one object, and those that lie on neither of the two planes
    /// extrapolated from the pixels on either side, along the row or along the column.
    [[nodiscard]] std::vector<bool> doubtfulPixels() const {
        std::vector<bool> found(labels_.size(), false);
        const std::size_t rows = labels_.size() / columns_;
        for (std::size_t y = 0; y < rows; ++y) {
            for (std::size_t x = 0; x < columns_; ++x) {
                const std::size_t pixel = y * columns_ + x;
                const auto compare = [&](std::size_t other) {
                    if (isOutline(pixel, other)) found[pixel] = found[other] = true;
                };
                if (x + 1 < columns_) compare(pixel + 1);
                if (y + 1 < rows) compare(pixel + columns_);
                if (!continuesAlong(pixel, 1, x, columns_) ||
                    !continuesAlong(pixel, columns_, y, rows)) {
                    found[pixel] = true;
                }
            }
        }
        return found;
    }

  private:
    /// Whether the pixel continues the surface on one of its sides along a row or column.
    /// @param stride  from one pixel of the row or column to the next
    /// @param index   the pixel's place among its `count` pixels
    [[nodiscard]] bool continuesAlong(std::size_t pixel, std::size_t stride, std::size_t index,
                                      std::size_t count) const {
        return (index >= 2 && continues(pixel, pixel - stride, pixel - 2 * stride)) ||
               (index + 2 < count && continues(pixel, pixel + stride, pixel + 2 * stride));
    }

    [[nodiscard]] bool isOutline(std::size_t a, std::size_t b) const {
        constexpr float kStep = 0.02F;  // relative
        const auto [farther, nearer] = std::minmax(inverse_depth_[a], inverse_depth_[b]);
        return labels_[a] != labels_[b] || nearer > (1.0F + kStep) * farther;
    }

    /// Whether the pixel lies on the plane through two others of its row or column. Inverse depth
    /// is linear across the image of a plane.
    [[nodiscard]] bool continues(std::size_t pixel, std::size_t next, std::size_t second) const {
        const float expected = 2.0F * inverse_depth_[next] - inverse_depth_[second];
        const float found = inverse_depth_[pixel];
        const auto depth_m = static_cast<double>(1.0F / found);
        return std::abs(found - expected) * depth_m * depth_m <= drawingError(depth_m);
    }

    std::size_t columns_;
    std::span<const std::uint16_t> labels_;
    std::vector<float> inverse_depth_;  // 1/m
};

float depthOf(const CrackPixel& crack) {
    return crack.hit.object_id == 0 ? 0.0F : static_cast<float>(crack.hit.distance);
}

void copyColour(std::vector<std::uint8_t>& rgb, const CrackPixel& crack) {
    if (!rgb.empty()) std::copy_n(&rgb[3 * crack.like], 3, &rgb[3 * crack.pixel]);
}

}  // namespace

std::vector<CrackPixel> findCracks(const View& view, std::span<const std::uint16_t> labels,
                                   const RayCaster& rays) {
    std::vector<std::size_t> gaps;
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels[pixel] != 0) continue;
        const Neighbours around = neighboursOf(pixel, view.intrinsics, labels);
        if (2 * static_cast<int>(around.pixels.size()) > around.inside) gaps.push_back(pixel);
    }
    const std::vector<RayHit> hits = castPixels(view, gaps, rays);
    std::vector<CrackPixel> cracks;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        if (hits[i].object_id != 0) {
            cracks.push_back(crackAt(gaps[i], view, labels, hits[i], rays));
        }
    }
    return cracks;
}

std::vector<CrackPixel> findCracks(const View& view, std::span<const std::uint16_t> labels,
                                   std::span<const float> drawn_depth_m, const RayCaster& rays) {
    std::vector<CrackPixel> cracks = findCracks(view, labels, rays);
    const std::vector<bool> doubtful =
        DrawnImage(view.intrinsics.width, labels, drawn_depth_m).doubtfulPixels();
    std::vector<std::size_t> unknown;
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels[pixel] == 0) continue;
        if (doubtful[pixel] || isUnreliable(drawn_depth_m[pixel])) unknown.push_back(pixel);
    }
    const std::vector<RayHit> hits = castPixels(view, unknown, rays);
    for (std::size_t i = 0; i < unknown.size(); ++i) {
        const RayHit hit = hits[i].object_id != 0 ? hits[i] : castAround(view, unknown[i], rays);
        cracks.push_back(crackAt(unknown[i], view, labels, hit, rays));
    }
    return cracks;
}

void fillCracks(std::span<const CrackPixel> cracks, const Scene& scene, const MovingObjects& moving,
                const View& view, FrameRecord& record) {
    if (cracks.empty()) return;
    const std::vector<Eigen::Isometry3d> to_rest = moving.toRest(record.index);
    for (const CrackPixel& crack : cracks) {
        record.instance[crack.pixel] = crack.object_id;
        if (!record.depth_m.empty()) {
            record.depth_m[crack.pixel] = depthOf(crack);
        }
        // Antialiased colour is a mean over the whole pixel, so it stays.
        if (!crack.drawn) copyColour(record.rgb, crack);
        copyColour(record.albedo, crack);
        if (record.normals_in_world.empty()) continue;
        Eigen::Vector3f& normal = record.normals_in_world[crack.pixel];
        const ViewRay ray = rayThrough(view, crack.pixel);
        normal = crack.object_id == 0 ? Eigen::Vector3f(Eigen::Vector3f::Zero())
                                      : Eigen::Vector3f(shadingNormal(scene, to_rest, crack.hit,
                                                                      ray.origin, ray.direction)
                                                            .cast<float>());
    }
}

void fillCrackColours(std::span<const CrackPixel> cracks, std::vector<std::uint8_t>& rgb) {
    for (const CrackPixel& crack : cracks) copyColour(rgb, crack);
}

void fillRightCracks(const MovingObjects& moving, const View& right, FrameRecord& record) {
    std::vector<std::uint16_t> shown(record.depth_right_m.size());
    std::transform(record.depth_right_m.begin(), record.depth_right_m.end(), shown.begin(),
                   [](float depth) { return std::uint16_t{depth != 0.0F}; });
    for (const CrackPixel& crack :
         findCracks(right, shown, record.depth_right_m, *moving.raysAt(record.index))) {
        record.depth_right_m[crack.pixel] = depthOf(crack);
        if (!crack.drawn) copyColour(record.rgb_right, crack);
    }
}

}  // namespace dollytrack::render
