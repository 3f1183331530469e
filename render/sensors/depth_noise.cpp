#include "render/sensors/depth_noise.h"

#include "engine/scene/srgb.h"
#include "render/sensors/pixel_random.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr double kJitter_px = 0.25;
constexpr double kDisparityAtOneMetre_px = 35.130;
constexpr double kSteps_per_px = 8.0;
constexpr double kDisparityDeviation_px = 0.027778;

/// Whether there is a depth step at the pixel, or a neighbour without depth. On a plane the inverse
/// depth is linear in the image, however steep the plane.
bool isEdge(const DepthNoiseInput& input, const DepthLimits& limits, int x, int y) {
    const auto depthAt = [&](int at_x, int at_y) -> double {
        return input.depth_m[static_cast<std::size_t>(at_y) * input.lens.width + at_x];
    };
    const double here = depthAt(x, y);
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}}) {
        if (x < dx || x + dx >= input.lens.width) continue;
        if (y < std::abs(dy) || y + std::abs(dy) >= input.lens.height) continue;
        const double before = depthAt(x - dx, y - dy);
        const double after = depthAt(x + dx, y + dy);
        if (!(before > 0.0 && after > 0.0)) return true;
        const double nearest = std::min({before, here, after});
        const double step = std::abs(1.0 / before + 1.0 / after - 2.0 / here) * nearest *
                            std::max({before, here, after});
        if (step > std::max(limits.edge_m, limits.edge_share * nearest)) return true;
    }
    return false;
}

/// Simulates one depth image.
class DepthCamera {
  public:
    DepthCamera(const SensorParams& params, const DepthNoiseInput& input)
        : params_(params), input_(input), limits_(depthLimits(params.depth_noise)) {}

    [[nodiscard]] float see(int x, int y) const {
        const std::size_t here = pixel(x, y);
        if (params_.depth_noise == DepthNoise::None) return input_.depth_m[here];
        const double true_m = input_.depth_m[here];
        if (true_m < limits_.nearest_m || true_m > limits_.farthest_m) return 0.0F;
        if (isEdge(input_, limits_, x, y)) return 0.0F;
        const PixelRandom random(static_cast<std::uint32_t>(params_.sensor_seed), input_.frame,
                                 kDepthStream + here);
        const double strength = params_.depth_noise_strength;
        int from_x = nearest(x + strength * kJitter_px * random.normal(0), input_.lens.width);
        int from_y = nearest(y + strength * kJitter_px * random.normal(2), input_.lens.height);
        const bool redwood = params_.depth_noise == DepthNoise::Redwood;
        if (redwood) {  // after the jitter, as published: odd pixels are never read
            from_x -= from_x % 2;
            from_y -= from_y % 2;
        }
        const double depth = depthNear(here, pixel(from_x, from_y));
        const double seen = redwood ? byDisparity(depth, strength * random.normal(4))
                                    : byTimeOfFlight(depth, strength * random.normal(4), here);
        return seen >= limits_.nearest_m && seen <= limits_.farthest_m ? static_cast<float>(seen)
                                                                       : 0.0F;
    }

  private:
    static constexpr std::uint64_t kDepthStream = 2ULL << 40U;

    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * input_.lens.width + static_cast<std::size_t>(x);
    }

    [[nodiscard]] static int nearest(double at, int size) {
        return static_cast<int>(std::lround(std::clamp(at, 0.0, size - 1.0)));
    }

    /// Depth of another pixel, or the pixel's own if there is a step between them.
    [[nodiscard]] double depthNear(std::size_t here, std::size_t other) const {
        const double own = input_.depth_m[here];
        const double there = input_.depth_m[other];
        const double step = std::max(limits_.edge_m, limits_.edge_share * own);
        return there > 0.0 && std::abs(there - own) <= step ? there : own;
    }

    [[nodiscard]] static double byDisparity(double depth, double normal) {
        const double steps = std::round(
            kSteps_per_px * (kDisparityAtOneMetre_px / depth + kDisparityDeviation_px * normal));
        return steps > 0.0 ? kSteps_per_px * kDisparityAtOneMetre_px / steps : 0.0;
    }

    [[nodiscard]] double byTimeOfFlight(double depth, double normal, std::size_t here) const {
        const int x = static_cast<int>(here % static_cast<std::size_t>(input_.lens.width));
        const int y = static_cast<int>(here / static_cast<std::size_t>(input_.lens.width));
        const Eigen::Vector3d ray = input_.lens.unproject(x + 0.5, y + 0.5);
        const Eigen::Vector3d normal_in_camera =
            input_.world_from_camera.conjugate() * input_.normals_in_world[here].cast<double>();
        const double cosine = std::abs(ray.normalized().dot(normal_in_camera));
        const std::uint8_t* color = &input_.albedo[3 * here];
        double reflectance = 0.0;
        for (int c = 0; c < 3; ++c) {
            reflectance += linearFromSrgb(static_cast<float>(color[c]) / 255.0F) / 3.0;
        }
        const double way = depth * ray.norm();
        if (reflectance * cosine / (way * way) < kLeastLight_per_m2) return 0.0;
        return depth + normal * depthDeviation(DepthNoise::KinectAzure, depth) *
                           dimness(reflectance, cosine);
    }

    // Least light that gives a depth: a surface with 5 % reflectance at the end of the range.
    static constexpr double kLeastLight_per_m2 = 0.05 / (5.46 * 5.46);

    const SensorParams& params_;
    const DepthNoiseInput& input_;
    DepthLimits limits_;
};

}  // namespace

DepthLimits depthLimits(DepthNoise model) {
    switch (model) {
        case DepthNoise::None:
            break;
        case DepthNoise::KinectAzure:
            return {0.5, 5.46, 0.1, 0.05};
        case DepthNoise::Redwood:
            return {0.4, 10.0, 0.1, 0.05};
    }
    return {};
}

double depthDeviation(DepthNoise model, double depth_m) {
    switch (model) {
        case DepthNoise::None:
            break;
        case DepthNoise::KinectAzure:
            return 0.0005 + 0.001 * std::max(depth_m - 0.5, 0.0);
        case DepthNoise::Redwood: {
            // Combines the noise of the disparity with its uniform quantisation error.
            const double steps =
                std::hypot(kDisparityDeviation_px, 1.0 / kSteps_per_px / std::sqrt(12.0));
            return depth_m * depth_m / kDisparityAtOneMetre_px * steps;
        }
    }
    return 0.0;
}

double dimness(double reflectance, double cos_to_normal) {
    const double light = std::max(reflectance * cos_to_normal, 1e-6);
    return std::clamp(std::sqrt(0.5 / light), 0.5, kMostDim);
}

std::vector<float> noisyDepth(const SensorParams& params, const DepthNoiseInput& input) {
    const DepthCamera camera(params, input);
    std::vector<float> seen(input.depth_m.size());
    std::size_t i = 0;
    for (int y = 0; y < input.lens.height; ++y) {
        for (int x = 0; x < input.lens.width; ++x) seen[i++] = camera.see(x, y);
    }
    return seen;
}

}  // namespace dollytrack::render
