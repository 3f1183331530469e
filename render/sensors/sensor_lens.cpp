#include "render/sensors/sensor_lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace dollytrack::render {
namespace {

constexpr double kLeastFov_deg = 10.0;  // smallest field of view that a camera may have
constexpr int kKernelReach_px = 2;      // pixels on either side that the bicubic kernel reads

/// Weights of the four pixels around a position between the middle two (Catmull and Rom, 1974).
std::array<float, 4> cubic(float t) {
    return {0.5F * (-t + 2 * t * t - t * t * t), 0.5F * (2 - 5 * t * t + 3 * t * t * t),
            0.5F * (t + 4 * t * t - 3 * t * t * t), 0.5F * (-t * t + t * t * t)};
}

/// Position in the extended clean image (px) that the sensor position (x, y) maps to.
std::optional<Eigen::Vector2d> pinholePosition(const Intrinsics& sensor, const LensDistortion& lens,
                                               double x, double y) {
    const auto straight = lens.straighten(sensor.unproject(x, y).head<2>());
    if (!straight) return std::nullopt;
    const Eigen::Vector2d at = sensor.project({straight->x(), straight->y(), 1.0});
    // Bounds the size of the drawn image, which strong distortion would enlarge without limit.
    const Eigen::Vector2d size(sensor.width, sensor.height);
    if (!Eigen::AlignedBox2d(-size, 2.0 * size).contains(at)) return std::nullopt;
    return at;
}

/// Whether all border pixels show something; then all pixels nearer to the centre do, too.
bool fillsPicture(const CameraParams& camera, const LensDistortion& lens) {
    const Intrinsics sensor = makeIntrinsics(camera);
    for (int x = 0; x < sensor.width; ++x) {
        for (const int y : {0, sensor.height - 1}) {
            if (!pinholePosition(sensor, lens, x + 0.5, y + 0.5)) return false;
        }
    }
    for (int y = 0; y < sensor.height; ++y) {
        for (const int x : {0, sensor.width - 1}) {
            if (!pinholePosition(sensor, lens, x + 0.5, y + 0.5)) return false;
        }
    }
    return true;
}

}  // namespace

SensorParams fitPresetLens(const CameraParams& camera, SensorParams params) {
    const SensorParams preset = sensorPreset(params.sensor_preset);
    const bool as_preset = params.k1 == preset.k1 && params.k2 == preset.k2 &&
                           params.p1 == preset.p1 && params.p2 == preset.p2 &&
                           params.k3 == preset.k3;
    const auto cornerOf = [](const CameraParams& one) {
        return makeIntrinsics(one).unproject(0.0, 0.0).head<2>().norm();
    };
    CameraParams usual;
    usual.width_px = 640;
    usual.height_px = 480;
    usual.hfov_deg = kPresetFov_deg;
    const double scale = cornerOf(usual) / cornerOf(camera);
    if (!as_preset || !(scale < 1.0 - 1e-9)) return params;
    const double square = scale * scale;
    params.k1 *= square;
    params.k2 *= square * square;
    params.k3 *= square * square * square;
    params.p1 *= scale;
    params.p2 *= scale;
    return params;
}

Status validateLens(const CameraParams& camera, const SensorParams& params) {
    const LensDistortion lens = distortionOf(params);
    if (lens.none() || fillsPicture(camera, lens)) return {};
    CameraParams narrower = camera;
    narrower.hfov_deg = std::ceil(camera.hfov_deg);
    do {
        narrower.hfov_deg -= 1.0;
    } while (narrower.hfov_deg >= kLeastFov_deg && !fillsPicture(narrower, lens));
    const std::string narrow = narrower.hfov_deg < kLeastFov_deg
                                   ? ""
                                   : fmt::format("lower hfov_deg from {:g} to {:g}, or ",
                                                 camera.hfov_deg, narrower.hfov_deg);
    return fail(
        ErrorCode::Usage,
        fmt::format("The distortion k1 {:g}, k2 {:g}, k3 {:g}, p1 {:g}, p2 {:g} maps two "
                    "directions to one pixel within the image: {}bring these values nearer to 0.",
                    lens.k1, lens.k2, lens.k3, lens.p1, lens.p2, narrow),
        "sensor");
}

LensDistortion distortionOf(const SensorParams& params) {
    return {params.k1, params.k2, params.p1, params.p2, params.k3};
}

