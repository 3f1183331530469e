#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A file of one frame of a dataset.
struct FrameFile {
    std::string path;  // relative to the dataset folder, for example "rgb/000012.png"
    std::vector<std::uint8_t> bytes;
};

/// Path of a frame's file, for example "rgb/000012.png".
[[nodiscard]] std::string frameFile(const std::string& folder, int index,
                                    const std::string& ending = ".png");

/// Path of a file for two frames, for example "flow_forward/000012_000013.flo".
[[nodiscard]] std::string pairFile(const std::string& folder, int from, int to,
                                   const std::string& ending);

}  // namespace dollytrack::render
