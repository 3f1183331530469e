#pragma once

#include "engine/camera/sensor_params.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// One of the pictures whose mean is a sensor's.
struct ExposureLook {
    double after_s = 0.0;                             // the frame's time
    Eigen::Vector2d lens = Eigen::Vector2d::Zero();   // of the aperture, in its radius
    Eigen::Vector2d aside = Eigen::Vector2d::Zero();  // in the pixel, px from its middle
};

/// When and from where a frame's picture is taken: looks evenly over the time that any row is
/// exposed, each from another point of the aperture and of the pixel. A row takes those of its own
/// exposure, the first and last of them in part, so that the middle of its time is right to a
/// quarter of the looks' distance. Rows of a rolling shutter are exposed for 1 / looks of the
/// readout at least, or more pictures than four times the looks would be needed.
class Exposure {
  public:
    /// `frame` turns the pattern of points, with the seed.
    Exposure(const SensorParams& params, int height, int frame);

    [[nodiscard]] const std::vector<ExposureLook>& looks() const { return looks_; }

    /// The time of a sensor's row (its middle at y + 0.5), after the frame's.
    [[nodiscard]] double timeOfRow(double y) const { return s_per_row_ * (y - 0.5 * height_); }
    [[nodiscard]] double secondsPerRow() const { return s_per_row_; }
    [[nodiscard]] bool rolls() const { return s_per_row_ > 0.0; }

    /// What share a look has of its row, before all are divided by their sum.
    [[nodiscard]] double weight(const ExposureLook& look, double y) const;

    /// Half of what a look, and of what a row's exposure, lasts.
    [[nodiscard]] double halfLook() const { return half_look_s_; }
    [[nodiscard]] double halfRow() const { return half_row_s_; }

  private:
    double height_ = 0.0;
    double s_per_row_ = 0.0;
    double half_look_s_ = 0.0;
    double half_row_s_ = 0.0;
    std::vector<ExposureLook> looks_;
};

}  // namespace dollytrack::render
