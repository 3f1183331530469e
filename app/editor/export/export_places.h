#pragma once

#include "engine/core/result.h"
#include "ui/export_job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// A program in PATH; empty when it is in none of its folders.
[[nodiscard]] std::filesystem::path findInPath(const std::string& program);

/// A folder for another project's dataset, beside `folder` and named after the project; with a
/// number where a job of the queue writes there already.
[[nodiscard]] std::filesystem::path folderBeside(const std::filesystem::path& folder,
                                                 const std::filesystem::path& project,
                                                 const std::vector<ui::ExportJob>& jobs);

/// A folder for one more dataset, beside `folder` and named after it ("dataset_2"), where there is
/// none and no job of the queue writes.
[[nodiscard]] std::filesystem::path freeFolderBeside(const std::filesystem::path& folder,
                                                     const std::vector<ui::ExportJob>& jobs);

/// The job that runs or waits to write into this folder; null: none does. What a second one wrote
/// there would replace what the first did.
[[nodiscard]] const ui::ExportJob* jobThatWillWrite(const std::filesystem::path& folder,
                                                    const std::vector<ui::ExportJob>& jobs);

/// The contact sheet of the dataset in a folder, or of its first room that has one where each room
/// has a dataset; empty without.
[[nodiscard]] std::filesystem::path contactSheetIn(const std::filesystem::path& folder);

/// Why openFolder() cannot work on this computer; empty when it can.
[[nodiscard]] std::string whyNoFolders();

/// Shows a folder in the desktop's file manager. Returns at once.
Status openFolder(const std::filesystem::path& folder);

}  // namespace dollytrack::editor
