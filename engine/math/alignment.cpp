#include "engine/math/alignment.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace dollytrack {
namespace {

Eigen::Vector3d meanOf(std::span<const Eigen::Vector3d> points) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) sum += point;
    return points.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(points.size()));
}

}  // namespace

// Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
// PAMI 13 (1991): the rotation from the singular vectors of the covariance, the scale from its
// singular values.
Similarity alignPoints(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> onto,
                       bool with_scale) {
    const Eigen::Vector3d middle_from = meanOf(from);
    const Eigen::Vector3d middle_onto = meanOf(onto);
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double spread = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        covariance += (onto[i] - middle_onto) * (from[i] - middle_from).transpose();
        spread += (from[i] - middle_from).squaredNorm();
    }
    Similarity result;
    if (spread > 0.0 && covariance.norm() > 0.0) {
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                                    Eigen::ComputeFullU | Eigen::ComputeFullV);
        Eigen::Vector3d signs = Eigen::Vector3d::Ones();
        if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
        result.rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
        if (with_scale) result.scale = svd.singularValues().dot(signs) / spread;
    }
    result.translation = middle_onto - result.scale * (result.rotation * middle_from);
    return result;
}

}  // namespace dollytrack
