#pragma once

#include "engine/core/result.h"
#include "engine/io/homes/home.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace dollytrack::homes {

/// Whether a file that begins with `head` is XML with a home as its root element.
bool looksLikeHomeXml(std::string_view head);

/// Reads the home in the bytes of a .sh3d archive or of a Home.xml. `path` is for errors.
Result<Home> readHomeFile(std::string bytes, const std::filesystem::path& path);

/// Reads a home as a scene: every wall, floor, ceiling, door, window and piece of furniture is an
/// object. Source axes: x of the plan, y up, z the plan's y; cm. Models and textures are searched
/// for in the archive (for a bare Home.xml, in its folder), then in ImportOptions::model_folders
/// (folders, or archives like sweethome3d.jar).
Result<RawScene> readHome(const std::filesystem::path& path, const ImportOptions& options,
                          const JobContext& job);

/// Files and folders that readHome() opens in addition to the home's folder.
std::vector<std::filesystem::path> homeInputs(const std::filesystem::path& path,
                                              const ImportOptions& options);

}  // namespace dollytrack::homes
