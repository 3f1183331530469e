#include "app/project/read_project.h"

#include "engine/document/edits_json.h"
#include "engine/document/object_numbers.h"
#include "engine/io/format_table/input_check.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/io/settings/import_settings.h"
#include "engine/io/settings/project_file.h"

#include <utility>

namespace dollytrack {
namespace {

tl::unexpected<Error> in(const std::filesystem::path& file, Error error) {
    error.where = file.string() + ": " + error.where;
    return tl::unexpected(std::move(error));
}

}  // namespace

bool isProjectFile(const std::filesystem::path& path) {
    return path.extension() == ".dolly";
}

Result<ProjectContent> readProject(const std::filesystem::path& path,
                                   const std::optional<std::filesystem::path>& annotations) {
    ProjectContent content;
    content.scene_file = path;
    if (!isProjectFile(path)) {
        // Projects contain their edits; later changes of the annotations are ignored.
        Result<Annotations> said = findAnnotations(path, annotations);
        if (!said) return tl::unexpected(std::move(said.error()));
        Result<Edits> edits = editsFromJson(said->edits);
        if (!edits) return in(said->file, std::move(edits.error()));
        content.edits = std::move(*edits);
        if (!said->edits.is_null()) content.edits_section = std::move(said->edits);
        return content;
    }
    Result<ProjectFile> file = loadProject(path);
    if (!file) return tl::unexpected(std::move(file.error()));
    return contentOf(std::move(*file), path);
}

Result<ProjectContent> contentOf(ProjectFile file, const std::filesystem::path& path) {
    ProjectContent content;
    Status fits = setFromJson(planning::listFields(content.params), file.parameters);
    if (!fits) return in(path, std::move(fits.error()));
    Result<Edits> edits = editsFromJson(file.edits);
    if (!edits) return in(path, std::move(edits.error()));
    const Result<ImportOptions> options = importOptionsFromJson(file.import);
    if (!options) return in(path, options.error());
    content.project = path;
    content.scene_file = std::move(file.scene);
    content.import = std::move(file.import);
    content.edits = std::move(*edits);
    content.result = std::move(file.result);
    content.planned_sha256 = std::move(file.scene_sha256);
    content.file_sha256 = std::move(file.file_sha256);
    content.edits_section = std::move(file.edits);
    content.others = std::move(file.others);
    return content;
}

bool sceneIsGone(const ProjectContent& content) {
    std::error_code error;
    return !content.project.empty() && !std::filesystem::exists(content.scene_file, error);
}

Status checkScene(const ProjectContent& content) {
    if (sceneIsGone(content)) {
        return fail(
            ErrorCode::BadInput,
            "The project's scene " + content.scene_file.string() +
                " does not exist; put it back, or correct its path (scene.path in the project).",
            content.project.string());
    }
    const auto format = checkSceneFile(content.scene_file);
    return format ? Status() : Status(tl::unexpected(format.error()));
}

Result<std::shared_ptr<const Scene>> importSceneOf(const ProjectContent& content,
                                                   const JobContext& job) {
    if (Status status = checkScene(content); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    Result<ImportOptions> options = importOptionsFromJson(content.import);
    if (!options) return tl::unexpected(std::move(options.error()));
    options->small_volume_m3 = content.params.targets.small_volume_m3;
    options->size_ratio = content.params.targets.size_ratio;
    options->use_cache = true;
    Result<Scene> scene = importScene(content.scene_file, *options, job);
    if (!scene) return tl::unexpected(std::move(scene.error()));
    return std::make_shared<const Scene>(std::move(*scene));
}

Result<std::vector<std::string>> numberEdits(ProjectContent& content, const Scene& imported) {
    std::vector<std::string> warnings;
    if (!content.project.empty() || content.edits == Edits{}) return warnings;
    Result<Edits> edits = numberObjects(std::move(content.edits), imported, warnings);
    if (!edits) return tl::unexpected(std::move(edits.error()));
    content.edits = std::move(*edits);
    return warnings;
}

bool sceneHasChanged(const ProjectContent& content, const Scene& imported) {
    return !content.planned_sha256.empty() && content.planned_sha256 != imported.source_sha256;
}

}  // namespace dollytrack
