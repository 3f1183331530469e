#include "app/editor/project/project_loader.h"

#include "app/process/scene_conversion.h"

#include <utility>

namespace dollytrack::editor {

Result<OpenedProject> openProject(ProjectContent content, const JobContext& job) {
    JobContext reading = job;
    if (content.project.empty() && isBlenderFile(content.scene_file)) {
        Result<std::filesystem::path> converted =
            convertScene(content.scene_file, job.stage(0.0, 0.5, "converting"));
        if (!converted) return tl::unexpected(std::move(converted.error()));
        Result<ProjectContent> read = readProject(*converted);  // with its annotations
        if (!read) return tl::unexpected(std::move(read.error()));
        content = std::move(*read);
        reading = job.stage(0.5, 1.0, "loading");
    }
    Result<std::shared_ptr<const Scene>> imported = importSceneOf(content, reading);
    if (!imported) return tl::unexpected(std::move(imported.error()));
    OpenedProject opened;
    opened.imported = std::move(*imported);
    Result<std::vector<std::string>> lost = numberEdits(content, *opened.imported);
    if (!lost) return tl::unexpected(std::move(lost.error()));
    for (const std::string& one : *lost) opened.warnings.push_back("Annotations: " + one + ".");
    const bool changed = sceneHasChanged(content, *opened.imported);
    if (changed) {
        opened.warnings.push_back(
            "The scene file has changed since the project was saved; objects were matched by name, "
            "and planning runs again.");
    }
    opened.project = std::move(content.project);
    opened.scene_file = std::move(content.scene_file);
    opened.state.parameters = toJson(planning::listFields(content.params));
    opened.state.edits = std::move(content.edits);
    opened.state.import = content.import;
    opened.import = std::move(content.import);
    opened.loaded_edits = std::move(content.edits_section);
    opened.others = std::move(content.others);
    opened.file_sha256 = std::move(content.file_sha256);
    opened.file_has_plan = !content.result.is_null() && !changed;
    return opened;
}

}  // namespace dollytrack::editor
