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

/// The distortion that the sensor's pictures have.
[[nodiscard]] LensDistortion distortionOf(const SensorParams& params);

/// The presets' distortion is made for this horizontal field of view of a 4:3 picture.
inline constexpr double kPresetFov_deg = 60.0;

/// The sensor with the lens that its preset has in this camera: where all five coefficients are the
/// preset's and the picture's corner lies further out than that of kPresetFov_deg, they are scaled,
/// so that the corner moves by the same share of the picture as there. Else as it is: narrower
/// pictures are the middle of the preset's, and what was set by hand counts as it stands. Repeating
/// it changes nothing.
[[nodiscard]] SensorParams fitPresetLens(const CameraParams& camera, SensorParams params);

/// Whether the lens shows something in every pixel: its model may fold over, or look further than a
/// picture's size outside, before it comes to the corners. Error: Usage, with what to change.
[[nodiscard]] Status validateLens(const CameraParams& camera, const SensorParams& params);

/// How a sensor's pixels look through its lens at a picture that is drawn as by a pinhole, large
/// enough for all that the lens shows. The focal length, and so the scale in the middle, is the
/// clean picture's. Const, many threads.
class SensorLens {
  public:
    SensorLens(const CameraParams& camera, const SensorParams& params);

    /// Of the picture to draw: the clean camera with borders.
    [[nodiscard]] const Intrinsics& drawn() const { return drawn_; }

    /// Where in the drawn picture (px) the middle of a sensor's pixel looks; NaN where the lens
    /// shows nothing: beyond what the model reaches, or more than a picture's size outside.
    [[nodiscard]] const Eigen::Vector2f& lookOf(std::size_t pixel) const { return looks_[pixel]; }

    /// The share of light that the lens leaves the pixel.
    [[nodiscard]] float lightShare(std::size_t pixel) const { return light_shares_[pixel]; }

    /// How far beside its place in the clean picture anything is shown, px.
    [[nodiscard]] double largestShift_px() const { return largest_shift_px_; }

    /// Pixels of the sensor that stay black.
    [[nodiscard]] std::size_t blackCount() const { return black_count_; }

    /// The sensor's picture of a drawn one, 3 values a pixel: cubic (Catmull-Rom) between pixels,
    /// within the values around, and darkened.
    [[nodiscard]] std::vector<float> take(std::span<const float> drawn) const;

    /// Rows of the drawn picture that hold all that the sensor's rows from `first` to `last` look
    /// at: begin and end. Both may be fractions.
    [[nodiscard]] std::pair<int, int> drawnRows(double first, double last) const;

  private:
    Intrinsics sensor_;
    Intrinsics drawn_;
    std::vector<Eigen::Vector2f> looks_;
    std::vector<float> light_shares_;
    // By sensor row: least and largest y in the drawn picture.
    std::vector<std::pair<float, float>> drawn_reach_px_;
    double largest_shift_px_ = 0.0;
    std::size_t black_count_ = 0;
    bool straight_ = false;  // drawn and seen pixels are the same
};

}  // namespace dollytrack::render
