#include "engine/io/import_settings.h"

#include "engine/core/field_list.h"

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack::io {

Result<ImportOptions> importOptionsFromJson(const nlohmann::json& settings) {
    ImportOptions options;
    try {
        if (settings.contains("unit_m")) options.unit_m = settings["unit_m"].get<double>();
        if (settings.contains("labels")) options.labels = settings["labels"].get<std::string>();
        if (settings.contains("model_folders")) {
            for (const nlohmann::json& folder : settings["model_folders"]) {
                options.model_folders.emplace_back(folder.get<std::string>());
            }
        }
        if (settings.contains("annotations")) {
            options.annotations = settings["annotations"].get<std::string>();
        }
        if (settings.contains("up_axis")) {
            const auto axis = settings["up_axis"].get<std::string>();
            options.up_axis = axis.empty() ? 'y' : axis.front();
        }
        if (settings.contains("cloud")) {
            FieldCollector fields;
            visitCloudParams(options.cloud, fields);
            Status set = setFromJson(fields.take(), {{"cloud", settings["cloud"]}});
            if (!set) return tl::unexpected<Error>(std::move(set.error()));
        }
    } catch (const nlohmann::json::exception& e) {
        return fail(
            ErrorCode::BadInput,
            std::string("The project's import settings are of the wrong type (") + e.what() + ").");
    }
    return options;
}

nlohmann::json importOptionsToJson(const ImportOptions& options) {
    // By name, so that a new option that is forgotten here does not compile.
    const auto& [unit_m, up_axis, labels, model_folders, annotations, cloud, read_textures,
                 small_volume_m3, size_ratio, in_process, use_cache] = options;
    (void)read_textures, (void)small_volume_m3, (void)size_ratio, (void)in_process, (void)use_cache;
    nlohmann::json settings = nlohmann::json::object();
    if (unit_m) settings["unit_m"] = *unit_m;
    if (up_axis) settings["up_axis"] = std::string(1, *up_axis);
    if (labels) settings["labels"] = labels->string();
    for (const std::filesystem::path& folder : model_folders) {
        settings["model_folders"].push_back(folder.string());
    }
    if (annotations) settings["annotations"] = annotations->string();
    if (CloudParams params = cloud; params != CloudParams{}) {
        FieldCollector fields;
        visitCloudParams(params, fields);
        settings["cloud"] = toJson(fields.take())["cloud"];
    }
    return settings;
}

}  // namespace dollytrack::io
