#pragma once

#include "engine/camera/camera_params.h"
#include "engine/camera/intrinsics.h"
#include "engine/camera/lens_distortion.h"
#include "engine/camera/sensor_params.h"
#include "engine/core/result.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace dollytrack::render {

/// Lens distortion of the sensor's images.
[[nodiscard]] LensDistortion distortionOf(const SensorParams& params);

/// Horizontal field of view of a 4:3 image for which the presets' distortion is defined.
inline constexpr double kPresetFov_deg = 60.0;

/// Fits a preset's distortion to this camera. If all five coefficients are the preset's and the
/// image's corner is farther from the axis than at kPresetFov_deg, they are scaled so that the
/// corner moves by the same share of the image. Otherwise the parameters stay: a narrower image
/// shows the centre of the preset's, and coefficients set by hand are kept. Repeated calls change
/// nothing.
[[nodiscard]] SensorParams fitPresetLens(const CameraParams& camera, SensorParams params);

/// Checks that every pixel shows something. Returns Usage, with advice, if the distortion model
/// folds over, or leads more than an image's size outside, before it reaches the corners.
[[nodiscard]] Status validateLens(const CameraParams& camera, const SensorParams& params);

/// Maps a sensor's pixels through its lens to a pinhole image that is large enough for all that the
/// lens shows. Focal length, and so the scale in the centre, are those of the clean image.
/// Thread-safe.
class SensorLens {
  public:
    SensorLens(const CameraParams& camera, const SensorParams& params);

    /// Intrinsics of the pinhole image to draw: the clean camera with added borders.
    [[nodiscard]] const Intrinsics& drawn() const { return drawn_; }

    /// Position in the drawn image (px) that the centre of a sensor pixel maps to. NaN if the lens
    /// shows nothing there: beyond the model's range, or more than an image's size outside.
    [[nodiscard]] const Eigen::Vector2f& sourceOf(std::size_t pixel) const {
        return sources_[pixel];
    }

    /// Vignetting: the share of light that reaches the pixel.
    [[nodiscard]] float lightShare(std::size_t pixel) const { return light_shares_[pixel]; }

    /// Largest displacement from the clean image, px.
    [[nodiscard]] double largestShift_px() const { return largest_shift_px_; }

    /// Number of sensor pixels that stay black.
    [[nodiscard]] std::size_t blackCount() const { return black_count_; }

    /// Resamples a drawn image to the sensor's, 3 values per pixel: bicubic (Catmull-Rom), clamped
    /// to the four nearest values, with vignetting applied.
    [[nodiscard]] std::vector<float> take(std::span<const float> drawn) const;

    /// Rows [begin, end) of the drawn image that sensor rows `first` to `last` need. Both may be
    /// fractions.
    [[nodiscard]] std::pair<int, int> drawnRows(double first, double last) const;

  private:
    Intrinsics sensor_;
    Intrinsics drawn_;
    std::vector<Eigen::Vector2f> sources_;
    std::vector<float> light_shares_;
    // By sensor row: smallest and largest y in the drawn image, px.
    std::vector<std::pair<float, float>> drawn_reach_px_;
    double largest_shift_px_ = 0.0;
    std::size_t black_count_ = 0;
    bool straight_ = false;  // no distortion: sensor and drawn pixels coincide
};

}  // namespace dollytrack::render
