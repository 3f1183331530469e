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

/// Projection of a rig camera. Image positions are in px from the image's top left corner; the
/// centre of pixel (0, 0) is at (0.5, 0.5), and the axis is in the image's centre.
///
/// - pinhole: x = f X/Z + w/2, with f from the field of view across the width;
/// - fisheye: r = f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9), with the angle t from the axis and the
///   distance r from the image's centre (Kannala and Brandt 2006, OpenCV's fisheye module);
///   equidistant if all k are 0. With this f, half the field of view is at w/2, where the image
///   circle ends;
/// - equirectangular: x = w (1/2 + lon / 2 pi), y = h (1/2 - lat / pi), with lon = atan2(X, Z) to
///   the right and lat upwards;
/// - orthographic: x = s X + w/2, y = s Y + h/2, with s px per metre.
class LensModel {
  public:
    /// `camera` must pass validate().
    explicit LensModel(const RigCamera& camera);

    [[nodiscard]] Lens lens() const { return lens_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Focal length, px; for orthographic lenses px per metre, for equirectangular ones horizontal
    /// px per radian.
    [[nodiscard]] double focal() const { return focal_; }
    /// Largest visible angle from the axis, radians.
    [[nodiscard]] double widest() const { return widest_; }
    /// Whether depths are along the ray.
    [[nodiscard]] bool measuresRange() const {
        return lens_ == Lens::Fisheye || lens_ == Lens::Equirectangular;
    }

    /// The ray through an image position; nullopt outside a fisheye's image circle.
    [[nodiscard]] std::optional<LensRay> ray(double x, double y) const;

    /// Image position of a point in the camera frame; it may be outside the image. Nullopt if the
    /// point is behind the lens or outside a fisheye's field of view.
    [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& in_camera) const;

    /// The highest resolution in the image, px per radian, except where it is stretched without
    /// bound (an equirectangular image's rows near the poles). Only for lenses with one centre.
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
