#include "render/sensors/exposure.h"

#include "render/sensors/pixel_random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

/// Maps the unit square to the unit disc, preserving areas (Shirley and Chiu, 1997).
Eigen::Vector2d onDisc(double u, double v) {
    const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    if (a == 0.0 && b == 0.0) return Eigen::Vector2d::Zero();
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b;
    const double angle = wide ? std::numbers::pi / 4.0 * (b / a)
                              : std::numbers::pi / 2.0 - std::numbers::pi / 4.0 * (a / b);
    return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// Integral from -1 to x of the hat function of height 1 on [-1, 1].
double hatUpTo(double x) {
    const double inside = std::clamp(x, -1.0, 1.0);
    return 0.5 + inside - 0.5 * inside * std::abs(inside);
}

}  // namespace

double rowExposureSeconds(const SensorParams& params, int height) {
    if (params.readout_s <= 0.0 || height <= 1) return params.shutter_s;
    return std::max(params.shutter_s, params.readout_s / params.looks);
}

Exposure::Exposure(const SensorParams& params, int height, int frame)
    : height_(height), row_exposure_s_(render::rowExposureSeconds(params, height)) {
    int period = params.looks;  // samples in a row's exposure, and period of the points
    int count = params.looks;
    if (params.readout_s > 0.0 && height > 1) {
        row_step_s_ = params.readout_s / (height - 1);
        const double exposures = 1.0 + params.readout_s / row_exposure_s_;
        period = std::min(params.looks,
                          static_cast<int>(std::floor((4.0 * params.looks - 1.0) / exposures)));
        // The samples must cover the exposures of all rows.
        count = 1 + static_cast<int>(std::ceil(period * exposures - 1e-9));
    }
    sample_step_s_ = row_exposure_s_ / period;

    // Additive recurrence in four dimensions, whose segments are all well distributed (Roberts, The
    // Unreasonable Effectiveness of Quasirandom Sequences, 2018).
    constexpr double kRoot = 1.1673039782614187;  // x^5 = x + 1
    const PixelRandom random(static_cast<std::uint32_t>(params.sensor_seed), frame, 0);
    std::array<double, 4> start{};
    for (std::size_t d = 0; d < 4; ++d) start[d] = random.uniform(static_cast<std::uint32_t>(d));
    std::vector<ExposureSample> points(period);
    Eigen::Vector2d middle_aperture = Eigen::Vector2d::Zero();
    Eigen::Vector2d middle_aside_px = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::array<double, 4> at{};
        for (std::size_t d = 0; d < 4; ++d) {
            const double step = std::pow(kRoot, -static_cast<double>(d + 1));
            at[d] = start[d] + step * static_cast<double>(i);
            at[d] -= std::floor(at[d]);
        }
        points[i].aperture = onDisc(at[0], at[1]);
        points[i].aside_px = {at[2] - 0.5, at[3] - 0.5};
        middle_aperture += points[i].aperture / period;
        middle_aside_px += points[i].aside_px / period;
    }
    // Offsets average to zero, so that the image is centred on the pixel centres, as labels are.
    for (int i = 0; i < count; ++i) {
        ExposureSample& sample = samples_.emplace_back(points[i % period]);
        sample.after_s = sample_step_s_ * (i - 0.5 * (count - 1));
        sample.aperture -= middle_aperture;
        sample.aside_px -= middle_aside_px;
    }
}

double Exposure::weight(const ExposureSample& sample, double y) const {
    if (!rolls()) return 1.0 / static_cast<double>(samples_.size());
    const double middle = (timeOfRow(y) - sample.after_s) / sample_step_s_;
    const double half = 0.5 * row_exposure_s_ / sample_step_s_;
    return (hatUpTo(middle + half) - hatUpTo(middle - half)) / (2.0 * half);
}

}  // namespace dollytrack::render
