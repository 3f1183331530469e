#pragma once

#include "engine/camera/rig.h"

#include <Eigen/Core>

#include <optional>

namespace dollytrack {

/// The ray of a pixel, in the camera's axes (x right, y down, z forward; m). Lengths along it are
/// the depths that datasets hold: along the axis for pinhole and orthographic lenses (direction.z
/// is 1), along the ray for the others (unit direction).
struct LensRay {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// What a rig camera's pixels look at. Image positions are in px from the picture's top left
/// corner; pixel (0, 0) has its centre at (0.5, 0.5), the axis is in the middle.
///
/// - pinhole: x = f X/Z + w/2, with f from the field of view across the width;
/// - fisheye: r = f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9), t the angle from the axis, r the
///   distance from the middle (Kannala and Brandt 2006, as OpenCV's fisheye module has it);
///   equidistant where all k are 0. f puts half the field of view at w/2, where the image ends;
/// - equirectangular: x = w (1/2 + lon / 2 pi), y = h (1/2 - lat / pi), lon = atan2(X, Z) to the
///   right, lat upwards;
/// - orthographic: x = s X + w/2, y = s Y + h/2, with s px a metre.
class LensModel {
  public:
    /// `camera` must pass validate().
    explicit LensModel(const RigCamera& camera);

    [[nodiscard]] Lens lens() const { return lens_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// px, or px a metre of an orthographic lens; of an equirectangular one px a radian across.
    [[nodiscard]] double focal() const { return focal_; }
    /// The largest angle from the axis that is seen, radians.
    [[nodiscard]] double widest() const { return widest_; }
    /// Whether depths are along the ray.
    [[nodiscard]] bool measuresRange() const {
        return lens_ == Lens::Fisheye || lens_ == Lens::Equirectangular;
    }

    /// Nothing outside of a fisheye's image circle.
    [[nodiscard]] std::optional<LensRay> ray(double x, double y) const;

    /// Image position of a point in the camera's axes, which may lie outside of the picture;
    /// nothing of what the lens cannot see: behind it, beyond a fisheye's field of view.
    [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& in_camera) const;

    /// The most px a radian that the picture has anywhere, in any direction where it is not
    /// stretched without end (an equirectangular picture's rows near the poles are). Of lenses with
    /// one centre.
    [[nodiscard]] double mostPxPerRadian() const;

  private:
    Lens lens_;
    int width_;
    int height_;
    double focal_ = 0.0;
    double widest_ = 0.0;
    Eigen::Vector4d k_ = Eigen::Vector4d::Zero();
};

/// Whether a fisheye's distances rise with the angle, out to half its field of view.
[[nodiscard]] bool risesEverywhere(const RigCamera& camera);

}  // namespace dollytrack
