#include "engine/camera/lens_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack {
namespace {

constexpr double kPi = std::numbers::pi;

/// Kannala and Brandt's image radius of an angle, for a focal length of 1.
double distanceAt(const Eigen::Vector4d& k, double angle) {
    const double s = angle * angle;
    return angle * (1.0 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3]))));
}

double slopeAt(const Eigen::Vector4d& k, double angle) {
    const double s = angle * angle;
    return 1.0 + s * (3.0 * k[0] + s * (5.0 * k[1] + s * (7.0 * k[2] + s * 9.0 * k[3])));
}

/// The angle, up to `widest`, that has an image radius: Newton's method, safeguarded by bisection.
double angleAt(const Eigen::Vector4d& k, double distance, double widest) {
    if (k.isZero(0.0)) return distance;
    double low = 0.0, high = widest;
    double angle = std::min(distance, widest);
    for (int i = 0; i < 100; ++i) {
        const double off = distanceAt(k, angle) - distance;
        (off > 0.0 ? high : low) = angle;
        double next = angle - off / slopeAt(k, angle);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - angle) <= 1e-15 * widest) return next;
        angle = next;
    }
    return angle;
}

Eigen::Vector4d coefficients(const RigCamera& camera) {
    return {camera.k1, camera.k2, camera.k3, camera.k4};
}

constexpr int kSteps = 2000;  // samples of a fisheye's slope

}  // namespace

bool risesEverywhere(const RigCamera& camera) {
    const double widest = camera.fov_deg * kPi / 360.0;
    for (int i = 0; i <= kSteps; ++i) {
        if (!(slopeAt(coefficients(camera), widest * i / kSteps) > 0.01)) return false;
    }
    return true;
}

LensModel::LensModel(const RigCamera& camera)
    : lens_(camera.lens), width_(camera.width_px), height_(camera.height_px) {
    const double half = camera.fov_deg * kPi / 360.0;
    switch (lens_) {
        case Lens::Pinhole:
            focal_ = 0.5 * width_ / std::tan(half);
            widest_ = std::atan(0.5 * std::hypot(width_, height_) / focal_);
            break;
        case Lens::Fisheye:
            k_ = coefficients(camera);
            focal_ = 0.5 * width_ / distanceAt(k_, half);
            widest_ = half;
            break;
        case Lens::Equirectangular:
            focal_ = width_ / (2.0 * kPi);
            widest_ = kPi;
            break;
        case Lens::Orthographic:
            focal_ = camera.px_per_m;
            break;
    }
}

std::optional<LensRay> LensModel::ray(double x, double y) const {
    const double across = x - 0.5 * width_;
    const double below = y - 0.5 * height_;
    LensRay ray;
    switch (lens_) {
        case Lens::Pinhole:
            ray.direction = {across / focal_, below / focal_, 1.0};
            return ray;
        case Lens::Orthographic:
            ray.origin = {across / focal_, below / focal_, 0.0};
            return ray;
        case Lens::Equirectangular: {
            const double lon = 2.0 * kPi * across / width_;
            const double lat = -kPi * below / height_;
            ray.direction = {std::cos(lat) * std::sin(lon), -std::sin(lat),
                             std::cos(lat) * std::cos(lon)};
            return ray;
        }
        case Lens::Fisheye: {
            const double r = std::hypot(across, below);
            if (r > 0.5 * width_ * (1.0 + 1e-12)) return std::nullopt;
            if (r == 0.0) return ray;
            const double angle = std::min(angleAt(k_, r / focal_, widest_), widest_);
            const double aside = std::sin(angle) / r;
            ray.direction = {aside * across, aside * below, std::cos(angle)};
            return ray;
        }
    }
    return std::nullopt;
}

std::optional<Eigen::Vector2d> LensModel::project(const Eigen::Vector3d& in_camera) const {
    const Eigen::Vector2d middle(0.5 * width_, 0.5 * height_);
    switch (lens_) {
        case Lens::Pinhole:
            if (!(in_camera.z() > 0.0)) return std::nullopt;
            return focal_ * in_camera.head<2>() / in_camera.z() + middle;
        case Lens::Orthographic:
            if (!(in_camera.z() > 0.0)) return std::nullopt;
            return focal_ * in_camera.head<2>() + middle;
        case Lens::Equirectangular: {
            const double aside = std::hypot(in_camera.x(), in_camera.z());
            const double lon = std::atan2(in_camera.x(), in_camera.z());
            const double lat = std::atan2(-in_camera.y(), aside);
            return middle + Eigen::Vector2d(width_ * lon / (2.0 * kPi), -height_ * lat / kPi);
        }
        case Lens::Fisheye: {
            const double aside = in_camera.head<2>().norm();
            const double angle = std::atan2(aside, in_camera.z());
            if (angle > widest_ + 1e-12) return std::nullopt;
            if (aside == 0.0) return middle;
            return middle + focal_ * distanceAt(k_, angle) / aside * in_camera.head<2>();
        }
    }
    return std::nullopt;
}

double LensModel::mostPxPerRadian() const {
    if (lens_ == Lens::Equirectangular) return std::max(focal_, height_ / kPi);
    if (lens_ == Lens::Pinhole) return focal_ / std::pow(std::cos(widest_), 2);
    double most = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const double angle = widest_ * i / kSteps;
        most = std::max({most, slopeAt(k_, angle), distanceAt(k_, angle) / std::sin(angle)});
    }
    return focal_ * most;
}

}  // namespace dollytrack
