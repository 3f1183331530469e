#pragma once

#include "engine/core/result.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::verify {

/// An object's amodal mask inside the image, as stored.
struct AmodalMask {
    int object_id = 0;
    std::array<int, 4> box = {};  // x, y, width, height
    std::string runs;             // COCO run lengths; empty if stored for another image size
};

/// Reads one frame's file; each object occurs once. Returns BadInput if the file is invalid.
Result<std::vector<AmodalMask>> readAmodal(const std::filesystem::path& path, int width,
                                           int height);

/// The mask column by column, 1 inside; empty if the runs do not sum up to the image.
std::vector<std::uint8_t> insideOf(const AmodalMask& mask, int width, int height);

/// Path of a frame's file, for example "amodal/000012.json".
std::string amodalFile(int frame);

}  // namespace dollytrack::verify
