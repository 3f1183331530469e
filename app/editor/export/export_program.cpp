#include "app/editor/export/export_program.h"

#include "app/process/find_program.h"
#include "engine/core/program_file.h"

#include <unistd.h>

namespace dollytrack::editor {
namespace {

namespace fs = std::filesystem;

bool isProgram(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

}  // namespace

Result<fs::path> findExportProgram() {
    if (fs::path beside = ownFile().parent_path() / "dollytrack"; isProgram(beside)) return beside;
    if (const auto found = findProgram("dollytrack")) return *found;
    return fail(ErrorCode::Failed,
                "The program 'dollytrack', which exports datasets, is neither beside the editor "
                "nor in PATH; build or install it.");
}

std::vector<std::string> exportCommand(const fs::path& program, const fs::path& project,
                                       const ui::ExportJob& job) {
    const ui::ExportRequest& request = job.request;
    std::vector<std::string> command = {
        program.string(), "export",      project.string(), "--out", request.folder.string(),
        "--range",        request.range, "--progress",     "json"};
    if (!request.modalities.empty()) {
        command.insert(command.end(), {"--modalities", joined(request.modalities)});
    }
    if (!request.formats.empty()) {
        command.insert(command.end(), {"--formats", joined(request.formats)});
    }
    if (!request.flow_distances.empty()) {
        command.insert(command.end(), {"--flow-distances", request.flow_distances});
    }
    if (!request.rig.empty()) command.insert(command.end(), {"--rig", request.rig.string()});
    if (request.still) command.emplace_back("--still");
    if (request.overwrite) command.emplace_back("--overwrite");
    if (job.resumes) command.emplace_back("--resume");
    return command;
}

}  // namespace dollytrack::editor
