#pragma once

#include <numbers>

namespace dollytrack {

inline constexpr double kDegree = std::numbers::pi / 180.0;  // rad

}  // namespace dollytrack
