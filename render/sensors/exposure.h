#pragma once

#include "engine/camera/sensor_params.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// Exposure time of each sensor row, s: the shutter time, but with a rolling shutter at least
/// readout / looks. A shorter exposure would need more than four times the configured number of
/// samples.
[[nodiscard]] double rowExposureSeconds(const SensorParams& params, int height);

/// One exposure sample; a sensor image is the mean of several.
struct ExposureSample {
    double after_s = 0.0;                                // s, relative to the frame's time
    Eigen::Vector2d aperture = Eigen::Vector2d::Zero();  // point of the aperture, in units of its
                                                         // radius
    Eigen::Vector2d aside_px = Eigen::Vector2d::Zero();  // offset from the pixel's centre
};

/// Exposure samples of one frame, evenly spaced over the time in which any row is exposed, each
/// with a point of the aperture and of the pixel. A row uses the samples within its own exposure;
/// its weights make the mean time exactly the middle of that exposure, with light interpolated
/// linearly between samples. The points repeat with the period of a row's exposure, so that every
/// row uses each point equally; the mean of all points is the centre.
class Exposure {
  public:
    /// `frame` and the sensor's seed vary the pattern of points.
    Exposure(const SensorParams& params, int height, int frame);

    [[nodiscard]] const std::vector<ExposureSample>& samples() const { return samples_; }

    /// Time of a sensor row relative to the frame's, s; the row's centre is y + 0.5.
    [[nodiscard]] double timeOfRow(double y) const { return row_step_s_ * (y - 0.5 * height_); }
    [[nodiscard]] double rowStepSeconds() const { return row_step_s_; }
    [[nodiscard]] bool rolls() const { return row_step_s_ > 0.0; }

    /// Weight of a sample in a row; a row's weights sum to 1.
    [[nodiscard]] double weight(const ExposureSample& sample, double y) const;

    [[nodiscard]] double rowExposureSeconds() const { return row_exposure_s_; }
    /// Time between samples, s.
    [[nodiscard]] double sampleStepSeconds() const { return sample_step_s_; }

  private:
    double height_ = 0.0;
    double row_step_s_ = 0.0;
    double row_exposure_s_ = 0.0;
    double sample_step_s_ = 0.0;
    std::vector<ExposureSample> samples_;
};

}  // namespace dollytrack::render
