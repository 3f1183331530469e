#include "app/editor/project_loader.h"

#include "engine/document/edits_json.h"
#include "engine/io/import_settings.h"
#include "planning/plan_params.h"

namespace dollytrack::editor {
bool isProjectFile(const std::filesystem::path& path) {
    return path.extension() == ".dolly";
}

Result<OpenedProject> openProject(const std::filesystem::path& path,
                                  const std::optional<std::filesystem::path>& scene_instead,
                                  const JobContext& job) {
    OpenedProject opened;
    opened.scene_file = path;
    planning::PlanParams params;
    const FieldList fields = planning::listFields(params);
    std::string planned_sha256;
    if (isProjectFile(path)) {
        Result<io::ProjectFile> file = io::loadProject(path);
        if (!file) return tl::unexpected<Error>(std::move(file.error()));
        if (Status status = setFromJson(fields, file->parameters); !status) {
            status.error().where = path.string() + ": " + status.error().where;
            return tl::unexpected<Error>(std::move(status.error()));
        }
        Result<Edits> edits = editsFromJson(file->edits);
        if (!edits) {
            edits.error().where = path.string() + ": " + edits.error().where;
            return tl::unexpected<Error>(std::move(edits.error()));
        }
        opened.project = path;
        opened.scene_file = scene_instead.value_or(file->scene);
        opened.state.edits = std::move(*edits);
        opened.loaded_edits = file->edits;
        opened.import = std::move(file->import);
        opened.others = std::move(file->others);
        opened.file_sha256 = file->file_sha256;
        opened.file_has_plan = !file->result.is_null();
        planned_sha256 = file->scene_sha256;
        std::error_code error;
        if (!std::filesystem::exists(opened.scene_file, error)) {
            return fail(ErrorCode::BadInput,
                        "The project's scene " + opened.scene_file.string() +
                            " is gone; put it back, or choose the scene file where it is now.",
                        path.string());
        }
    }
    opened.state.parameters = toJson(fields);
    Result<ImportOptions> options = io::importOptionsFromJson(opened.import);
    if (!options) return tl::unexpected<Error>(std::move(options.error()));
    options->small_volume_m3 = params.targets.small_volume_m3;
    options->size_ratio = params.targets.size_ratio;
    Result<Scene> scene = importScene(opened.scene_file, *options, job);
    if (!scene) return tl::unexpected<Error>(std::move(scene.error()));
    opened.imported = std::make_shared<const Scene>(std::move(*scene));
    if (!planned_sha256.empty() && planned_sha256 != opened.imported->source_sha256) {
        opened.file_has_plan = false;
        opened.warnings.push_back(
            "The scene file has changed since the project was saved; objects were found again by "
            "name, and the plan is new.");
    }
    const auto& missing = opened.imported->report.textures_missing;
    if (!missing.empty()) {
        opened.warnings.push_back(
            std::to_string(missing.size()) +
            (missing.size() == 1 ? " texture is missing: " : " textures are missing: ") +
            missing.front() + (missing.size() > 1 ? ", …" : "") +
            "; those surfaces show plain colour.");
    }
    return opened;
}

}  // namespace dollytrack::editor