SensorLens::SensorLens(const CameraParams& camera, const SensorParams& params)
    : sensor_(makeIntrinsics(camera)), drawn_(sensor_) {
    const LensDistortion lens = distortionOf(params);
    straight_ = lens.none();
    const auto pixels =
        static_cast<std::size_t>(sensor_.width) * static_cast<std::size_t>(sensor_.height);
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    sources_.assign(pixels, {kNowhere, kNowhere});
    light_shares_.assign(pixels, 0.0F);
    Eigen::AlignedBox2d reach(Eigen::Vector2d::Zero(),
                              Eigen::Vector2d(sensor_.width, sensor_.height));
    const Eigen::Vector2d size = reach.max();
    std::size_t pixel = 0;
    for (int y = 0; y < sensor_.height; ++y) {
        for (int x = 0; x < sensor_.width; ++x, ++pixel) {
            const auto at = pinholePosition(sensor_, lens, x + 0.5, y + 0.5);
            if (!at) continue;
            sources_[pixel] = at->cast<float>();
            if (!straight_) reach.extend(*at);
            largest_shift_px_ =
                std::max(largest_shift_px_, (*at - Eigen::Vector2d(x + 0.5, y + 0.5)).norm());
            const double off_axis = sensor_.unproject(at->x(), at->y()).squaredNorm();  // 1 / cos^2
            light_shares_[pixel] =
                static_cast<float>(1.0 - params.vignetting * (1.0 - 1.0 / (off_axis * off_axis)));
        }
    }
    black_count_ = static_cast<std::size_t>(std::ranges::count_if(
        sources_, [](const Eigen::Vector2f& at) { return std::isnan(at.x()); }));
    if (!straight_) {
        const auto border = [](double beyond) {
            return static_cast<int>(std::ceil(std::max(beyond, 0.0))) + kKernelReach_px;
        };
        const int left = border(-reach.min().x()), top = border(-reach.min().y());
        drawn_.width += left + border(reach.max().x() - size.x());
        drawn_.height += top + border(reach.max().y() - size.y());
        drawn_.cx += left;
        drawn_.cy += top;
        for (Eigen::Vector2f& at : sources_) at += Eigen::Vector2i(left, top).cast<float>();
    }
    for (int y = 0; y < sensor_.height; ++y) {
        std::pair<float, float> row{1e9F, -1e9F};
        for (int x = 0; x < sensor_.width; ++x) {
            const float at = sources_[static_cast<std::size_t>(y) * sensor_.width + x].y();
            if (std::isnan(at)) continue;
            row = {std::min(row.first, at), std::max(row.second, at)};
        }
        drawn_reach_px_.push_back(row);
    }
}

std::pair<int, int> SensorLens::drawnRows(double first, double last) const {
    // With a very short readout first and last exceed the range of int.
    const double rows = sensor_.height;
    const int begin = static_cast<int>(std::clamp(std::floor(first) - 1.0, 0.0, rows));
    const int end = static_cast<int>(std::clamp(std::ceil(last) + 2.0, 0.0, rows));
    float low = 1e9F;
    float high = -1e9F;
    for (int y = begin; y < end; ++y) {
        const auto& [least, largest] = drawn_reach_px_[y];
        low = std::min(low, least);
        high = std::max(high, largest);
    }
    if (low > high) return {0, 0};
    return {std::clamp(static_cast<int>(std::floor(low)) - kKernelReach_px, 0, drawn_.height),
            std::clamp(static_cast<int>(std::ceil(high)) + kKernelReach_px, 0, drawn_.height)};
}

std::vector<float> SensorLens::take(std::span<const float> drawn) const {
    std::vector<float> seen(3 * sources_.size(), 0.0F);
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        if (std::isnan(sources_[i].x())) continue;
        if (straight_) {
            for (std::size_t c = 0; c < 3; ++c) {
                seen[3 * i + c] = light_shares_[i] * drawn[3 * i + c];
            }
            continue;
        }
        const float x = sources_[i].x() - 0.5F, y = sources_[i].y() - 0.5F;
        const float left = std::floor(x), top = std::floor(y);
        const std::array<float, 4> across = cubic(x - left);
        const std::array<float, 4> down = cubic(y - top);
        std::array<float, 3> sum{};
        std::array<float, 3> least{1e30F, 1e30F, 1e30F};
        std::array<float, 3> most{};
        for (int dy = 0; dy < 4; ++dy) {
            const int row = std::clamp(static_cast<int>(top) + dy - 1, 0, drawn_.height - 1);
            for (int dx = 0; dx < 4; ++dx) {
                const int column = std::clamp(static_cast<int>(left) + dx - 1, 0, drawn_.width - 1);
                const float* from = &drawn[3 * (static_cast<std::size_t>(row) * drawn_.width +
                                                static_cast<std::size_t>(column))];
                const bool near = dx % 3 != 0 && dy % 3 != 0;
                const float weight = across[dx] * down[dy];
                for (std::size_t c = 0; c < 3; ++c) {
                    sum[c] += weight * from[c];
                    if (!near) continue;
                    least[c] = std::min(least[c], from[c]);
                    most[c] = std::max(most[c], from[c]);
                }
            }
        }
        for (std::size_t c = 0; c < 3; ++c) {
            seen[3 * i + c] = light_shares_[i] * std::clamp(sum[c], least[c], most[c]);
        }
    }
    return seen;
}

}  // namespace dollytrack::render
