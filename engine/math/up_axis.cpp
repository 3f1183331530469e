#include "engine/math/up_axis.h"

#include <cctype>

namespace dollytrack {

std::string UpAxis::text() const {
    return negative ? std::string{'-', letter} : std::string{letter};
}

Eigen::Matrix3d UpAxis::zUpFromSource() const {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (letter == 'x' && !negative) turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    if (letter == 'x' && negative) turn << 0, -1, 0, 0, 0, 1, -1, 0, 0;
    if (letter == 'y' && !negative) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (letter == 'y' && negative) turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    if (letter == 'z' && negative) turn << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    return turn;
}

std::optional<UpAxis> parseUpAxis(std::string_view text) {
    UpAxis axis;
    if (text.size() == 2 && (text[0] == '-' || text[0] == '+')) {
        axis.negative = text[0] == '-';
        text.remove_prefix(1);
    }
    if (text.size() != 1) return std::nullopt;
    axis.letter = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return axis.isAxis() ? std::optional(axis) : std::nullopt;
}

}  // namespace dollytrack
