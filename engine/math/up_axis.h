#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>

namespace dollytrack {

/// The direction along a source's axes that points up: x, y, z or, negative, -x, -y, -z.
struct UpAxis {
    char letter = 0;  // 'x', 'y' or 'z'; 0: not known
    bool negative = false;

    constexpr UpAxis() = default;
    constexpr UpAxis(char axis, bool is_negative = false) : letter(axis), negative(is_negative) {}

    [[nodiscard]] constexpr bool isAxis() const { return letter >= 'x' && letter <= 'z'; }
    [[nodiscard]] constexpr int index() const { return letter - 'x'; }
    [[nodiscard]] constexpr double sign() const { return negative ? -1.0 : 1.0; }
    /// Unit length, in the source's axes.
    [[nodiscard]] Eigen::Vector3d direction() const {
        return sign() * Eigen::Vector3d::Unit(index());
    }
    /// "y" or "-y", as parseUpAxis() reads it.
    [[nodiscard]] std::string text() const;
    /// Turns the source's axes so that this one becomes z; no mirroring.
    [[nodiscard]] Eigen::Matrix3d zUpFromSource() const;

    friend constexpr bool operator==(const UpAxis&, const UpAxis&) = default;
};

/// The six of them, as they are written.
inline constexpr std::string_view kUpAxes = "x, y, z, -x, -y or -z";

/// "z", "+z" or "-z", in either case; none for anything else.
[[nodiscard]] std::optional<UpAxis> parseUpAxis(std::string_view text);

}  // namespace dollytrack
