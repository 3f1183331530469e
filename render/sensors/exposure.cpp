#include "render/sensors/exposure.h"

#include "render/sensors/pixel_random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dollytrack::render {
namespace {

/// Of the square onto the disc, areas kept (Shirley and Chiu, 1997).
Eigen::Vector2d onDisc(double u, double v) {
    const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    if (a == 0.0 && b == 0.0) return Eigen::Vector2d::Zero();
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b;
    const double angle = wide ? std::numbers::pi / 4.0 * (b / a)
                              : std::numbers::pi / 2.0 - std::numbers::pi / 4.0 * (a / b);
    return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace

Exposure::Exposure(const SensorParams& params, int height, int frame) : height_(height) {
    int count = params.looks;
    double row_s = params.shutter_s;
    if (params.readout_s > 0.0 && height > 1) {
        s_per_row_ = params.readout_s / (height - 1);
        row_s = std::max(row_s, params.readout_s / params.looks);
        const double times = (row_s + params.readout_s) / row_s;
        count = static_cast<int>(std::ceil(params.looks * std::min(times, 4.0)));
    }
    const double all_s = row_s + s_per_row_ * (height - 1);
    half_look_s_ = 0.5 * all_s / count;
    half_row_s_ = 0.5 * row_s;

    // Additive recurrence in four dimensions: any stretch of it is even (Roberts, The Unreasonable
    // Effectiveness of Quasirandom Sequences, 2018).
    constexpr double kRoot = 1.1673039782614187;  // x^5 = x + 1
    const PixelRandom random(static_cast<std::uint32_t>(params.sensor_seed), frame, 0);
    std::array<double, 4> start{};
    for (std::size_t d = 0; d < 4; ++d) start[d] = random.uniform(static_cast<std::uint32_t>(d));
    Eigen::Vector2d middle_lens = Eigen::Vector2d::Zero();
    Eigen::Vector2d middle_aside = Eigen::Vector2d::Zero();
    for (int i = 0; i < count; ++i) {
        std::array<double, 4> at{};
        for (std::size_t d = 0; d < 4; ++d) {
            const double step = std::pow(kRoot, -static_cast<double>(d + 1));
            at[d] = start[d] + step * i;
            at[d] -= std::floor(at[d]);
        }
        ExposureLook& look = looks_.emplace_back();
        look.after_s = all_s * ((i + 0.5) / count - 0.5);
        look.lens = onDisc(at[0], at[1]);
        look.aside = {at[2] - 0.5, at[3] - 0.5};
        middle_lens += look.lens / count;
        middle_aside += look.aside / count;
    }
    // On the mean the picture is that of the pixels' middles, as labels are.
    for (ExposureLook& look : looks_) {
        look.lens -= middle_lens;
        look.aside -= middle_aside;
    }
}

double Exposure::weight(const ExposureLook& look, double y) const {
    if (!rolls()) return 1.0;
    const double apart = std::abs(look.after_s - timeOfRow(y));
    return std::clamp(half_look_s_ + half_row_s_ - apart, 0.0,
                      2.0 * std::min(half_look_s_, half_row_s_)) /
           (2.0 * half_row_s_);
}

}  // namespace dollytrack::render
