#pragma once

#include "engine/core/result.h"
#include "ui/export_job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// Path of the program `dollytrack`: beside this one, or in PATH. Error: Failed if it is missing.
[[nodiscard]] Result<std::filesystem::path> findExportProgram();

/// The command line that runs a job and reports progress as JSON lines.
[[nodiscard]] std::vector<std::string> exportCommand(const std::filesystem::path& program,
                                                     const std::filesystem::path& project,
                                                     const ui::ExportJob& job);

}  // namespace dollytrack::editor
