#pragma once

#include <string_view>

namespace dollytrack {

/// The object that is put under a point cloud as its floor: nobody has scanned it.
inline constexpr std::string_view kUnseenFloor = "floor_unseen";

}  // namespace dollytrack
