#include "app/cli/export/dataset_scene.h"

#include "app/cli/scene_arguments.h"
#include "engine/document/apply_scene_edits.h"
#include "engine/document/edits_json.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/sha256.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/settings/project_file.h"
#include "engine/scene/varied_materials.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <utility>
#include <vector>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;

/// The scene's description in dataset.json.
struct SaidOfScene {
    std::string file, sha256;
    std::string path;  // original path; empty in older datasets
    Eigen::Matrix4d source_from_world = Eigen::Matrix4d::Identity();
    Edits edits;
    SizeRules sizes;
    LightParams light;    // its variation also changes materials
    bool albedo = false;  // the dataset has albedo images, so the check needs colours
};

Result<SaidOfScene> readSaid(const verify::StoredDataset& dataset) {
    const std::string place = (dataset.folder / "dataset.json").string();
    SaidOfScene said;
    said.albedo = dataset.has("albedo");
    try {
        const auto& scene = dataset.card.at("scene");
        said.file = scene.at("file").get<std::string>();
        said.sha256 = scene.at("sha256").get<std::string>();
        said.path = scene.value("path", "");
        const auto rows = scene.at("source_from_world").get<std::array<std::array<double, 4>, 4>>();
        for (Eigen::Index row = 0; row < 4; ++row) {
            for (Eigen::Index column = 0; column < 4; ++column) {
                said.source_from_world(row, column) = rows[row][column];
            }
        }
        // Datasets exported without plan parameters, as in tests, use the default size rules.
        const auto targets = dataset.card.at("parameters").value("targets", nlohmann::json());
        if (targets.is_object()) {
            said.sizes.small_volume_m3 = targets.value("small_volume_m3", 0.1);
            said.sizes.size_ratio = targets.value("size_ratio", 5.0);
        }
        const auto& parameters = dataset.card.at("parameters");
        if (parameters.contains("light")) {
            const nlohmann::json light = {{"light", parameters["light"]}};
            if (Status status = setFromJson(listLightFields(said.light), light); !status) {
                return fail(status.error().code, status.error().message,
                            place + ": " + status.error().where);
            }
        }
        if (dataset.card.contains("edits")) {
            Result<Edits> edits = editsFromJson(nlohmann::json(dataset.card["edits"]));
            if (!edits) {
                return fail(edits.error().code, edits.error().message,
                            place + ": " + edits.error().where);
            }
            said.edits = std::move(*edits);
        }
    } catch (const nlohmann::json::exception& error) {
        return fail(ErrorCode::BadInput,
                    "It is damaged (" + plainReason(error) + "); export the dataset again.", place);
    }
    return said;
}

/// Folders of the scene in the batch that made the dataset, if any: the dataset is
/// BATCH/JOB/dataset or a room in it, and BATCH/jobs.json lists the jobs.
std::vector<fs::path> foldersOfBatch(const fs::path& dataset) {
    std::vector<fs::path> folders;
    std::error_code error;
    fs::path job = fs::absolute(dataset / "", error).lexically_normal().parent_path();
    for (int up = 0; up < 2; ++up) {
        job = job.parent_path();
        const fs::path list = job.parent_path() / "jobs.json";
        if (!fs::is_regular_file(list, error)) continue;
        try {
            const auto json = readBoundedJson(list).value_or(nlohmann::json());
            if (!json.is_object() || json.value("format", "") != "dollytrack-batch") continue;
            for (const auto& one : json.at("jobs")) {
                if (one.at("name").get<std::string>() != job.filename().string()) continue;
                folders.push_back(fs::path(one.at("scene").get<std::string>()).parent_path());
            }
        } catch (const std::exception&) {  // damaged or unreadable: search elsewhere
        }
    }
    return folders;
}

/// Scene folders named by the project files in a folder that belong to this scene.
std::vector<fs::path> foldersOfProjects(const fs::path& folder, const std::string& scene_sha256) {
    constexpr std::size_t kMost = 200;  // limit of project files read
    std::vector<fs::path> projects;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() == ".dolly") projects.push_back(entry->path());
    }
    std::sort(projects.begin(), projects.end());
    projects.resize(std::min(projects.size(), kMost));
    std::vector<fs::path> folders;
    for (const fs::path& path : projects) {
        const Result<ProjectFile> project = loadProject(path);
        if (project && project->scene_sha256 == scene_sha256) {
            folders.push_back(project->scene.parent_path());
        }
    }
    return folders;
}

/// Searches for the scene file; returns an empty path if no file has the recorded hash.
fs::path findScene(const fs::path& dataset, const SaidOfScene& said) {
    std::error_code error;
    const fs::path name = fs::path(said.file).filename();
    if (name.empty()) return {};
    const auto isIt = [&](const fs::path& path) {
        if (!fs::is_regular_file(path, error)) return false;
        const Result<std::string> is = sha256OfFile(path);
        return is && *is == said.sha256;
    };
    const auto first_in = [&](const std::vector<fs::path>& folders) -> fs::path {
        for (const fs::path& folder : folders) {
            if (isIt(folder / name)) return folder / name;
        }
        return {};
    };
    if (fs::path(said.path).is_absolute() && isIt(said.path)) return said.path;
    const std::vector<fs::path> near = {
        dataset, fs::absolute(dataset, error).lexically_normal().parent_path(),
        fs::absolute(dataset / "..", error).lexically_normal(), fs::current_path(error)};
    if (fs::path path = first_in(near); !path.empty()) return path;
    if (fs::path path = first_in(foldersOfBatch(dataset)); !path.empty()) return path;
    for (const fs::path& folder : near) {
        if (fs::path path = first_in(foldersOfProjects(folder, said.sha256)); !path.empty()) {
            return path;
        }
    }
    return {};
}

