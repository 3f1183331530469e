#pragma once

#include "engine/core/result.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// An object's whole silhouette inside the image, as if nothing were before it, as it is written.
struct AmodalMask {
    int object_id = 0;
    std::array<int, 4> box = {};  // x, y, width, height
    std::string runs;             // empty when they are of another size than the image's
};

/// One frame's file, each object once. Error: BadInput.
Result<std::vector<AmodalMask>> readAmodal(const std::filesystem::path& path, int width,
                                           int height);

/// Column by column, 1 inside; empty when the runs do not sum up to the image.
std::vector<std::uint8_t> insideOf(const AmodalMask& mask, int width, int height);

/// "amodal/000012.json"
std::string amodalFile(int frame);

}  // namespace dollytrack::verify
