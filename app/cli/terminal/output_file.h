#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"

#include <filesystem>
#include <string>

namespace dollytrack::cli {

/// Checks, without writing, that a file can be written, so that long work does not end with a
/// failed write. An empty path is accepted. Error: CannotWrite.
Status checkWritable(const std::string& path);

/// The name of a folder with an ending, beside the folder: "rooms/kitchen.html".
std::filesystem::path fileBeside(const std::filesystem::path& folder, const std::string& ending);

/// Opens the folder of a page after checking, without writing, that the page can be written there.
/// Errors: CannotWrite; Usage if the file exists and `overwrite` is false.
Result<GuardedFolder> openPageFolder(const std::filesystem::path& file, bool overwrite);

}  // namespace dollytrack::cli
