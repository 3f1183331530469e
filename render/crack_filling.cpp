#include "render/crack_filling.h"

#include "render/seen_normal.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::render {
namespace {

struct Neighbours {
    int inside = 0;  // the image
    int shown = 0;
    std::vector<std::size_t> pixels;  // those shown
};

Neighbours neighboursOf(int x, int y, int width, int height,
                        std::span<const std::uint16_t> labels) {
    Neighbours found;
    for (int row = std::max(0, y - 1); row <= std::min(height - 1, y + 1); ++row) {
        for (int column = std::max(0, x - 1); column <= std::min(width - 1, x + 1); ++column) {
            if (row == y && column == x) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column);
            ++found.inside;
            if (labels[pixel] == 0) continue;
            ++found.shown;
            found.pixels.push_back(pixel);
        }
    }
    return found;
}

/// Whether no neighbour has about the same depth.
bool standsAlone(const std::vector<float>& depth_m, int x, int y, int width, int height) {
    const auto at = [&](int column, int row) {
        return depth_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(column)];
    };
    const float depth = at(x, y);
    const float alike = 0.01F + 0.01F * depth;
    for (int row = std::max(0, y - 1); row <= std::min(height - 1, y + 1); ++row) {
        for (int column = std::max(0, x - 1); column <= std::min(width - 1, x + 1); ++column) {
            if (row == y && column == x) continue;
            if (std::abs(at(column, row) - depth) <= alike) return false;
        }
    }
    return true;
}

void copyColour(std::vector<std::uint8_t>& rgb, const CrackPixel& crack) {
    if (!rgb.empty()) std::copy_n(&rgb[3 * crack.like], 3, &rgb[3 * crack.pixel]);
}

}  // namespace

std::vector<CrackPixel> findCracks(const View& view, std::span<const std::uint16_t> labels,
                                   const RayCaster& rays) {
    std::vector<CrackPixel> cracks;
    const int width = view.intrinsics.width;
    const int height = view.intrinsics.height;
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel) {
        if (labels[pixel] != 0) continue;
        const int x = static_cast<int>(pixel) % width;
        const int y = static_cast<int>(pixel) / width;
        const Neighbours around = neighboursOf(x, y, width, height, labels);
        if (2 * around.shown <= around.inside) continue;
        const ViewRay ray = view.rayThrough(x + 0.5, y + 0.5);
        const RayHit hit = rays.cast(ray.origin, ray.direction,
                                     std::numeric_limits<double>::infinity(), view.near_m);
        if (hit.object_id == 0) continue;
        const auto same =
            std::find_if(around.pixels.begin(), around.pixels.end(),
                         [&](std::size_t other) { return labels[other] == hit.object_id; });
        cracks.push_back({pixel, same == around.pixels.end() ? around.pixels.front() : *same, hit});
    }
    return cracks;
}

void fillCracks(std::span<const CrackPixel> cracks, const FrameContext& context, const View& view,
                FrameRecord& record) {
    if (cracks.empty()) return;
    const std::vector<Eigen::Isometry3d> to_rest = context.moving.toRest(record.index);
    for (const CrackPixel& crack : cracks) {
        record.instance[crack.pixel] = static_cast<std::uint16_t>(crack.hit.object_id);
        if (!record.depth_m.empty()) {
            record.depth_m[crack.pixel] = static_cast<float>(crack.hit.distance);
        }
        copyColour(record.rgb, crack);
        copyColour(record.albedo, crack);
        if (record.normals_in_world.empty()) continue;
        const auto width = static_cast<std::size_t>(record.width);
        const ViewRay ray = view.rayThrough(static_cast<double>(crack.pixel % width) + 0.5,
                                            static_cast<double>(crack.pixel / width) + 0.5);
        record.normals_in_world[crack.pixel] =
            seenNormal(context.contents.scene, to_rest, crack.hit, ray.origin, ray.direction)
                .cast<float>();
    }
}

void fillCrackColours(std::span<const CrackPixel> cracks, std::vector<std::uint8_t>& rgb) {
    for (const CrackPixel& crack : cracks) copyColour(rgb, crack);
}

void mendDepths(const View& view, std::span<const std::uint16_t> labels, const RayCaster& rays,
                std::vector<float>& depth_m) {
    const int width = view.intrinsics.width;
    const int height = view.intrinsics.height;
    const std::vector<float> drawn = depth_m;
    for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) {
        const int x = static_cast<int>(pixel) % width;
        const int y = static_cast<int>(pixel) / width;
        if (!(drawn[pixel] > 0.0F) || !standsAlone(drawn, x, y, width, height)) continue;
        const ViewRay ray = view.rayThrough(x + 0.5, y + 0.5);
        const RayHit hit = rays.cast(ray.origin, ray.direction,
                                     std::numeric_limits<double>::infinity(), view.near_m);
        if (hit.object_id == 0 || (!labels.empty() && labels[pixel] != hit.object_id)) continue;
        depth_m[pixel] = static_cast<float>(hit.distance);
    }
}

void fillRightCracks(const FrameContext& context, const View& right, FrameRecord& record) {
    std::vector<std::uint16_t> shown(record.depth_right_m.size());
    std::transform(record.depth_right_m.begin(), record.depth_right_m.end(), shown.begin(),
                   [](float depth) { return std::uint16_t{depth > 0.0F}; });
    for (const CrackPixel& crack : findCracks(right, shown, *context.moving.raysAt(record.index))) {
        record.depth_right_m[crack.pixel] = static_cast<float>(crack.hit.distance);
        copyColour(record.rgb_right, crack);
    }
    mendDepths(right, {}, *context.moving.raysAt(record.index), record.depth_right_m);
}

}  // namespace dollytrack::render
