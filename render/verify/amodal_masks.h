#pragma once

#include "engine/core/result.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// An object's whole silhouette inside the image, as if nothing were before it.
struct AmodalMask {
    int object_id = 0;
    std::array<int, 4> box = {};       // x, y, width, height, as it is written
    std::vector<std::uint8_t> inside;  // column by column; empty when the run lengths are wrong
    int area = 0;
};

/// One frame's file. Error: BadInput.
Result<std::vector<AmodalMask>> readAmodal(const std::filesystem::path& path, int width,
                                           int height);

/// "amodal/000012.json"
std::string amodalFile(int frame);

}  // namespace dollytrack::verify
