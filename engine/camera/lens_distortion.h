#pragma once

#include <Eigen/Core>

#include <optional>

namespace dollytrack {

/// How a lens bends straight lines: Brown's model (Close-Range Camera Calibration, 1971) with
/// OpenCV's coefficients and signs. Places are x / z and y / z in the camera's axes, without unit.
struct LensDistortion {
    double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;

    [[nodiscard]] bool none() const {
        return k1 == 0.0 && k2 == 0.0 && p1 == 0.0 && p2 == 0.0 && k3 == 0.0;
    }

    /// Where the lens shows what a pinhole would show at `straight`.
    [[nodiscard]] Eigen::Vector2d bend(const Eigen::Vector2d& straight) const;

    /// What the lens shows at `bent`, to 1e-9; nothing where the model does not reach (strong
    /// barrels fold over beyond some angle).
    [[nodiscard]] std::optional<Eigen::Vector2d> straighten(const Eigen::Vector2d& bent) const;

    /// Whether the radial distortion is monotonic: the distorted radius grows with the undistorted
    /// one from 0 to `straight_radius`.
    [[nodiscard]] bool risesTo(double straight_radius) const;

  private:
    [[nodiscard]] Eigen::Matrix2d slope(const Eigen::Vector2d& straight) const;
};

}  // namespace dollytrack
