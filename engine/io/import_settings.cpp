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

}  // namespace dollytrack::io
