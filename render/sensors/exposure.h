#pragma once

#include "engine/camera/sensor_params.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// How long each row of a sensor is exposed, s: as the shutter says, but with a rolling one for
/// 1 / looks of the readout at least, or more looks than four times those asked for would be
/// needed.
[[nodiscard]] double rowExposureSeconds(const SensorParams& params, int height);

/// One of the pictures whose mean is a sensor's.
struct ExposureLook {
    double after_s = 0.0;                                // the frame's time
    Eigen::Vector2d aperture = Eigen::Vector2d::Zero();  // a point of it, in its radius
    Eigen::Vector2d aside_px = Eigen::Vector2d::Zero();  // in the pixel, from its middle
};

/// When and from where a frame's picture is taken: looks evenly over the time that any row is
/// exposed, each from a point of the aperture and of the pixel. A row takes those of its own
/// exposure, and the mean of their times is the middle of it exactly: light between two looks is
/// taken to change evenly from one to the other. The points repeat after as many looks as a row's
/// exposure is long, so that every row has each of them by the same share, and their mean is the
/// middle.
class Exposure {
  public:
    /// `frame` turns the pattern of points, with the seed.
    Exposure(const SensorParams& params, int height, int frame);

    [[nodiscard]] const std::vector<ExposureLook>& looks() const { return looks_; }

    /// The time of a sensor's row (its middle at y + 0.5), after the frame's.
    [[nodiscard]] double timeOfRow(double y) const { return row_step_s_ * (y - 0.5 * height_); }
    [[nodiscard]] double rowStepSeconds() const { return row_step_s_; }
    [[nodiscard]] bool rolls() const { return row_step_s_ > 0.0; }

    /// What share a look has of its row; the shares of a row are 1 together.
    [[nodiscard]] double weight(const ExposureLook& look, double y) const;

    [[nodiscard]] double rowExposureSeconds() const { return row_exposure_s_; }
    /// From a look to the next, s.
    [[nodiscard]] double lookStepSeconds() const { return look_step_s_; }

  private:
    double height_ = 0.0;
    double row_step_s_ = 0.0;
    double row_exposure_s_ = 0.0;
    double look_step_s_ = 0.0;
    std::vector<ExposureLook> looks_;
};

}  // namespace dollytrack::render
