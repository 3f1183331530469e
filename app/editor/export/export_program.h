#pragma once

#include "engine/core/result.h"
#include "ui/export_job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::editor {

/// The command line program that exports: beside this one, else in PATH.
[[nodiscard]] Result<std::filesystem::path> findExportProgram();

/// The command that does a job, with its progress as lines of JSON.
[[nodiscard]] std::vector<std::string> exportCommand(const std::filesystem::path& program,
                                                     const std::filesystem::path& project,
                                                     const ui::ExportJob& job);

}  // namespace dollytrack::editor
