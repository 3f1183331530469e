#include "engine/io/settings/import_settings.h"

#include "engine/core/field_list.h"
#include "engine/document/json_reader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack {

Result<ImportOptions> importOptionsFromJson(const nlohmann::json& settings) {
    ImportOptions options;
    Status status;
    const JsonReader from(settings, "scene.import", status);
    if (const JsonReader unit = from.at("unit_m"); !unit.absent()) {
        options.unit_m = unit.number(1e-9, 1e9);
    }
    if (const JsonReader up = from.at("up_axis"); !up.absent()) {
        options.up_axis = parseUpAxis(up.text());
        if (!options.up_axis) up.refuse(fmt::format("This must be {}.", kUpAxes));
    }
    if (const JsonReader labels = from.at("labels"); !labels.absent()) {
        options.labels = labels.text();
    }
    const JsonReader folders = from.at("model_folders");
    for (std::size_t i = 0; i < folders.size() && from.good(); ++i) {
        options.model_folders.emplace_back(folders.at(i).text());
    }
    if (const JsonReader annotations = from.at("annotations"); !annotations.absent()) {
        options.annotations = annotations.text();
    }
    if (const JsonReader regroup = from.at("regroup"); !regroup.absent()) {
        if (!regroup.json().is_boolean()) regroup.refuse("This must be true or false.");
        if (from.good()) options.regroup = regroup.json().get<bool>();
    }
    if (const JsonReader cloud = from.at("cloud"); !cloud.absent() && from.good()) {
        FieldCollector fields;
        visitCloudParams(options.cloud, fields);
        Status set = setFromJson(fields.take(), {{"cloud", cloud.json()}});
        if (!set)
            status =
                fail(set.error().code, set.error().message, "scene.import." + set.error().where);
    }
    if (!status) return tl::unexpected(std::move(status.error()));
    return options;
}

nlohmann::json importOptionsToJson(const ImportOptions& options) {
    // By name, so that this does not compile if a new option is missing here.
    const auto& [unit_m, up_axis, labels, model_folders, annotations, cloud, regroup, read_textures,
                 small_volume_m3, size_ratio, in_process, use_cache] = options;
    (void)read_textures, (void)small_volume_m3, (void)size_ratio, (void)in_process, (void)use_cache;
    nlohmann::json settings = nlohmann::json::object();
    if (unit_m) settings["unit_m"] = *unit_m;
    if (up_axis) settings["up_axis"] = up_axis->text();
    if (labels) settings["labels"] = labels->string();
    for (const std::filesystem::path& folder : model_folders) {
        settings["model_folders"].push_back(folder.string());
    }
    if (annotations) settings["annotations"] = annotations->string();
    if (!regroup) settings["regroup"] = false;
    if (CloudParams params = cloud; params != CloudParams{}) {
        FieldCollector fields;
        visitCloudParams(params, fields);
        settings["cloud"] = toJson(fields.take())["cloud"];
    }
    return settings;
}

}  // namespace dollytrack