/// Restores unit and upward axis from the recorded transform.
void asThen(const SaidOfScene& said, ImportOptions& options) {
    const Eigen::Vector3d up = said.source_from_world.block<3, 1>(0, 2);
    Eigen::Index axis = 2;
    up.cwiseAbs().maxCoeff(&axis);
    if (up.norm() > 0.0) options.unit_m = 1.0 / up.norm();
    options.up_axis = UpAxis("xyz"[axis], up[axis] < 0.0);
}

Result<Scene> importAsThen(const fs::path& path, const SaidOfScene& said,
                           const DatasetSceneArguments& given, const JobContext& job) {
    ImportOptions options;
    if (given.labels) options.labels = *given.labels;
    options.model_folders.assign(given.models.begin(), given.models.end());
    if (given.annotations) options.annotations = *given.annotations;
    options.regroup = !given.keep_meshes;
    options.read_textures = said.albedo || given.with_textures;
    options.use_cache = true;
    options.small_volume_m3 = said.sizes.small_volume_m3;
    options.size_ratio = said.sizes.size_ratio;
    Result<Scene> scene = importScene(path, options, job);
    if (!scene) return scene;
    // Automatic detection of unit and axis is deterministic, so an equal transform means equal
    // options.
    if (scene->source_from_world.matrix() != said.source_from_world) {
        asThen(said, options);
        scene = importScene(path, options, job);
        if (!scene) return scene;
    }
    if (said.edits.scene == SceneEdits{}) return scene;
    return applySceneEdits(*scene, said.edits.scene, said.sizes);
}

Result<std::shared_ptr<const Scene>> openGiven(const fs::path& path, const SaidOfScene& said,
                                               const DatasetSceneArguments& given,
                                               const JobContext& job) {
    if (path.extension() != ".dolly") {
        Result<Scene> scene = importAsThen(path, said, given, job);
        if (!scene) return tl::unexpected(std::move(scene.error()));
        return std::make_shared<const Scene>(std::move(*scene));
    }
    SceneArguments arguments;
    arguments.path = path.string();
    arguments.labels = given.labels;
    arguments.keep_meshes = given.keep_meshes;
    arguments.models = given.models;
    arguments.annotations = given.annotations;
    Result<OpenedScene> opened = openScene(arguments, job);
    if (!opened) return tl::unexpected(std::move(opened.error()));
    return opened->scene;
}

}  // namespace

void addDatasetSceneArguments(CLI::App& command, DatasetSceneArguments& arguments) {
    command
        .add_option(
            "--scene", arguments.path,
            "Scene or project of the dataset; default: its original path, then beside the dataset")
        ->type_name("SCENE");
    command.add_flag("--keep-meshes", arguments.keep_meshes,
                     "If the plan used --keep-meshes: leave meshes as they are in the file");
    command
        .add_option(
            "--labels", arguments.labels,
            "Label file of the plan, if it adds words; label files with classes are in the dataset")
        ->type_name("FILE");
    command.add_option("--models", arguments.models, "Folder with models of the scene; repeatable")
        ->check(CLI::ExistingDirectory.description(""))
        ->type_name("DIR")
        ->allow_extra_args(false);
    command
        .add_option("--annotations", arguments.annotations,
                    "Annotations of the scene, if the plan used any")
        ->type_name("DIR");
}

Result<DatasetScene> openDatasetScene(const verify::StoredDataset& dataset,
                                      const DatasetSceneArguments& arguments,
                                      const JobContext& job) {
    const Result<SaidOfScene> said = readSaid(dataset);
    if (!said) return tl::unexpected(said.error());
    const fs::path path =
        arguments.path.empty() ? findScene(dataset.folder, *said) : fs::path(arguments.path);
    DatasetScene opened;
    if (path.empty()) {
        opened.missing = "the scene " + said->file +
                         " and its project are neither at their original path nor beside the "
                         "dataset; pass it with --scene";
        return opened;
    }
    Result<std::shared_ptr<const Scene>> scene = openGiven(path, *said, arguments, job);
    if (!scene) return tl::unexpected(std::move(scene.error()));
    if (said->light.light_variation > 0.0) {
        Scene varied = **scene;
        varyMaterials(varied, said->light);
        *scene = std::make_shared<const Scene>(std::move(varied));
    }
    if ((*scene)->source_sha256 != said->sha256) {
        return fail(
            ErrorCode::BadInput,
            "It is not the scene of the dataset, or it has changed; the dataset's scene is " +
                said->file + ".",
            path.string());
    }
    opened.scene = std::move(*scene);
    opened.rays = std::make_unique<RayCaster>(*opened.scene);
    return opened;
}

}  // namespace dollytrack::cli
