#pragma once

#include <string_view>

namespace dollytrack {

/// What a Collada file says about itself, from the <asset> at its head.
struct ColladaAsset {
    double unit_m = 1.0;  // metres per unit
    char up_axis = 'y';   // 'x', 'y' or 'z'
    bool by_sketchup = false;
};

/// Reads the first bytes of a file; they may end anywhere. What is missing, cut off or no number
/// above 0 keeps its default.
[[nodiscard]] ColladaAsset parseColladaAsset(std::string_view head);

}  // namespace dollytrack
