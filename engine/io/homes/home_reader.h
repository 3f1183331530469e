#pragma once

#include "engine/core/result.h"
#include "engine/io/homes/home.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::homes {

/// Whether a file begins like Home.xml: XML whose outermost element is a home.
bool looksLikeHomeXml(std::string_view head);

/// The home in a .sh3d archive, read from its bytes, or in the text of a Home.xml.
Result<Home> readHomeFile(std::string bytes, const std::filesystem::path& path);

/// A home as a scene: every wall, floor, ceiling, door, window and piece of furniture an object of
/// its own. Source axes: x the plan's, y up, z the plan's y; cm. Models and pictures come out of
/// the archive, or for a bare Home.xml from its folder, and else from ImportOptions::model_folders
/// (folders, or archives like sweethome3d.jar).
Result<RawScene> readHome(const std::filesystem::path& path, const ImportOptions& options,
                          const JobContext& job);

/// What readHome() opens besides the home's own folder.
std::vector<std::filesystem::path> homeInputs(const std::filesystem::path& path,
                                              const ImportOptions& options);

}  // namespace dollytrack::homes
