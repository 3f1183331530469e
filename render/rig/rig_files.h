#pragma once

#include "engine/camera/rig.h"

#include <array>
#include <string>
#include <vector>

namespace dollytrack::render {

/// Image folders of each rig camera, below cameras/NAME.
inline constexpr std::array<const char*, 5> kRigImages = {"rgb", "depth", "instance", "semantic",
                                                          "normal_world"};

/// Folder of one image kind, for example "cameras/left/depth".
[[nodiscard]] std::string rigFolder(const std::string& camera, const std::string& image);

/// All folders of a camera, parents first.
[[nodiscard]] std::vector<std::string> rigFoldersOf(const std::string& camera);
[[nodiscard]] std::vector<std::string> rigFolders(const Rig& rig);

}  // namespace dollytrack::render
