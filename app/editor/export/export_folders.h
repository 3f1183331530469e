#pragma once

#include "engine/core/result.h"
#include "ui/export_job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// A folder for another project's dataset, beside `folder` and named after the project, with a
/// number if a job of the queue uses that folder.
[[nodiscard]] std::filesystem::path folderBeside(const std::filesystem::path& folder,
                                                 const std::filesystem::path& project,
                                                 const std::vector<ui::ExportJob>& jobs);

/// A folder for another dataset, beside `folder` and named after it ("dataset_2"), that neither
/// exists nor is used by a job of the queue.
[[nodiscard]] std::filesystem::path freeFolderBeside(const std::filesystem::path& folder,
                                                     const std::vector<ui::ExportJob>& jobs);

/// The running or waiting job that writes to this folder; null: none. A second job there would
/// replace the first one's dataset.
[[nodiscard]] const ui::ExportJob* jobThatWillWrite(const std::filesystem::path& folder,
                                                    const std::vector<ui::ExportJob>& jobs);

/// Path of the contact sheet of the dataset in a folder, or of the first room dataset that has one;
/// empty if there is none.
[[nodiscard]] std::filesystem::path contactSheetIn(const std::filesystem::path& folder);

/// Why openFolder() cannot work on this computer; empty if it can.
[[nodiscard]] std::string whyNoFolders();

/// Opens a folder in the desktop's file manager. Returns at once. Error: Failed.
Status openFolder(const std::filesystem::path& folder);

}  // namespace dollytrack::editor
