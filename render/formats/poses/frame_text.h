#pragma once

#include "engine/math/pose.h"

#include <fmt/format.h>

#include <string>

namespace dollytrack::render {

/// Numbers with nine decimals, independent of the locale and without exponents, separated by
/// spaces.
template <class Vector>
std::string numbersText(const Vector& values) {
    std::string text;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        text += fmt::format("{}{:.9f}", i == 0 ? "" : " ", values[i] + 0.0);
    }
    return text;
}

/// A pose as "tx ty tz qx qy qz qw".
[[nodiscard]] inline std::string positionQuaternionText(const Eigen::Vector3d& position,
                                                        const Eigen::Quaterniond& rotation) {
    return numbersText(position) + " " + numbersText(rotation.coeffs());
}

/// Seconds with six decimals.
[[nodiscard]] inline std::string stampText(double time_s) {
    return fmt::format("{:.6f}", time_s + 0.0);
}

/// A matrix's rows, one after the other.
template <class Matrix>
std::string rowsText(const Matrix& matrix) {
    std::string text;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
        if (row > 0) text += ' ';
        text += numbersText(matrix.row(row));
    }
    return text;
}

}  // namespace dollytrack::render
